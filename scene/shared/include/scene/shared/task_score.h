// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/shared/field_visitor.h"

namespace afm::scene {

// Done: the pattern is complete and the hand was lifted; the score no longer changes.
enum class TaskState : std::uint32_t { NotBegun = 0, Running = 1, Done = 2 };

// Score of a person who pushes particles to a pattern, or without seeing them, from the first push of the task onward
// (scene/samples/pattern_task.h).
struct TaskScore {
  double time_s = 0;             // time since the first push; when done, until the hand was lifted
  double rms_m = 0;              // root mean square distance from the pattern or line when done; 0 before
  double work_j = 0;             // work of the hand against the particles
  double largest_lateral_n = 0;  // largest lateral force on the lever
  double threshold_n = 0;        // lateral force at which a particle yielded; 0 unless the task asks for it
  double answer_n = 0;           // force with which a pinned particle was then pressed; 0: no answer yet
  std::uint32_t strokes = 0;     // number of times that the tip came down and moved a particle
  std::uint32_t losses = 0;      // number of times that the tip slid past a particle that it had pushed
  std::uint32_t undos = 0;       // number of pushes taken back, an aid
  std::uint32_t guided = 0;      // number of pushes along a groove (haptics/felt_groove.h), an aid
  TaskState state = TaskState::NotBegun;
  std::uint32_t truth = 0;  // 1: particles shown as they are instead of their picture, an aid

  bool operator==(const TaskScore&) const = default;
};

// True if the threshold to be felt has been answered.
constexpr bool answered(const TaskScore& score) { return score.answer_n > 0.0; }

// Relative error of the answer against the threshold. Only if answered.
constexpr double answer_error(const TaskScore& score) { return score.answer_n / score.threshold_n - 1.0; }

template <class Visit, RecordOf<TaskScore>... Record>
constexpr void for_each_field(Visit&& visit, Record&... score) {
  visit("time_s", score.time_s...);
  visit("rms_m", score.rms_m...);
  visit("work_J", score.work_j...);
  visit("largest_lateral_N", score.largest_lateral_n...);
  visit("threshold_N", score.threshold_n...);
  visit("answer_N", score.answer_n...);
  visit("strokes", score.strokes...);
  visit("losses", score.losses...);
  visit("undos", score.undos...);
  visit("guided", score.guided...);
  visit("state", score.state...);
  visit("truth", score.truth...);
}
static_assert(all_fields_described<TaskScore>());

}  // namespace afm::scene
