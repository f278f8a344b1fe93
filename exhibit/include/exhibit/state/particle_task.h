// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "scene/samples/pattern_task.h"
#include "scene/shared/tip_blocks.h"

namespace afm::servo {
struct ReplayedTick;
}

namespace afm::exhibit {

// The task of a set of particles, from what a servo publishes, live or replayed. One thread.
class ParticleTask {
 public:
  // `set` has targets and must outlive the object.
  explicit ParticleTask(const scene::ParticleSet& set);

  // Call in order of time, with the events of a tick before its sample.
  void add(const scene::TipEvent& event) { task_.add(event.kind); }
  void add(const scene::TipSample& sample);

  // Call with the newest pages after the newest sample: ends the task if these are the places that it waits to see.
  // True if it ended.
  bool look(std::span<const scene::ParticlePage> pages);

  // All of that for a tick of a replay.
  void hear(const servo::ReplayedTick& tick);

  const scene::TaskScore& score() const { return task_.score(); }

 private:
  const scene::ParticleSet& set_;
  scene::PatternTask task_;
};

}  // namespace afm::exhibit
