// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/samples/pattern_task.h"
#include "scene/shared/tip_blocks.h"

namespace afm::servo {
class LivePicture;
struct ReplayedTick;
}  // namespace afm::servo

namespace afm::exhibit {

// Task of a set of particles, derived from the servo's data, live or replayed. One thread.
class ParticleTask {
 public:
  // `set` has a task (scene::has_task()) and must outlive the object.
  explicit ParticleTask(const scene::ParticleSet& set);

  // Call in order of time, with the events of a tick before its sample. `truth`: the particles themselves are seen, not
  // a picture of them; ignored in blind tasks.
  void add(const scene::TipEvent& event) { task_.add(event.kind, event.force_before_n); }
  void add(const scene::TipSample& sample, bool truth = true);

  // Call with the newest pages after the newest sample: ends the task if these are the places that it waits for.
  // True if it ended. With a picture, it ends only once all that was pushed has been measured, by the measured places.
  bool look(std::span<const scene::ParticlePage> pages, const servo::LivePicture* picture = nullptr);

  // True if the wall must be dark (scene::PatternTask::dark()).
  bool dark() const { return task_.dark(); }

  // True once the particle of a task along a line has gone far enough, so that the tip may be lifted.
  bool far_enough(std::span<const scene::ParticlePage> pages) const;

  // Places of all particles, if the pages hold those that the task waits for; for a criterion other than the
  // pattern, which then ends the task by end().
  std::optional<std::vector<physics::ParticlePlace>> unjudged(std::span<const scene::ParticlePage> pages) const;
  void end(physics::Length rms) { task_.end(rms); }

  // All of these calls for one tick of a replay.
  void hear(const servo::ReplayedTick& tick);

  const scene::TaskScore& score() const { return task_.score(); }

 private:
  const scene::ParticleSet& set_;
  scene::PatternTask task_;
};

}  // namespace afm::exhibit
