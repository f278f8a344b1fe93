// SPDX-License-Identifier: Apache-2.0
#include "haptics/contact/felt_ink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "mark_history.h"
#include "published_tiles.h"
#include "scene/shared/tip_blocks.h"

namespace afm::haptics {

namespace {

using physics::EventKind;
using physics::Length;

using Squares = std::array<std::uint8_t, physics::InkedSurface::kTileSquares>;

physics::InkedSurface inked_surface_of(const scene::SharedInk& shared) {
  const physics::Ink ink = scene::ink_of(shared);
  const Length reach(scene::ink_reach_m(ink));
  return physics::InkedSurface(ink, {-reach, -reach}, {reach, reach}, Length(0.0),
                               Length(scene::ink_side_m(ink) / scene::kSoftSide));
}

}  // namespace

FeltInk::FeltInk(const scene::SharedParticles& particles, const ParticleScale& scale)
    : scale_(scale),
      thickness_m_(particles.ink.thickness_m),
      reach_m_(scene::ink_reach_m(scene::ink_of(particles.ink))),
      spring_n_per_m_(particles.pusher.normal_spring_n_per_m / scale.softened_upwards),
      pull_n_(scene::meniscus_pull_n(particles.pusher.tip_radius_m, particles.ink.surface_tension_n_per_m)),
      surface_(inked_surface_of(particles.ink)),
      tiles_(std::make_unique<PublishedTiles>()),
      strokes_(std::make_unique<MarkHistory>()) {
  if (surface_.tiles() != scene::kMarkTiles) throw std::logic_error("an inked sample has another number of tiles");
}

FeltInk::~FeltInk() = default;

void FeltInk::resume(std::span<const scene::MarkTile> tiles) {
  if (tiles.size() != scene::kMarkTiles) throw std::invalid_argument("the tiles are those of another sample");
  for (std::uint32_t i = 0; i < tiles.size(); ++i) {
    put(i, tiles[i]);
    publish(i);
  }
  *strokes_ = MarkHistory();
  lift();
}

void FeltInk::put(std::uint32_t tile, const scene::MarkTile& squares) noexcept {
  Squares covered{};
  std::transform(squares.pressed_m.begin(), squares.pressed_m.end(), covered.begin(),
                 [](double height_m) { return static_cast<std::uint8_t>(height_m != 0.0 ? 1 : 0); });
  surface_.put_tile(tile, covered);
}

void FeltInk::publish(std::uint32_t tile) noexcept {
  Squares covered;
  surface_.copy_tile(tile, covered);
  surface_.kept(tile);
  std::transform(covered.begin(), covered.end(), tiles_->next(tile).pressed_m.begin(),
                 [this](std::uint8_t square) { return square != 0 ? thickness_m_ : 0.0; });
  tiles_->publish(tile);
}

std::optional<std::uint32_t> FeltInk::next_tile() noexcept {
  const auto tile = tiles_->changed(surface_);
  if (!tile) return tile;
  if (tip_is_ == Tip::On) keep(*tile);
  publish(*tile);
  return tile;
}

std::span<const scene::MarkTile> FeltInk::tiles() const noexcept { return tiles_->all(); }

// A stroke begins with every tile published, so that a tile is as it was before until it is published again.
void FeltInk::keep(std::uint32_t tile) noexcept {
  if (!strokes_->keeps(tile)) strokes_->keep(tile, tiles_->at(tile));
}

void FeltInk::keep_changed() noexcept {
  for (std::uint32_t i = 0; i < scene::kMarkTiles; ++i) {
    if (surface_.changed(i)) keep(i);
  }
}

void FeltInk::lift() noexcept {
  if (tip_is_ == Tip::On) {
    keep_changed();
    lost_j_ += bent_j_;
  }
  surface_.lift();
  tip_is_ = Tip::Waits;
  bent_j_ = 0.0;
  speed_m_per_s_ = 0.0;
}

bool FeltInk::take_back() noexcept {
  if (tip_is_ == Tip::On) return false;
  lift();
  return strokes_->take_back([this](std::uint32_t tile, const scene::MarkTile& before) { put(tile, before); });
}

bool FeltInk::put_back() noexcept {
  if (tip_is_ == Tip::On) return false;
  lift();
  const scene::MarkTile bare;
  bool moved = false;
  for (std::uint32_t i = 0; i < scene::kMarkTiles; ++i) {
    if (tiles_->is_bare(i) && !surface_.changed(i)) continue;
    put(i, bare);
    moved = true;
  }
  while (strokes_->take_back([](std::uint32_t, const scene::MarkTile&) {})) {
  }
  return moved;
}

void FeltInk::touch_down() noexcept {
  tip_is_ = Tip::On;
  lost_j_ = flowed_s_ = speed_m_per_s_ = 0.0;
  ++accounts_;
  strokes_->begin();
}

ParticlePush FeltInk::step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept {
  ParticlePush step;
  const glm::dvec3 at_m(tip_xy_m, z_m), before_m = hand_m_;
  const bool on_square = std::abs(at_m.x) <= reach_m_ && std::abs(at_m.y) <= reach_m_;  // false for NaN, too
  if (!std::isfinite(z_m) || !on_square) {
    lift();
    return step;
  }
  hand_m_ = at_m;
  if (tip_is_ == Tip::On && z_m >= scale_.clear_z_m) {
    step.add({EventKind::LiquidTorn, pull_n_, 0.0});
    lift();
    return step;
  }
  if (tip_is_ == Tip::Waits && z_m >= scale_.clear_z_m && !tiles_->wait(surface_)) tip_is_ = Tip::Over;
  if (tip_is_ == Tip::Waits || (tip_is_ == Tip::Over && z_m > 0.0)) return step;
  const double load_n = -spring_n_per_m_ * z_m;
  if (tip_is_ == Tip::Over) {
    touch_down();
    step.add({EventKind::InkFlows, 0.0, load_n});
  } else if (elapsed_s > 0.0) {
    const double now_m_per_s = glm::length(tip_xy_m - glm::dvec2(before_m)) / elapsed_s;
    speed_m_per_s_ += -std::expm1(-elapsed_s / kMeanS) * (now_m_per_s - speed_m_per_s_);
  }
  surface_.touch({Length(at_m.x), Length(at_m.y)}, physics::Time(elapsed_s), kMostLooks);
  flowed_s_ += elapsed_s;
  bent_j_ = 0.5 * spring_n_per_m_ * z_m * z_m;
  step.near = true;
  step.touches = true;
  step.push_n = {0.0, 0.0, load_n};
  return step;
}

physics::Phase FeltInk::phase() const noexcept {
  if (tip_is_ == Tip::Waits) return physics::Phase::WaitForLift;
  return tip_is_ == Tip::On ? physics::Phase::Attached : physics::Phase::Free;
}

scene::TipPush FeltInk::push() const noexcept {
  scene::TipPush push = push_on(scale_);
  push.digest = sample().digest;
  push.given_j = push.work_j = lost_j_ + bent_j_;
  push.lost_j = lost_j_;
  push.stored_j = bent_j_;
  push.accounts = accounts_;
  push.met = tip_is_ == Tip::Waits ? 0 : 1;
  push.strokes = static_cast<std::uint16_t>(strokes_->size());
  push.ink = {.covered_m2 = surface_.covered().si, .flowed_s = flowed_s_, .speed_m_per_s = speed_m_per_s_};
  if (tip_is_ != Tip::Waits) push.base_m = push.apex_m = {hand_m_.x, hand_m_.y, hand_m_.z};
  if (tip_is_ != Tip::On) return push;
  push.apex_m[2] = 0.0;
  push.lift_n = sample().lift_n;
  push.state = physics::PushState::Slides;
  return push;
}

scene::PushSample FeltInk::sample() const noexcept {
  scene::PushSample sample{.digest = tiles_->digest(surface_)};
  if (tip_is_ != Tip::On) return sample;
  sample.lift_n = -spring_n_per_m_ * hand_m_.z;
  sample.state = physics::PushState::Slides;
  return sample;
}

}  // namespace afm::haptics
