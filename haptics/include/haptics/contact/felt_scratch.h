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

#include "haptics/felt_marks.h"
#include "physics/manipulation/scratching_tip.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/soft_blocks.h"

namespace afm::haptics {

class MarkHistory;
class PublishedTiles;

// A soft sample that the hand scratches.
//
// - All of the force comes from physics/manipulation, with the lever as soft as a hand can bear (ParticleScale): the
//   gradient of the lever's energy.
// - A tip that goes farther than kFullWay squares in a tick costs the servo too much time. The lever is then raised, at
//   kMostWay until it is free: a hand that is too fast scratches less, and then nothing. That only takes energy from
//   the lever. It sinks again with the time kSinkS, and the energy that this gives to the lever comes from a tank which
//   holds kTankShare of what the hand has lost to the sample in this contact, kMostTankJ at most. If the tank has too
//   little, the lever stays raised. So no contact gives the hand more energy than the hand put in.
class FeltScratch final : public FeltMarks {
 public:
  static constexpr double kFullWay = 0.24, kMostWay = 0.36;  // squares per tick; 0.6 and 0.9 nm for a tip of 20 nm
  static constexpr double kSinkS = 0.05;
  static constexpr double kTankShare = 0.5;
  static constexpr double kMostTankJ = 0.03;  // largest energy in the tank, equal to EnergyTank::kFullJ

  // `particles` is valid (scene::validate) and has a soft sample, `scale` is its particle_scale(). `held_j` in the tank
  // at the start of each contact is for tests alone.
  FeltScratch(const scene::SharedParticles& particles, const ParticleScale& scale, double period_s,
              double held_j = 0.0);
  ~FeltScratch() override;

  void resume(std::span<const scene::MarkTile> tiles) override;
  ParticlePush step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept override;
  void lift() noexcept override;
  bool take_back() noexcept override;
  bool put_back() noexcept override;

  const ParticleScale& scale() const noexcept override { return scale_; }
  double stored_j() const noexcept override { return stored_j_; }
  double stiffness_n_per_m() const noexcept override { return stiffness_n_per_m_; }
  double apex_z_m() const noexcept override { return tip_.last().apex.z.si; }
  physics::Phase phase() const noexcept override;
  scene::TipPush push() const noexcept override;
  scene::PushSample sample() const noexcept override;
  std::optional<std::uint32_t> next_tile() noexcept override;
  std::span<const scene::MarkTile> tiles() const noexcept override;

  double held_j() const noexcept { return held_j_; }  // energy in the tank
  const physics::ScratchTick& last() const noexcept { return tip_.last(); }

 private:
  enum class Tip { Waits, Over, On };

  void publish(std::uint32_t tile) noexcept;
  void hold_over(const glm::dvec3& at_m) noexcept;
  void touch_down() noexcept;
  void keep_tiles(const physics::Sideways<physics::Length>& place) noexcept;
  double raise(double way, double z_m, double elapsed_s) noexcept;
  void note_events(double lost_before_j, bool raised, ParticlePush& step) noexcept;

  ParticleScale scale_;
  physics::ScratchingTip tip_;
  std::unique_ptr<PublishedTiles> tiles_;
  std::vector<double> highest_m_;  // highest height of each tile
  std::unique_ptr<MarkHistory> strokes_;
  double stiffness_n_per_m_ = 0;
  double fastest_hand_m_per_s_ = 0;
  Tip tip_is_ = Tip::Waits;
  glm::dvec3 hand_m_{0.0};  // last position of the unbent lever below the hand
  glm::dvec3 push_n_{0.0};  // force on the lever
  double rise_m_ = 0;
  double start_held_j_;  // energy in the tank at the start of each contact
  double held_j_;
  double stored_j_ = 0;
  std::uint64_t accounts_ = 0;
  bool marked_ = false, stopped_ = false, raised_ = false;  // events already reported in this contact
};

}  // namespace afm::haptics
