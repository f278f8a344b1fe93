// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "physics/contact_phase.h"
#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "scene/shared/task_score.h"

namespace afm::scene {

// Part of a tick from which the score is computed. Places in one frame, that of the targets.
struct TaskTick {
  std::int64_t time_ns = 0;
  std::array<double, 3> base_m{};       // apex on the unbent lever, in metres
  std::array<double, 2> lateral_n{};    // force of the particles on the lever, along x and y
  double lift_n = 0;                    // upward force of the particles on the lever
  std::uint64_t places = 0;             // counter that changes whenever a particle has moved
  std::int32_t particle = kNoParticle;  // index of the touched particle
  bool guided = false;                  // true: a groove guides the hand
  bool carries = false;                 // true: a particle hangs on the tip, so the hand has not left the pattern
  bool swept = false;                   // true: a scan pushes the particles, not the hand
  bool truth = false;                   // true: the particles themselves are shown, not a picture of them
};

// A task: to push the particles of a set to its pattern, or its BlindTask. It begins with the first push, ends once the
// done and the hand has been lifted for kRestNs, and begins again when all particles are put back. If putting back
// is undone, the previous task continues, with its clock. So does an ended task, if a push from before its end is
// taken back.
//
// The score follows only from ticks and events, so that a replay gives the same score. A caller that sees the particles
// less often than every tick, as a frame of the wall does, misses the end only if a push moves a particle after the
// rest and before the caller looks. One thread.
class PatternTask {
 public:
  static constexpr std::int64_t kRestNs = 500'000'000;

  // `set` has targets and must outlive the object; `pattern` is its pattern in the frame of the ticks.
  PatternTask(const ParticleSet& set, Pattern pattern);

  // Call in order of time, with the events of a tick before the tick. Other events than those of particles are ignored.
  // `force_n`: lateral force before the event.
  void add(physics::EventKind event, double force_n = 0.0);
  void add(const TaskTick& tick);

  // Places at which the particles have lain since the hand was lifted for kRestNs, unless they have been judged: call
  // judge() with them.
  std::optional<std::uint64_t> unjudged() const;

  // Ends the task with its score at the end of the rest, if the pattern is done. `places` are those of all particles of
  // the set. Only while there is something unjudged().
  void judge(std::span<const physics::ParticlePlace> places);

  // Also ends the task, by a criterion other than the pattern; `rms` is the distance from the goal. Only while there is
  // something unjudged().
  void end(physics::Length rms);

  const TaskScore& score() const { return task_.score; }

  // True if the wall must be dark: a blind task has begun with a touch and is not done.
  bool dark() const { return set_.blind && task_.touched && task_.score.state != TaskState::Done; }

  // Way of the pushed particle, only in a task along a line; `places` as for judge().
  std::optional<LineWay> way(std::span<const physics::ParticlePlace> places) const;

 private:
  struct Task {
    TaskScore score;
    std::int64_t begun_ns = 0;
    std::uint32_t kept_strokes = 0;  // strokes that have not been taken back
    std::uint32_t done_strokes = 0;  // number of kept strokes when the task ended
    bool touched = false;            // true: the tip has touched a particle
  };
  struct Rest {
    std::int64_t lifted_ns = 0;
    TaskScore score;  // score at the end of kRestNs
    bool judged = false;
  };

  void take_back();
  void go_on();
  void put_back();
  void count_stroke(const TaskTick& tick);
  void count_guidance(const TaskTick& tick);
  void count_work(const TaskTick& tick);
  void follow_blind(const TaskTick& tick);
  std::optional<physics::Length> off(std::span<const physics::ParticlePlace> places) const;

  const ParticleSet& set_;
  Pattern pattern_;
  double clear_z_m_;
  Task task_;
  std::vector<Task> earlier_;  // tasks ended by putting all particles back; restored if that is undone
  std::optional<TaskTick> last_;
  bool put_ = false;     // true: the next tick's particles were put in place, not pushed
  bool moving_ = false;  // true: the current stroke has moved a particle
  bool guided_ = false;  // true: the current stroke has been counted as guided
  std::optional<std::int64_t> lifted_ns_;
  std::optional<double> gave_n_;  // force at which a particle begins to move in the next tick
  HeldForce held_;                // held force on a pinned particle
  std::optional<Rest> rest_;      // rest at the current places, even if the hand has come down since
};

// The score in one line, for logs and reports.
std::string text_of(const TaskScore& score);

}  // namespace afm::scene
