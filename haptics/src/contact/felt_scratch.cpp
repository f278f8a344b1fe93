// SPDX-License-Identifier: Apache-2.0
#include "haptics/contact/felt_scratch.h"

#include <algorithm>
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

constexpr double kLeastRiseM = 1e-12;

physics::LeverBase lever_at(const glm::dvec3& at_m) { return {{Length(at_m.x), Length(at_m.y)}, Length(at_m.z)}; }

physics::ScratchingTip scratching_tip_of(const scene::SharedParticles& particles, const ParticleScale& scale) {
  const scene::SharedPusher& pusher = particles.pusher;
  const Length reach(scene::soft_reach_m(pusher.tip_radius_m));
  return physics::ScratchingTip({Length(pusher.tip_radius_m), pusher.half_angle_rad}, felt_springs(pusher, scale),
                                scene::soft_surface(particles.soft), {-reach, -reach}, {reach, reach},
                                lever_at({0.0, 0.0, scale.clear_z_m}));
}

}  // namespace

FeltScratch::FeltScratch(const scene::SharedParticles& particles, const ParticleScale& scale, double period_s,
                         double held_j)
    : scale_(scale),
      tip_(scratching_tip_of(particles, scale)),
      tiles_(std::make_unique<PublishedTiles>()),
      highest_m_(scene::kMarkTiles),
      strokes_(std::make_unique<MarkHistory>()),
      start_held_j_(held_j),
      held_j_(held_j) {
  if (tip_.surface().tiles() != scene::kMarkTiles) throw std::logic_error("a soft sample has another number of tiles");
  const physics::PushSprings springs = felt_springs(particles.pusher, scale);
  stiffness_n_per_m_ = std::max(springs.lateral, springs.normal).si * scale.hand_n_per_n / scale.hand_m_per_m;
  fastest_hand_m_per_s_ = kFullWay * tip_.surface().spacing().si * scale.hand_m_per_m / period_s;
}

FeltScratch::~FeltScratch() = default;

void FeltScratch::resume(std::span<const scene::MarkTile> tiles) {
  if (tiles.size() != scene::kMarkTiles) throw std::invalid_argument("the tiles are those of another sample");
  physics::MarkedSurface& surface = tip_.surface_below();
  for (std::uint32_t i = 0; i < tiles.size(); ++i) {
    surface.put_tile(i, tiles[i].pressed_m, tiles[i].back_m);
    publish(i);
  }
  *strokes_ = MarkHistory();
  lift();
}

void FeltScratch::publish(std::uint32_t tile) noexcept {
  scene::MarkTile& squares = tiles_->next(tile);
  physics::MarkedSurface& surface = tip_.surface_below();
  surface.copy_tile(tile, squares.pressed_m, squares.back_m);
  surface.kept(tile);
  double highest_m = 0.0;
  for (std::size_t i = 0; i < squares.pressed_m.size(); ++i) {
    highest_m = std::max(highest_m, squares.pressed_m[i] + squares.back_m[i]);
  }
  highest_m_[tile] = highest_m;
  tiles_->publish(tile);
}

std::optional<std::uint32_t> FeltScratch::next_tile() noexcept {
  const auto tile = tiles_->changed(tip_.surface());
  if (tile) publish(*tile);
  return tile;
}

std::span<const scene::MarkTile> FeltScratch::tiles() const noexcept { return tiles_->all(); }

void FeltScratch::lift() noexcept {
  if (tip_is_ == Tip::On && !marked_) strokes_->forget_this();
  tip_is_ = Tip::Waits;
  push_n_ = glm::dvec3(0.0);
  stored_j_ = 0.0;
  rise_m_ = 0.0;
}

bool FeltScratch::take_back() noexcept {
  if (tip_is_ == Tip::On) return false;
  lift();
  return strokes_->take_back([this](std::uint32_t tile, const scene::MarkTile& before) {
    tip_.surface_below().put_tile(tile, before.pressed_m, before.back_m);
  });
}

