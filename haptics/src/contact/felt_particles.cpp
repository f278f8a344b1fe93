// SPDX-License-Identifier: Apache-2.0
#include "haptics/felt_particles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "haptics/contact/sweeping_scan.h"
#include "physics/manipulation/particle_friction.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/manipulation/tip_hold.h"
#include "scene/shared/tip_blocks.h"

namespace afm::haptics {

namespace {

using physics::EventKind;
using physics::Length;

physics::LeverBase base_at(const glm::dvec3& at_m) { return {{Length(at_m.x), Length(at_m.y)}, Length(at_m.z)}; }

glm::dvec2 flat(const physics::Sideways<Length>& place) { return {place.x.si, place.y.si}; }

physics::ParticlePlace place_of(const scene::ParticlePose& pose) {
  return {{Length(pose.x_m), Length(pose.y_m)}, scene::turn_of(pose)};
}

// Orientation after rolling by a way much shorter than the radius.
std::array<double, 4> rolled(const std::array<double, 4>& orientation, const glm::dvec2& way_m, double radius_m) {
  // the tangent of half the angle, about z x way
  const double half = 0.5 * glm::length(way_m) / radius_m, tangent = 1.0 + half * half / 3.0;
  const double x = -0.5 * tangent * way_m.y / radius_m, y = 0.5 * tangent * way_m.x / radius_m;
  const auto& [w0, x0, y0, z0] = orientation;
  const double w1 = w0 - x * x0 - y * y0, x1 = x0 + x * w0 + y * z0, y1 = y0 + y * w0 - x * z0,
               z1 = z0 + x * y0 - y * x0;
  const double length = std::sqrt(w1 * w1 + x1 * x1 + y1 * y1 + z1 * z1);
  return {w1 / length, x1 / length, y1 / length, z1 / length};
}

// Orientation after a turn about the vertical, by a factor of the small angle between two ways from the tip.
std::array<double, 4> spun(const std::array<double, 4>& orientation, const glm::dvec2& from, const glm::dvec2& to,
                           double factor) {
  const double lengths = glm::length(from) * glm::length(to);
  const double quarter = (from.x * to.y - from.y * to.x) / (lengths + glm::dot(from, to));  // tangent of half the angle
  const double half = factor * quarter * (1.0 - quarter * quarter / 3.0), z = half * (1.0 + half * half / 3.0);
  const auto& [w0, x0, y0, z0] = orientation;
  const double length = std::sqrt(1.0 + z * z);
  return {(w0 - z * z0) / length, (x0 - z * y0) / length, (y0 + z * x0) / length, (z0 + z * w0) / length};
}

}  // namespace

FeltParticles::FeltParticles(const scene::SharedParticles& particles, const ParticleScale& scale,
                             const GrooveLimits& groove)
    : scale_(scale),
      setup_(felt_setup(particles, scale)),
      particles_(setup_, scene::start_places(particles), base_at({0.0, 0.0, scale.clear_z_m})),
      pages_(scene::pages_of(particles.count)),
      strokes_(particles.count),
      drift_(particles.level),
      meeting_(setup_),
      groove_(groove, scale.hand_m_per_m),
      stiffness_n_per_m_(std::max(setup_.springs.lateral, setup_.springs.normal).si * scale.hand_n_per_n /
                         scale.hand_m_per_m),
      level_(particles.level.level) {
  const double sine = std::sin(setup_.tip.half_angle_rad), cosine = std::cos(setup_.tip.half_angle_rad);
  for (physics::ParticleSpecies species : setup_.species) {
    const physics::TipGrip grip = physics::flank_grip(setup_.tip, species, setup_.tip_friction);
    if (physics::turns_flat(species)) {  // no other law than the measured threshold
      other_threshold_n_.push_back(0.0);
      continue;
    }
    species.law = scene::other_law(species.law);
    const double other_n = physics::push_balance(species, grip, sine, cosine).lateral.si;
    const bool known =
        species.law == physics::ParticleLaw::Amontons ? species.coefficient > 0.0 : species.shear_strength.si > 0.0;
    other_threshold_n_.push_back(known && std::isfinite(other_n) ? other_n : 0.0);
  }
  changed_.reserve(pages_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    pose(i) = {.x_m = particles_.position(i).x.si, .y_m = particles_.position(i).y.si};
    if (turns_flat(i)) scene::set_turn(pose(i), particles_.turn(i));
  }
  digest_ = scene::digest_of(pages_, particles_.size());
  start_ = pages_;
  if (level_ > 0) sweeping_ = std::make_unique<SweepingScan>(particles);
}

FeltParticles::~FeltParticles() = default;

void FeltParticles::resume(std::span<const scene::ParticlePage> pages) {
  if (pages.size() != pages_.size()) throw std::invalid_argument("the pages are those of other particles");
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    const scene::ParticlePose& there = pages[i / scene::kPosesPerPage].poses[i % scene::kPosesPerPage];
    if ((there.rod != 0) != turns_flat(i)) throw std::invalid_argument("the pages are those of other particles");
  }
  std::vector<physics::ParticlePlace> places;
  places.reserve(particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    places.push_back(place_of(pages[i / scene::kPosesPerPage].poses[i % scene::kPosesPerPage]));
  }
  particles_.put(places, base_at({0.0, 0.0, scale_.clear_z_m}));
  std::copy(pages.begin(), pages.end(), pages_.begin());
  for (std::uint32_t i = 0; i < particles_.size(); ++i) {
    if (pose(i).moved != physics::PushState::Carried) continue;
    const glm::dvec2 at_m = flat(particles_.free_place(i));
    pose(i).x_m = at_m.x;
    pose(i).y_m = at_m.y;
    pose(i).moved = physics::PushState::Several;
    particles_.put(i, place_of(pose(i)));
  }
  digest_ = scene::digest_of(pages_, particles_.size());
  strokes_ = StrokeHistory(particles_.size());
  end_sweep();
  lift();
}

