// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

#include "haptics/felt_marks.h"
#include "physics/manipulation/ink.h"
#include "scene/shared/particle_blocks.h"
#include "scene/shared/soft_blocks.h"

namespace afm::haptics {

class MarkHistory;
class PublishedTiles;

// Ink that the hand writes with a tip.
//
// - The hand feels the lever, as soft as a hand can bear, which presses on a hard, flat sample or is held by the liquid
//   between tip and sample: -k z, from the touch at z = 0 up to the height where the lever pulls as much as the liquid,
//   4 pi R gamma. There the tip comes off, and what the lever stored is lost. Nothing acts sideways. So no contact
//   gives the hand more energy than the hand put in.
// - Ink flows as long as the tip touches, however hard. In a tick the tip looks at kMostLooks squares at most; ink for
//   which it finds none flows a little later.
class FeltInk final : public FeltMarks {
 public:
  static constexpr std::size_t kMostLooks = 2048;
  static constexpr double kMeanS = 0.1;  // averaging time of the published speed

  // `particles` is valid (scene::validate) and has ink, `scale` is its particle_scale().
  FeltInk(const scene::SharedParticles& particles, const ParticleScale& scale);
  ~FeltInk() override;

  void resume(std::span<const scene::MarkTile> tiles) override;
  ParticlePush step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept override;
  void lift() noexcept override;
  bool take_back() noexcept override;
  bool put_back() noexcept override;

  const ParticleScale& scale() const noexcept override { return scale_; }
  double stored_j() const noexcept override { return scale_.hand_n_per_n * scale_.hand_m_per_m * bent_j_; }
  double stiffness_n_per_m() const noexcept override {
    return spring_n_per_m_ * scale_.hand_n_per_n / scale_.hand_m_per_m;
  }
  double apex_z_m() const noexcept override { return 0.0; }
  physics::Phase phase() const noexcept override;
  scene::TipPush push() const noexcept override;
  scene::PushSample sample() const noexcept override;
  std::optional<std::uint32_t> next_tile() noexcept override;
  std::span<const scene::MarkTile> tiles() const noexcept override;

  const physics::InkedSurface& surface() const noexcept { return surface_; }

 private:
  enum class Tip { Waits, Over, On };

  void put(std::uint32_t tile, const scene::MarkTile& squares) noexcept;
  void publish(std::uint32_t tile) noexcept;
  void keep_changed() noexcept;
  void keep(std::uint32_t tile) noexcept;
  void touch_down() noexcept;

  ParticleScale scale_;
  double thickness_m_, reach_m_;
  double spring_n_per_m_;  // normal stiffness of the softened lever
  double pull_n_;          // pull of the liquid at which the tip comes off
  physics::InkedSurface surface_;
  std::unique_ptr<PublishedTiles> tiles_;
  std::unique_ptr<MarkHistory> strokes_;
  Tip tip_is_ = Tip::Waits;
  glm::dvec3 hand_m_{0.0};  // last position of the unbent lever below the hand
  double bent_j_ = 0;       // energy stored in the bent lever
  double lost_j_ = 0;       // energy lost since the newest touch
  double flowed_s_ = 0, speed_m_per_s_ = 0;
  std::uint64_t accounts_ = 0;
};

}  // namespace afm::haptics
