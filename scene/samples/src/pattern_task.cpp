// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/pattern_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/manipulation/pushed_particles.h"
#include "physics/quantity_text.h"
#include "scene/shared/particle_blocks.h"

namespace afm::scene {

using physics::EventKind;

PatternTask::PatternTask(const ParticleSet& set, Pattern pattern)
    : set_(set), pattern_(std::move(pattern)), clear_z_m_(physics::clear_height(set.setup).si) {}

void PatternTask::add(EventKind event, double force_n) {
  const bool runs = task_.score.state == TaskState::Running;
  if (event == EventKind::ParticleLost && runs) ++task_.score.losses;
  if (event == EventKind::ParticleGave) gave_n_ = force_n;
  if (event == EventKind::PushTakenBack) take_back();
  if (event == EventKind::ParticlesPutBack) put_back();
}

void PatternTask::take_back() {
  put_ = true;
  if (task_.kept_strokes > 0) {
    --task_.kept_strokes;
  } else if (!earlier_.empty()) {
    task_ = earlier_.back();
    earlier_.pop_back();
  }
  if (task_.score.state == TaskState::Done && task_.kept_strokes < task_.done_strokes) go_on();
  if (task_.score.state == TaskState::Running) ++task_.score.undos;
}

// Continues a task that has ended, since the pattern has changed since.
void PatternTask::go_on() {
  task_.score.state = TaskState::Running;
  task_.score.rms_m = task_.score.answer_n = 0.0;
  rest_.reset();
}

void PatternTask::put_back() {
  put_ = true;
  if (earlier_.size() == kMostStrokes) earlier_.erase(earlier_.begin());  // the servo has forgotten it, too
  earlier_.push_back(std::exchange(task_, {}));
}

void PatternTask::add(const TaskTick& tick) {
  if (!last_) last_ = tick;
  TaskScore& score = task_.score;
  const bool lifted = tick.base_m[2] >= clear_z_m_ && !tick.carries, put = std::exchange(put_, false);
  if (set_.blind) follow_blind(tick);
  if (lifted && !tick.swept) moving_ = guided_ = false;  // all pushes of one scan are a single stroke
  if (tick.places != last_->places) {
    if (!put) count_stroke(tick);
    lifted_ns_.reset();
    rest_.reset();
  }
  if (!lifted) lifted_ns_.reset();
  if (lifted && !lifted_ns_) lifted_ns_ = tick.time_ns;
  if (score.state != TaskState::Done) count_work(tick);
  if (score.state == TaskState::Running) count_guidance(tick);
  if (score.state == TaskState::Running && tick.truth) score.truth = 1;
  // the first stroke counts from its descent
  if (lifted && score.state == TaskState::NotBegun) score = {};
  if (score.state == TaskState::Running) score.time_s = 1e-9 * static_cast<double>(tick.time_ns - task_.begun_ns);
  if (lifted_ns_ && !rest_ && tick.time_ns - *lifted_ns_ >= kRestNs)
    rest_ = Rest{.lifted_ns = *lifted_ns_, .score = score};
  last_ = tick;
}

void PatternTask::count_stroke(const TaskTick& tick) {
  if (std::exchange(moving_, true)) return;
  ++task_.kept_strokes;
  if (task_.score.state == TaskState::Done) return;
  ++task_.score.strokes;
  if (task_.score.state == TaskState::Running) return;
  task_.score.state = TaskState::Running;
  task_.begun_ns = tick.time_ns;
}

// Counts each stroke of the hand that moved a particle, if the groove was there at any time during it.
void PatternTask::count_guidance(const TaskTick& tick) {
  if (!moving_ || tick.swept || !tick.guided || std::exchange(guided_, true)) return;
  ++task_.score.guided;
}

// Adds the work of a tick, from the mean of the forces at both ends.
void PatternTask::count_work(const TaskTick& tick) {
  TaskScore& score = task_.score;
  const std::array<double, 3> before_n{last_->lateral_n[0], last_->lateral_n[1], last_->lift_n};
  const std::array<double, 3> now_n{tick.lateral_n[0], tick.lateral_n[1], tick.lift_n};
  for (std::size_t i = 0; i < now_n.size(); ++i) {
    score.work_j -= 0.5 * (before_n[i] + now_n[i]) * (tick.base_m[i] - last_->base_m[i]);
  }
  score.largest_lateral_n = std::max(score.largest_lateral_n, std::hypot(now_n[0], now_n[1]));
}

std::optional<std::uint64_t> PatternTask::unjudged() const {
  const bool rests = task_.score.state == TaskState::Running && rest_ && !rest_->judged;
  return rests ? std::optional(last_->places) : std::nullopt;
}

void PatternTask::judge(std::span<const physics::ParticlePlace> places) {
  rest_->judged = true;
  if (const auto far = off(places)) end(*far);
}

// Distance from the goal; empty if the goal is not reached.
std::optional<physics::Length> PatternTask::off(std::span<const physics::ParticlePlace> places) const {
  if (!set_.blind) {
    const auto pattern = pattern_state(set_, pattern_, places);
    return pattern && pattern->done() ? std::optional(pattern->match.rms) : std::nullopt;
  }
  if (const auto line = way(places)) return line->far_enough() ? std::optional(line->aside) : std::nullopt;
  return rest_->score.answer_n > 0.0 ? std::optional(physics::Length(0.0)) : std::nullopt;
}

std::optional<LineWay> PatternTask::way(std::span<const physics::ParticlePlace> places) const {
  if (!set_.blind || set_.blind->kind != BlindKind::Line) return std::nullopt;
  const auto& [kind, particle, target] = *set_.blind;
  return way_along(set_.particles[particle].position - pattern_.origin, pattern_.targets[target].position,
                   places[particle].position);
}

// Updates threshold and answer: the threshold of the newest stroke before its first slip; the newest answer after it.
void PatternTask::follow_blind(const TaskTick& tick) {
  const auto gave_n = std::exchange(gave_n_, std::nullopt);
  const bool touches = tick.particle != kNoParticle;
  const auto particle = static_cast<std::size_t>(touches ? tick.particle : 0);
  task_.touched = task_.touched || touches;
  TaskScore& score = task_.score;
  if (set_.blind->kind != BlindKind::Threshold || score.state == TaskState::Done) return;
  if (gave_n && touches && particle == set_.blind->particle && !moving_) score.threshold_n = *gave_n;
  if (touches && set_.particles.at(particle).pinned) {
    return held_.add(tick.time_ns, std::hypot(tick.lateral_n[0], tick.lateral_n[1]));
  }
  const auto answer_n = held_.leave();
  if (!answer_n || !(score.threshold_n > 0.0) || score.state != TaskState::Running) return;
  score.answer_n = *answer_n;
  lifted_ns_.reset();
  rest_.reset();
}

void PatternTask::end(physics::Length rms) {
  task_.score = rest_->score;
  task_.score.state = TaskState::Done;
  task_.score.rms_m = rms.si;
  task_.done_strokes = task_.kept_strokes;
  task_.score.time_s = 1e-9 * static_cast<double>(rest_->lifted_ns - task_.begun_ns);
}

std::string text_of(const TaskScore& score) {
  if (score.state == TaskState::NotBegun) return "not begun";
  const bool done = score.state == TaskState::Done;
  return fmt::format(
      "{} {:.1f} s{}{}; pushes: {}, slipped past: {}, taken back: {}, in a groove: {}, particles shown: {}; {} of "
      "work, "
      "at most {} sideways",
      done ? "done in" : "not done after", score.time_s,
      done && !answered(score)
          ? fmt::format(", {} off", format_quantity(physics::Length(score.rms_m), physics::kLengthUnits, 3))
          : "",
      answered(score) ? fmt::format(", pressed with {} for {}, {:+.0f} %",
                                    format_quantity(physics::Force(score.answer_n), physics::kForceUnits, 3),
                                    format_quantity(physics::Force(score.threshold_n), physics::kForceUnits, 3),
                                    100.0 * answer_error(score))
                      : "",
      score.strokes, score.losses, score.undos, score.guided, score.truth != 0 ? "yes" : "no",
      format_quantity(physics::Energy(score.work_j), physics::kEnergyUnits, 3),
      format_quantity(physics::Force(score.largest_lateral_n), physics::kForceUnits, 3));
}

}  // namespace afm::scene
