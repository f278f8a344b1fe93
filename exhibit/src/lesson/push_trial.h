// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "exhibit/lesson/lesson.h"
#include "exhibit/state/particle_task.h"
#include "physics/friction/sideways.h"
#include "physics/units.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// Blind task of a step; empty if the picture is shown.
std::optional<scene::BlindTask> blind_task_of(const PushPlan& plan);

// Digest of the places of a set's spheres before the first push.
std::uint64_t start_digest(const scene::ParticleSet& set);

// A push that a step of a lesson requires, judged and scored by the task of its particles. All of them are at their
// start when it begins. One thread.
class PushTrial {
 public:
  PushTrial(const scene::ParticleSet& set, const PushPlan& plan);
  PushTrial(const PushTrial&) = delete;
  PushTrial& operator=(const PushTrial&) = delete;

  // As in ParticleTask.
  void add(const scene::TipEvent& event);
  void add(const scene::TipSample& sample);

  // As in ParticleTask; true once the push is done, after which it must not be called again.
  bool look(std::span<const scene::ParticlePage> pages);

  const scene::TaskScore& score() const { return lost_ ? *lost_ : task_.score(); }

  // True if the wall must be dark, or the particle of a blind push is at the end of its line; with the newest pages.
  bool dark() const { return task_.dark(); }
  bool far_enough(std::span<const scene::ParticlePage> pages) const { return dark() && task_.far_enough(pages); }

  // Measure of a finished push: root mean square distance from the targets, or from the line, or displacement of the
  // particle, in m; for Threshold the answer divided by the threshold.
  double result() const { return result_; }

 private:
  physics::Length way_of(const physics::Sideways<physics::Length>& place) const;

  PushPlan plan_;
  scene::ParticleSet set_;  // particles with only the required target, if any
  physics::Sideways<physics::Length> start_;
  ParticleTask task_;
  std::int32_t touched_ = scene::kNoParticle;  // particle last touched by the tip
  std::optional<scene::TaskScore> lost_;       // score at the loss that the step asks for
  double result_ = 0;
};

}  // namespace afm::exhibit
