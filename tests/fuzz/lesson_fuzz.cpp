// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/lesson_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>

#include "exhibit/state/lines_to_write.h"
#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "scene/samples/particle_set.h"
#include "support/places.h"

namespace {

bool can_be_pushed(const afm::exhibit::PushPlan& plan, const afm::exhibit::Lesson& lesson) {
  using afm::exhibit::PushUntil;
  if (!lesson.set || plan.particle >= lesson.set->particles.size()) return false;
  if (plan.until == PushUntil::Threshold) return true;
  if ((plan.until == PushUntil::Target || plan.until == PushUntil::Line) && plan.target >= lesson.set->targets.size())
    return false;
  if (plan.until == PushUntil::Pattern) return !lesson.set->targets.empty();
  return plan.until != PushUntil::Moved || (std::isfinite(plan.distance_m) && plan.distance_m > 0.0);
}

bool can_be_written(const afm::exhibit::LinesToWrite& lines, const afm::exhibit::Lesson& lesson) {
  return lesson.set && lesson.set->soft && std::isfinite(lines.width_m) && lines.width_m > 0.0 &&
         !lines.lines_m.empty() && std::all_of(lines.lines_m.begin(), lines.lines_m.end(), [](const auto& corners_m) {
           return corners_m.size() >= 2 && std::all_of(corners_m.begin(), corners_m.end(), [](const auto& corner_m) {
                    return std::isfinite(corner_m.x) && std::isfinite(corner_m.y);
                  });
         });
}

bool can_be_run(const afm::exhibit::LessonStep& step, const afm::exhibit::Lesson& lesson) {
  using afm::exhibit::StepKind;
  const auto& plan = step.threshold;
  const bool of_lesson =
      std::all_of(step.materials.begin(), step.materials.end(), [&](auto i) { return i < lesson.materials.size(); });
  const bool felt = step.kind == StepKind::Cycle || step.kind == StepKind::Threshold;
  if (step.kind == StepKind::Push && !can_be_pushed(step.push, lesson)) return false;
  if (step.kind == StepKind::Write && (!step.lines || !can_be_written(*step.lines, lesson))) return false;
  return of_lesson && (!felt || step.materials.size() == 1) &&
         (step.kind != StepKind::Identify ||
          (step.states ? lesson.tapping && step.materials.size() == 1 : step.materials.size() >= 2)) &&
         step.trials >= 1 && step.practice >= 0 && std::isfinite(step.hint_after_s) && plan.least > 0.0 &&
         plan.least <= plan.start && plan.start <= plan.most && plan.step > 1.0 &&
         (!step.each_condition || lesson.conditions.size() >= 2);
}

}  // namespace

// Whatever the bytes: a lesson of steps that can be run, with names that files can have, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto lesson = afm::exhibit::load_lesson(file.path(), afm::support::source("assets"));
  if (!lesson) return 0;
  ++afm::fuzz::accepted_inputs;
  if (lesson->minutes < 1 || lesson->minutes > afm::exhibit::kMostLessonMinutes || lesson->steps.empty()) std::abort();
  if (lesson->id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos) std::abort();
  std::set<std::string> ids;
  for (const afm::exhibit::LessonStep& step : lesson->steps) {
    if (!ids.insert(step.id).second || !can_be_run(step, *lesson)) std::abort();
  }
  return 0;
}
