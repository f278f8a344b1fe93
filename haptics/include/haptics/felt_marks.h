// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>

#include "haptics/particle_push.h"
#include "haptics/particle_scale.h"
#include "physics/contact_phase.h"
#include "scene/shared/particle_blocks.h"

namespace afm::scene {
class SharedSegment;
}

namespace afm::haptics {

// A sample on which the hand leaves marks, as felt and as published: the one owner of these. All of the force comes
// from it; no law of force acts beside it.
//
// The tip is on the sample, over it, or waits. It waits from a lift() until it has been over all of the sample, with
// every mark published, so that no force comes without a motion of the hand, and a session can begin there. A tip
// beyond the square of the sample waits, too.
//
// Constructors and resume() allocate; everything else may be called in a tick of the servo, by its thread.
// take_back() and put_back() copy up to 2 MB: call them without force.
class FeltMarks {
 public:
  FeltMarks() = default;
  FeltMarks(const FeltMarks&) = delete;
  FeltMarks& operator=(const FeltMarks&) = delete;
  virtual ~FeltMarks() = default;

  // Continues with these tiles, kMarkTiles valid ones; a wait for a lift begins. Throws std::invalid_argument for
  // another number.
  virtual void resume(std::span<const scene::MarkTile> tiles) = 0;

  // Moves the tip: `tip_xy_m` in the sample's frame, `z_m` that of the unbent lever above the sample, in metres of the
  // nanoworld.
  virtual ParticlePush step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept = 0;

  // Takes the tip off the sample, wherever it is.
  virtual void lift() noexcept = 0;

  // Puts the marks back as they were before the newest stroke, or takes all of them away; a wait for a lift begins.
  // Call only without force. False if the tip is on the sample, or if there is nothing to put back. All strokes are
  // forgotten when all marks are removed.
  virtual bool take_back() noexcept = 0;
  virtual bool put_back() noexcept = 0;

  virtual const ParticleScale& scale() const noexcept = 0;
  virtual double stored_j() const noexcept = 0;           // stored energy on the hand
  virtual double stiffness_n_per_m() const noexcept = 0;  // stiffness on the hand
  virtual double apex_z_m() const noexcept = 0;           // height of a tip on the sample
  virtual physics::Phase phase() const noexcept = 0;

  // State after the newest step, without time and tick.
  virtual scene::TipPush push() const noexcept = 0;
  virtual scene::PushSample sample() const noexcept = 0;

  // Next tile that has changed since it was published, which it is from then on; call once a tick, after step().
  virtual std::optional<std::uint32_t> next_tile() noexcept = 0;
  virtual std::span<const scene::MarkTile> tiles() const noexcept = 0;  // tiles as published
};

// The soft sample or the ink of a scene, in the state left by a predecessor; null: there is neither.
std::unique_ptr<FeltMarks> felt_marks_of(scene::SharedSegment& segment, const scene::SharedParticles& particles,
                                         const ParticleScale& scale, std::int64_t period_ns);

}  // namespace afm::haptics