bool FeltScratch::put_back() noexcept {
  if (tip_is_ == Tip::On) return false;
  lift();
  const scene::MarkTile level;
  bool moved = false;
  for (std::uint32_t i = 0; i < scene::kMarkTiles; ++i) {
    if (tiles_->is_bare(i) && !tip_.surface().changed(i)) continue;
    tip_.surface_below().put_tile(i, level.pressed_m, level.back_m);
    moved = true;
  }
  while (strokes_->take_back([](std::uint32_t, const scene::MarkTile&) {})) {
  }
  return moved;
}

// Begins a contact, which from here on depends only on the surface as published.
void FeltScratch::touch_down() noexcept {
  tip_.hold_over(lever_at(hand_m_));
  tip_is_ = Tip::On;
  rise_m_ = 0.0;
  held_j_ = start_held_j_;
  ++accounts_;
  strokes_->begin();
  marked_ = stopped_ = raised_ = false;
}

void FeltScratch::keep_tiles(const physics::Sideways<Length>& place) noexcept {
  tip_.surface().tiles_below(place, [this](std::size_t number) {
    const auto tile = static_cast<std::uint32_t>(number);
    if (strokes_->keeps(tile)) return;
    scene::MarkTile before;
    tip_.surface().copy_tile(tile, before.pressed_m, before.back_m);
    strokes_->keep(tile, before);
  });
}

// Moves the lever up or down where the hand was. Returns the energy on the hand that this has given to the lever.
double FeltScratch::raise(double way, double z_m, double elapsed_s) noexcept {
  const double share = std::clamp((way - kFullWay) / (kMostWay - kFullWay), 0.0, 1.0);
  const double wanted_m = share * std::max(0.0, tip_.surface().highest().si - std::min(z_m, hand_m_.z));
  if (share >= 1.0 && tip_.last().stored.si > 0.0) {  // lever free of the sample at once
    rise_m_ = std::max(rise_m_, wanted_m);
    tip_.hold_over(lever_at({hand_m_.x, hand_m_.y, hand_m_.z + rise_m_}));
    ++accounts_;
    return 0.0;
  }
  const double most_down_m = 0.5 * tip_.surface().spacing().si;
  double next_m = std::max({wanted_m, rise_m_ * std::exp(-elapsed_s / kSinkS), rise_m_ - most_down_m});
  if (next_m < kLeastRiseM) next_m = wanted_m;
  if (next_m == rise_m_) return 0.0;
  const double down_m = std::max(0.0, rise_m_ - next_m), hand_j_per_j = scale_.hand_n_per_n * scale_.hand_m_per_m;
  // a lever that is lowered bends by no more than that, whatever gives below it
  const double load_n = std::max(0.0, tip_.last().load.si) + 0.5 * tip_.normal_spring().si * down_m;
  if (hand_j_per_j * load_n * down_m > held_j_) return 0.0;
  const double before_j = tip_.last().given.si;
  tip_.lift_base(Length(next_m - rise_m_));
  rise_m_ = next_m;
  if (down_m == 0.0) return 0.0;
  const double given_j = hand_j_per_j * std::max(0.0, tip_.last().given.si - before_j);
  held_j_ = std::max(0.0, held_j_ - given_j);
  return given_j;
}

ParticlePush FeltScratch::step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept {
  ParticlePush step;
  const glm::dvec3 at_m(tip_xy_m, z_m);
  if (!std::isfinite(z_m) || !tip_.surface().holds(lever_at(at_m).position)) {
    lift();
    return step;
  }
  if (z_m >= tip_.surface().highest().si) {
    hold_over(at_m);
    return step;
  }
  if (tip_is_ == Tip::Waits) return step;
  if (tip_is_ == Tip::Over) touch_down();

  const double lost_before_j = tip_.last().lost.si, load_before_n = tip_.last().load.si;
  const bool was_raised = rise_m_ > 0.0;
  step.given_j = raise(glm::length(tip_xy_m - glm::dvec2(hand_m_)) / tip_.surface().spacing().si, z_m, elapsed_s);
  keep_tiles(lever_at(at_m).position);
  keep_tiles(tip_.last().apex.position);
  // the tank's own energy does not fill it
  const double lost_by_tank_j = tip_.last().lost.si;
  const physics::ScratchTick& tick = tip_.move_to(lever_at({at_m.x, at_m.y, at_m.z + rise_m_}));
  hand_m_ = at_m;
  if (tick.lagging && rise_m_ == 0.0) {  // tip left behind by a stall of the servo
    lift();
    return step;
  }
  const double hand_j_per_j = scale_.hand_n_per_n * scale_.hand_m_per_m;
  const double filled_j = held_j_ + kTankShare * hand_j_per_j * (tick.lost.si - lost_by_tank_j);
  held_j_ = std::max(held_j_, std::min(kMostTankJ, filled_j));
  push_n_ = {tick.lateral.x.si, tick.lateral.y.si, tick.load.si};
  stored_j_ = hand_j_per_j * tick.stored.si;
  step.near = true;
  step.touches = tick.load.si > 0.0;
  step.push_n = push_n_;
  note_events(lost_before_j, !was_raised && rise_m_ > 0.0 && load_before_n > 0.0, step);
  return step;
}

