// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "haptics/particle_push.h"
#include "haptics/particle_scale.h"
#include "physics/contact_phase.h"
#include "physics/manipulation/scratching_tip.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/soft_blocks.h"

namespace afm::scene {
class SharedSegment;
}

namespace afm::haptics {

class MarkHistory;

// A soft sample that the hand scratches, as felt and as published: the one owner of its marks.
//
// - All of the force comes from physics/manipulation, with the lever as soft as a hand can bear (ParticleScale): the
//   gradient of the lever's energy. No law of force acts beside it.
// - The tip is on the sample, over it, or waits. It waits from a lift() until it has been over all of the sample, with
//   every mark published, so that no force comes without a motion of the hand, and a session can begin there. A tip
//   beyond the square of the sample waits, too.
// - A tip that goes farther than kFullWay squares in a tick costs the servo too much time. The lever is then raised, at
//   kMostWay until it is free: a hand that is too fast scratches less, and then nothing. That only takes energy from
//   the lever. It sinks again with the time kSinkS, and the energy that this gives to the lever comes from a tank which
//   holds kTankShare of what the hand has lost to the sample in this contact, kMostTankJ at most. If the tank has too
//   little, the lever stays raised. So no contact gives the hand more than it gave.
//
// The constructor and resume() allocate; everything else may be called in a tick of the servo, by its thread.
// take_back() and put_back() copy up to 2 MB: call them without force.
class FeltScratch {
 public:
  static constexpr double kFullWay = 0.24, kMostWay = 0.36;  // squares per tick; 0.6 and 0.9 nm for a tip of 20 nm
  static constexpr double kSinkS = 0.05;
  static constexpr double kTankShare = 0.5;
  static constexpr double kMostTankJ = 0.03;  // as EnergyTank::kFullJ

  // `particles` is valid (scene::validate) and has a soft sample, `scale` is its particle_scale(). `held_j` in the tank
  // at the start of each contact is for tests alone.
  FeltScratch(const scene::SharedParticles& particles, const ParticleScale& scale, double period_s,
              double held_j = 0.0);
  ~FeltScratch();

  // Continues with these tiles, kMarkTiles valid ones; a wait for a lift begins. Throws std::invalid_argument for
  // another number.
  void resume(std::span<const scene::MarkTile> tiles);

  // Moves the tip: `tip_xy_m` in the sample's frame, `z_m` that of the unbent lever above the sample, in metres of the
  // nanoworld.
  ParticlePush step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept;

  // Takes the tip off the sample, wherever it is.
  void lift() noexcept;

  // Puts the marks back as they were before the newest stroke, or makes the whole sample level again; a wait for a lift
  // begins. Call only without force. False if the tip is on the sample, or if there is nothing to put back. All strokes
  // are forgotten when the sample is made level.
  bool take_back() noexcept;
  bool put_back() noexcept;

  const ParticleScale& scale() const noexcept { return scale_; }
  double stored_j() const noexcept { return stored_j_; }                    // on the hand
  double stiffness_n_per_m() const noexcept { return stiffness_n_per_m_; }  // on the hand
  double held_j() const noexcept { return held_j_; }                        // in the tank
  const physics::ScratchTick& last() const noexcept { return tip_.last(); }
  physics::Phase phase() const noexcept;

  // State after the newest step, without time and tick.
  scene::TipPush push() const noexcept;
  scene::PushSample sample() const noexcept;

  // Next tile that has changed since it was published, which it is from then on; call once a tick, after step().
  std::optional<std::uint32_t> next_tile() noexcept;
  std::span<const scene::MarkTile> tiles() const noexcept { return tiles_; }  // as published

 private:
  enum class Tip { Waits, Over, On };

  void publish(std::uint32_t tile) noexcept;
  void hold_over(const glm::dvec3& at_m) noexcept;
  void touch_down() noexcept;
  void keep_tiles(const physics::Sideways<physics::Length>& place) noexcept;
  double raise(double way, double z_m, double elapsed_s) noexcept;
  void note_events(double lost_before_j, bool raised, ParticlePush& step) noexcept;
  bool waits_for_tiles() const noexcept;

  ParticleScale scale_;
  physics::ScratchingTip tip_;
  std::vector<scene::MarkTile> tiles_;
  std::vector<std::uint64_t> marks_;  // numbers of the tiles
  std::vector<double> highest_m_;     // tops of the tiles
  std::unique_ptr<MarkHistory> strokes_;
  double stiffness_n_per_m_ = 0;
  double fastest_hand_m_per_s_ = 0;
  std::uint64_t digest_ = scene::kSoftDigest;
  std::uint32_t next_ = 0;  // tile from which on a changed one is looked for
  Tip tip_is_ = Tip::Waits;
  glm::dvec3 hand_m_{0.0};  // place of the unbent lever where the hand was last
  glm::dvec3 push_n_{0.0};  // force on the lever
  double rise_m_ = 0;
  double start_held_j_;  // at the start of each contact
  double held_j_;
  double stored_j_ = 0;
  std::uint64_t accounts_ = 0;
  bool marked_ = false, stopped_ = false, raised_ = false;  // in this contact; each is an event once
};

// The soft sample of a scene, as a predecessor left it; null: the sample is not soft.
std::unique_ptr<FeltScratch> felt_scratch_of(scene::SharedSegment& segment, const scene::SharedParticles& particles,
                                             const ParticleScale& scale, std::int64_t period_ns);

}  // namespace afm::haptics