void FeltParticles::take_over(FeltParticles& before) noexcept {
  before.drop();
  lift();
  std::swap(pages_, before.pages_);
  std::swap(changed_, before.changed_);
  std::swap(strokes_, before.strokes_);
  if (level_ == before.level_) drift_ = before.drift_;
  groove_.drop();
  groove_.follow(before.groove_.plan());
  digest_ = before.digest_;
  accounts_ = before.accounts_;
  const physics::PushTick &was = before.particles_.last(), &is = particles_.last();
  yields_before_ = before.yields_before_ + was.yields - is.yields;
  exhausted_before_ = before.exhausted_before_ + was.exhausted - is.exhausted;
  for (std::size_t i = 0; i < particles_.size(); ++i) particles_.put(i, place_of(pose(i)));
}

bool FeltParticles::turns_flat(std::size_t particle) const noexcept {
  return physics::turns_flat(setup_.species[particles_.species(particle)]);
}

scene::ParticlePose& FeltParticles::pose(std::size_t particle) noexcept {
  return pages_[particle / scene::kPosesPerPage].poses[particle % scene::kPosesPerPage];
}

bool FeltParticles::carries() const noexcept {
  return tip_ == Tip::Among && particles_.last().state == physics::PushState::Carried;
}

void FeltParticles::put_carried_back() noexcept {
  const std::size_t carried = particles_.last().particle;
  particles_.hold_over(base_at(over_m_));
  lay_down(carried);
}

// Sets a sphere that hung on the tip down at its place in the physics.
void FeltParticles::lay_down(std::size_t particle) noexcept {
  scene::ParticlePose lies = pose(particle);
  const glm::dvec2 at_m = flat(particles_.position(particle));
  lies.x_m = at_m.x;
  lies.y_m = at_m.y;
  lies.moved = physics::PushState::Several;
  change(static_cast<std::uint32_t>(particle), lies);
}

void FeltParticles::lift() noexcept {
  if (carries()) put_carried_back();
  tip_ = Tip::Waits;
  spun_ = scene::kNoParticle;
  push_n_ = glm::dvec3(0.0);
  stored_j_ = 0.0;
}

void FeltParticles::drop() noexcept {
  lift();
  groove_.drop();
}

bool FeltParticles::take_back() noexcept {
  if (tip_ == Tip::Among) return false;
  lift();
  end_sweep();
  return strokes_.take_back(
      [this](std::uint32_t particle, const scene::ParticlePose& before) { put(particle, before); });
}

bool FeltParticles::put_back() noexcept {
  if (tip_ == Tip::Among) return false;
  lift();
  end_sweep();
  strokes_.begin();
  bool moved = drift_.drifts();
  drift_.begin_again();
  for (std::uint32_t i = 0; i < particles_.size(); ++i) {
    const scene::ParticlePose& start = start_[scene::page_of(i)].poses[i % scene::kPosesPerPage];
    if (pose(i) == start) continue;
    strokes_.keep(i, pose(i));
    put(i, start);
    moved = true;
  }
  return moved;
}

// Call hold_over() before the tip meets a particle again.
void FeltParticles::put(std::uint32_t particle, const scene::ParticlePose& there) noexcept {
  particles_.put(particle, place_of(there));
  change(particle, there);
}