// Holds the tip over the sample, where it no longer waits once every mark has been published.
void FeltScratch::hold_over(const glm::dvec3& at_m) noexcept {
  if (tip_is_ == Tip::On) lift();
  if (tip_is_ == Tip::Waits && tiles_->wait(tip_.surface())) return;
  if (tip_is_ == Tip::Waits) {
    tip_.surface_below().lower_highest(Length(*std::max_element(highest_m_.begin(), highest_m_.end())));
  }
  tip_is_ = Tip::Over;
  hand_m_ = at_m;
}

void FeltScratch::note_events(double lost_before_j, bool raised, ParticlePush& step) noexcept {
  const physics::ScratchTick& tick = tip_.last();
  const double load_n = tick.load.si;
  if (!marked_ && tick.lost.si > lost_before_j) {
    marked_ = true;
    step.add({EventKind::SurfaceMarked, 0.0, load_n});
  }
  if (!stopped_ && tick.stops) {
    stopped_ = true;
    step.add({EventKind::TipStopped, load_n, load_n});
  }
  if (!raised_ && raised) {
    raised_ = true;
    step.add({EventKind::HandTooFast, 0.0, load_n});
  }
  if (rise_m_ == 0.0) raised_ = false;
}

physics::Phase FeltScratch::phase() const noexcept {
  if (tip_is_ == Tip::Waits) return physics::Phase::WaitForLift;
  return push_n_ == glm::dvec3(0.0) ? physics::Phase::Free : physics::Phase::Attached;
}

scene::TipPush FeltScratch::push() const noexcept {
  const physics::ScratchTick& tick = tip_.last();
  scene::TipPush push = push_on(scale_);
  push.digest = sample().digest;
  push.given_j = tick.given.si;
  push.work_j = tick.work.si;
  push.lost_j = tick.lost.si;
  push.stored_j = tick.stored.si;
  push.exhausted = tick.exhausted;
  push.accounts = accounts_;
  push.met = tip_is_ == Tip::Waits ? 0 : 1;
  push.strokes = static_cast<std::uint16_t>(strokes_->size());
  push.rise_m = rise_m_;
  push.fastest_hand_m_per_s = fastest_hand_m_per_s_;
  if (tip_is_ == Tip::Over) push.base_m = push.apex_m = {hand_m_.x, hand_m_.y, hand_m_.z};
  if (tip_is_ != Tip::On) return push;
  push.base_m = {tick.base.position.x.si, tick.base.position.y.si, tick.base.z.si};
  push.apex_m = {tick.apex.position.x.si, tick.apex.position.y.si, tick.apex.z.si};
  push.lateral_n = {push_n_.x, push_n_.y};
  push.lift_n = push_n_.z;
  push.state = sample().state;
  push.lagging = tick.lagging ? 1 : 0;
  return push;
}

scene::PushSample FeltScratch::sample() const noexcept {
  scene::PushSample sample{.digest = tiles_->digest(tip_.surface())};
  if (tip_is_ != Tip::On) return sample;
  sample.lateral_n = {push_n_.x, push_n_.y};
  sample.lift_n = push_n_.z;
  const physics::ScratchState state = tip_.last().state;
  if (state == physics::ScratchState::Holds) sample.state = physics::PushState::Holds;
  if (state == physics::ScratchState::Marks) sample.state = physics::PushState::Slides;
  return sample;
}

}  // namespace afm::haptics