void FeltParticles::change(std::uint32_t particle, const scene::ParticlePose& now) noexcept {
  scene::ParticlePose& before = pose(particle);
  digest_ += scene::place_mark(particle, now) - scene::place_mark(particle, before);
  before = now;
  const std::uint32_t page = scene::page_of(particle);
  if (std::find(changed_.begin(), changed_.end(), page) == changed_.end()) changed_.push_back(page);
}

ParticlePush FeltParticles::step(const glm::dvec2& tip_xy_m, double z_m, double elapsed_s) noexcept {
  ParticlePush step;
  const glm::dvec3 at_m(tip_xy_m - drift_.way_m(), z_m);
  const bool over = z_m >= scale_.clear_z_m && !carries();
  if (over) {
    if (tip_ == Tip::Among) lift();
    tip_ = Tip::Over;
    over_m_ = at_m;
  }
  if (tip_ == Tip::Waits || over) return step;
  if (tip_ == Tip::Over) {
    particles_.hold_over(base_at(over_m_));
    meeting_.begin(base_at(over_m_));
    tip_ = Tip::Among;
    sample_j_ = 0.0;
    ++accounts_;
    strokes_.begin();
  }

  const physics::PushTick& last = particles_.last();
  const Counts before{last.yields, last.dragged, last.torn, last.lifted, last.set_down};
  const std::size_t carried = carries() ? last.particle : physics::kNoParticle;
  const physics::PushTick& tick = particles_.move_to(base_at(at_m), physics::Time(elapsed_s));
  step.near = tick.near;
  step.given_j = scale_.hand_n_per_n * scale_.hand_m_per_m * glm::dot(glm::dvec2(push_n_), drift_.step_m());
  move_poses(particles_);
  if (carried != physics::kNoParticle && !carries()) lay_down(carried);
  account(tick);
  note_events(tick, before, step);
  step.touches = tick.particle != physics::kNoParticle;
  step.push_n = push_n_;
  if (step.touches) step.bears_n = borne_n(tick);
  return step;
}

// Poses of the particles that the newest tick moved; returns how many of them the stroke had not moved before.
std::size_t FeltParticles::move_poses(const physics::PushedParticles& by) noexcept {
  const physics::PushTick& tick = by.last();
  std::size_t begun = 0;
  for (const std::uint32_t i : by.moved()) {
    scene::ParticlePose moved = pose(i);
    if (strokes_.keep(i, moved)) ++begun;
    const glm::dvec2 to_m = flat(by.position(i)), way_m = to_m - glm::dvec2(moved.x_m, moved.y_m);
    moved.x_m = to_m.x;
    moved.y_m = to_m.y;
    const bool alone = tick.state == physics::PushState::Slides || tick.state == physics::PushState::Rolls;
    const bool hangs = tick.state == physics::PushState::Carried && tick.particle == i;
    moved.moved = alone || hangs ? tick.state : physics::PushState::Several;
    if (turns_flat(i)) scene::set_turn(moved, by.turn(i));
    if (moved.moved == physics::PushState::Rolls) {
      const double radius_m = setup_.species[particles_.species(i)].contact.tip_radius.si;
      moved.orientation = rolled(moved.orientation, way_m, radius_m);
    }
    if (moved.moved == physics::PushState::Slides && tick.normal.si > 0.0) spin(tick, i, moved);
    change(i, moved);
  }
  return begun;
}

// Upward part of the strongest contact, by the flank or the cap that touches.
double FeltParticles::borne_n(const physics::PushTick& tick) const noexcept {
  const Length radius = setup_.species[particles_.species(tick.particle)].contact.tip_radius;
  return std::max(0.0, (tick.normal * physics::side_contact(setup_.tip, radius, tick.apex.z).sine).si);
}

// Turns a sphere that slides beside the path of the tip while its contact holds.
void FeltParticles::spin(const physics::PushTick& tick, std::uint32_t particle, scene::ParticlePose& pose) noexcept {
  const glm::dvec2 before_m = std::exchange(away_m_, glm::dvec2(pose.x_m, pose.y_m) - flat(tick.base.position));
  const bool goes_on = std::exchange(spun_, static_cast<std::int32_t>(particle)) == static_cast<std::int32_t>(particle);
  if (!goes_on || turns_flat(particle) || !(glm::dot(before_m, away_m_) > 0.0)) return;
  const Length radius = setup_.species[particles_.species(particle)].contact.tip_radius;
  const double cosine = physics::side_contact(setup_.tip, radius, tick.apex.z).cosine;
  pose.orientation = spun(pose.orientation, before_m, away_m_, glm::length(away_m_) / (radius.si * cosine));
}

// Force and energy of the particles: minus those of a lever that presses on the bare sample.
void FeltParticles::account(const physics::PushTick& tick) noexcept {
  const double pressed_m = std::min(0.0, tick.base.z.si), normal_n_per_m = setup_.springs.normal.si;
  const double alone_j = 0.5 * normal_n_per_m * pressed_m * pressed_m;
  if (tick.particle == physics::kNoParticle) {
    sample_j_ = tick.stored.si - alone_j;
    push_n_ = glm::dvec3(0.0);
    stored_j_ = 0.0;
    return;
  }
  push_n_ = {tick.lateral.x.si, tick.lateral.y.si, tick.lift.si + normal_n_per_m * pressed_m};
  stored_j_ = scale_.hand_n_per_n * scale_.hand_m_per_m * (tick.stored.si - alone_j - sample_j_);
}

void FeltParticles::note_events(const physics::PushTick& tick, const Counts& before, ParticlePush& step) noexcept {
  const physics::TipMeeting::Events events =
      meeting_.follow(particles_, std::abs(tick.normal.si) * scale_.hand_n_per_n >= kFeltN);
  for (const physics::TipMeeting::Event& event : events.all()) step.add({event.kind, event.before.si, event.after.si});
  if (tick.dragged > before.dragged) {
    step.add({EventKind::ParticleDragged, tick.dragged_at.si, magnitude(tick.lateral).si});
  } else if (tick.yields > before.yields) {
    step.add({EventKind::ParticleGave, tick.gave_at.si, tick.goes_on_at.si});
  }
  const bool felt = tick.torn_at.si * scale_.hand_n_per_n >= kFeltN;
  if (tick.torn > before.torn && felt) step.add({EventKind::ParticleTorn, tick.torn_at.si, 0.0});
  if (tick.set_down > before.set_down) step.add({EventKind::ParticleSetDown, 0.0, 0.0});
  if (tick.lifted > before.lifted) step.add({EventKind::ParticleLifted, tick.lifted_at.si, 0.0});
}

scene::TipPush FeltParticles::push() const noexcept {
  const physics::PushTick& tick = particles_.last();
  scene::TipPush push{.digest = digest_,
                      .given_j = tick.given.si,
                      .work_j = tick.work.si,
                      .lost_j = tick.lost.si,
                      .stored_j = tick.stored.si,
                      .hand_m_per_m = scale_.hand_m_per_m,
                      .hand_n_per_n = scale_.hand_n_per_n,
                      .softened_sideways = scale_.softened_sideways,
                      .softened_upwards = scale_.softened_upwards,
                      .yields = yields_before_ + tick.yields,
                      .exhausted = exhausted_before_ + tick.exhausted,
                      .accounts = accounts_,
                      .met = static_cast<std::uint8_t>(tip_ == Tip::Waits ? 0 : 1),
                      .strokes = static_cast<std::uint16_t>(strokes_.size())};
  const glm::dvec2& way_m = drift_.way_m();
  if (tip_ == Tip::Over) push.base_m = push.apex_m = {over_m_.x + way_m.x, over_m_.y + way_m.y, over_m_.z};
  if (tip_ != Tip::Among) return push;
  push.base_m = {tick.base.position.x.si + way_m.x, tick.base.position.y.si + way_m.y, tick.base.z.si};
  push.apex_m = {tick.apex.position.x.si + way_m.x, tick.apex.position.y.si + way_m.y, tick.apex.z.si};
  push.lateral_n = {push_n_.x, push_n_.y};
  push.lift_n = push_n_.z;
  push.lagging = tick.lagging ? 1 : 0;
  if (tick.particle == physics::kNoParticle) return push;
  push.normal_n = tick.normal.si;
  push.threshold_n = tick.threshold.si;
  push.other_threshold_n = other_threshold_n_[particles_.species(tick.particle)];
  push.particle = static_cast<std::int32_t>(tick.particle);
  push.state = tick.state;
  return push;
}

scene::LevelSample FeltParticles::level() const noexcept {
  if (level_ == 0) return {};
  return {.since_ns = drift_.since_ns(), .met = tip_ == Tip::Waits ? 0U : 1U};
}

scene::PushSample FeltParticles::sample() const noexcept {
  scene::PushSample sample{.digest = digest_};
  const physics::PushTick& tick = particles_.last();
  if (tip_ != Tip::Among || tick.particle == physics::kNoParticle) return sample;
  sample.lateral_n = {push_n_.x, push_n_.y};
  sample.lift_n = push_n_.z;
  sample.normal_n = tick.normal.si;
  sample.particle = static_cast<std::int32_t>(tick.particle);
  sample.state = tick.state;
  return sample;
}

}  // namespace afm::haptics
