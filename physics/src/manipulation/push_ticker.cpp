// SPDX-License-Identifier: Apache-2.0
#include "push_ticker.h"

#include <algorithm>
#include <cmath>

#include "heap_descent.h"
#include "line_friction.h"

namespace afm::physics {
namespace {

constexpr int kMostSubSteps = 8;              // largest number of sub-steps per tick
constexpr int kHeapSplit = 3;                 // number of steps of a heap per sub-step
constexpr double kSubStepShare = 1.0 / 20.0;  // length of a sub-step over the smallest distance of tip and sphere
// largest motion of a part in a sub-step as a share of the smallest radius: alone, and in a heap
constexpr double kReachShare = 1.0 / 4.0;
constexpr double kHeapReachShare = 1.0 / 12.0;

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

PushSetup validated(PushSetup setup, const std::vector<PlacedParticle>& particles) {
  validate(setup, particles);
  return setup;
}

// Largest radius within which a tick looks for particles.
double search_m(const PushSetup& setup, double margin_m, double stretch_m) {
  double reach_m = 0.0, touching_m = 0.0, longest_half_m = 0.0;
  for (const ParticleSpecies& species : setup.species) {
    reach_m = std::max(reach_m, TipProfile(setup.tip, species.contact.tip_radius).reach_m());
    touching_m = std::max(touching_m, 2.0 * species.contact.tip_radius.si);
    longest_half_m = std::max({longest_half_m, 0.5 * species.length.si, core_radius(species).si});
  }
  return std::max(reach_m, touching_m) + margin_m + 2.0 * longest_half_m + stretch_m;
}

}  // namespace

PushedParticles::Ticker::Reach PushedParticles::Ticker::reach_of(const PushSetup& setup) noexcept {
  double smallest_m = HUGE_VAL, narrowest_m = HUGE_VAL;
  for (const ParticleSpecies& s : setup.species) {
    smallest_m = std::min(smallest_m, s.contact.tip_radius.si);
    narrowest_m = std::min(narrowest_m, outer_radius(s).si);
  }
  return {.alone_m = kReachShare * narrowest_m,
          .heap_m = kHeapReachShare * narrowest_m,
          .base_m = kSubStepShare * (smallest_m + setup.tip.radius.si) * std::cos(setup.tip.half_angle_rad)};
}

PushedParticles::Ticker::Ticker(const PushSetup& setup, const std::vector<PlacedParticle>& particles,
                                const LeverBase& start)
    : setup_(validated(setup, particles)),
      holds_(setup, particles),
      reach_(reach_of(setup)),
      lying_(setup, particles, search_m(setup, 3.0 * reach_.alone_m, holds_.stretch_m())),
      heap_(setup.springs),
      carried_(setup.springs) {
  for (const ParticleSpecies& species : setup_.species) {
    contacts_.emplace_back(species, setup_.tip, setup_.springs, setup_.tip_friction);
    for (const StickyPad& pad : setup_.pads) {
      contacts_.emplace_back(on_pad(pad, species), setup_.tip, setup_.springs, setup_.tip_friction);
    }
  }
  moved_at_s_.assign(particles.size(), -HUGE_VAL);
  moved_.reserve(particles.size());
  moves_.assign(particles.size(), false);
  clear_m_ = clear_height(setup_).si;
  pressed_.assign(particles.size(), {});
  base_ = {start.position.x.si, start.position.y.si, start.z.si};
  apex_ = {base_.x, base_.y, std::max(0.0, base_.height)};
  tick_.stored = tick_.given = Energy(stored_everywhere());
  left_.work = setup_.heap_looks;
  sub_step(base_);
  publish();
}

const PushTick& PushedParticles::Ticker::tick(const LeverBase& asked, double elapsed_s) noexcept {
  const Apex to{asked.position.x.si, asked.position.y.si, asked.z.si};
  if (!std::isfinite(to.x) || !std::isfinite(to.y) || !std::isfinite(to.height)) return tick_;
  tick_end_s_ = time_s_ + (elapsed_s >= 0.0 ? elapsed_s : 0.0);
  exhausted_ = false;
  for (const std::uint32_t i : moved_) moves_[i] = false;
  moved_.clear();
  advance(to);
  time_s_ = tick_end_s_;
  if (exhausted_) ++tick_.exhausted;
  publish();
  return tick_;
}

// Sub-steps of a tick; a base that is too fast lags behind the asked one.
void PushedParticles::Ticker::advance(const Apex& to) noexcept {
  const double dx = to.x - base_.x, dy = to.y - base_.y, dz = to.height - base_.height;
  const double way_m = std::sqrt(dx * dx + dy * dy + dz * dz);
  const double needed = way_m / reach_.base_m;
  tick_.lagging = needed > kMostSubSteps;
  const int steps = tick_.lagging ? kMostSubSteps : std::max(1, static_cast<int>(std::ceil(needed)));
  const double share = tick_.lagging ? reach_.base_m / way_m : 1.0 / steps;
  const Apex from = base_;
  left_.work = setup_.heap_looks;
  for (int i = 1; i <= steps; ++i) {
    left_.heap_steps = (steps - i + 1) * kHeapSplit;
    const double at = i * share;
    sub_step(i == steps && !tick_.lagging ? to : Apex{from.x + at * dx, from.y + at * dy, from.height + at * dz});
  }
}

// The particles that the apex may touch within its reach. False: there are too many.
bool PushedParticles::Ticker::find_near() noexcept {
  near_.clear();
  bool fits = true;
  const double x = apex_.x, y = apex_.y, lowest_m = apex_.height - reach_.alone_m - holds_.stretch_m();
  lying_.near({x, y}, [&](std::size_t i) {
    const double diameter_m = 2.0 * setup_.species[lying_.species(i)].contact.tip_radius.si;
    const double most_m = contacts_[kind_of(i)].profile().reach_m() + reach_.alone_m + holds_.stretch_m();
    if (lowest_m > diameter_m) return;
    const Flat nearest = nearest_on(lying_.outline(i), {x, y});
    if (length_of(nearest.x - x, nearest.y - y) > most_m) return;
    fits = near_.add(i) && fits;
  });
  std::sort(near_.begin(), near_.end());
  return fits;
}

void PushedParticles::Ticker::sub_step(const Apex& to) noexcept {
  // a base that rests moves nothing: thresholds only grow
  if (settled_ && to.x == base_.x && to.y == base_.y && to.height == base_.height) return;
  if (carried_.any()) {
    carry_step(to);
    // the sphere may have been set down
    find_near();
    press();
    return;
  }
  if (!find_near()) {  // too many particles: the base waits
    exhausted_ = true;
    return;
  }
  settled_ = true;
  const bool in_closed_form =
      restless_.empty() && (near_.empty() ? free_step(to) : near_.size() == 1 && lone_step(to, *near_.begin()));
  if (!in_closed_form) {
    const Apex from = base_;
    const double x = to.x - from.x, y = to.y - from.y, z = to.height - from.height;
    for (int i = 1; i <= kHeapSplit; ++i) {
      const double at = static_cast<double>(i) / kHeapSplit;
      const Apex next = i == kHeapSplit ? to : Apex{from.x + at * x, from.y + at * y, from.height + at * z};
      if (carried_.any()) {
        carry_step(next);
        continue;
      }
      heap_step(next);
      if (!lift()) tear(next);
    }
  }
  press();
}

double PushedParticles::Ticker::tip_contact_j(std::size_t i, const Flat& at, const Apex& apex) const noexcept {
  Outline there = lying_.outline(i);
  there.at = at;
  const double away_m = distance_between(nearest_on(there, {apex.x, apex.y}), {apex.x, apex.y});
  const double depth_m = contacts_[kind_of(i)].profile().overlap(away_m, apex.height).depth_m;
  return depth_m > 0.0 ? 0.5 * setup_.springs.contact.si * depth_m * depth_m : 0.0;
}

double PushedParticles::Ticker::stored_everywhere() const noexcept {
  double energy_j = lever_j(setup_.springs, base_, apex_);
  for (std::size_t i = 0; i < lying_.size(); ++i) {
    energy_j += tip_contact_j(i, lying_.position(i), apex_);
    lying_.near(lying_.position(i), [&](std::size_t j) {
      if (j < i) energy_j += lying_.pair_j(i, j, setup_.springs.contact);
    });
  }
  return energy_j;
}

// With no sphere nearby, the apex rests at the base or on the sample below it. Returns false if that is too far away.
bool PushedParticles::Ticker::free_step(const Apex& to) noexcept {
  const auto rests = [](const Apex& base) { return Apex{base.x, base.y, std::max(0.0, base.height)}; };
  if (!is_within(reach_.alone_m, rests(to), apex_)) return false;
  double was_j = lever_j(setup_.springs, base_, apex_);
  // a descent that was cut short may have left the tip in a sphere
  for (const std::size_t i : near_) was_j += tip_contact_j(i, lying_.position(i), apex_);
  const double rested_j = lever_j(setup_.springs, base_, rests(base_)), now_j = lever_j(setup_.springs, to, rests(to));
  tick_.given = tick_.given + Energy(now_j - rested_j);
  tick_.work = tick_.work + Energy(now_j - rested_j);
  tick_.stored = tick_.stored + Energy(now_j - was_j);
  base_ = to;
  apex_ = rests(to);
  return true;
}

double PushedParticles::Ticker::rest_threshold(std::size_t i, double rest_n, double moving_n) const noexcept {
  const double ageing_s = setup_.species[lying_.species(i)].ageing.si;
  if (!(ageing_s > 0.0)) return rest_n;
  const double rest_s = time_s_ - moved_at_s_[i];
  return rest_s > 0.0 ? moving_n + (rest_n - moving_n) * -std::expm1(-rest_s / ageing_s) : moving_n;
}

bool PushedParticles::Ticker::is_alone(std::size_t i) const noexcept {
  bool alone = !lying_.is_pinned(i);
  lying_.near(lying_.position(i), [&](std::size_t j) {
    if (j != i && lying_.apart_m(i, j) < lying_.touching_m(i, j) + 2.0 * reach_.alone_m) alone = false;
  });
  return alone;
}

// True if a base at its new height goes past a sphere without touching it.
bool PushedParticles::Ticker::passes(std::size_t i, const Apex& to) const noexcept {
  const Leaning touch = contacts_[kind_of(i)].under(0.0, to.height);
  if (!touch.holds) return true;
  const Flat at = lying_.position(i);
  const double dx = to.x - base_.x, dy = to.y - base_.y, x = at.x - base_.x, y = at.y - base_.y;
  const double way2 = dx * dx + dy * dy;
  const double nearest = way2 > 0.0 ? std::clamp((x * dx + y * dy) / way2, 0.0, 1.0) : 0.0;
  return length_of(x - nearest * dx, y - nearest * dy) >= touch.base_m;
}

// Force at which a particle gives to the tip over that at which it would move sideways as a whole: below 1 for a rod
// or an island that the tip turns.
double PushedParticles::Ticker::share_of_push(std::size_t i) const noexcept {
  const Outline rod = lying_.outline(i);
  if (rod.core_m > 0.0) return pressed_[i].normal_n > 0.0 ? share_of_load(rim_force(i)) : 1.0;
  const Flat apex{apex_.x, apex_.y}, point = nearest_on(rod, apex);
  const double x = point.x - apex.x, y = point.y - apex.y, away_m = length_of(x, y);
  if (!(rod.half_m > 0.0 && away_m > 0.0) || !(pressed_[i].normal_n > 0.0)) return 1.0;
  const double across = (y * rod.axis.x - x * rod.axis.y) / away_m;
  const double place = place_beside(rod, apex) / rod.half_m;
  return 1.0 / driven_motion({(x * rod.axis.x + y * rod.axis.y) / away_m, across, place * across}).force;
}

// One sphere without neighbours, in closed form: the base rises or sinks first, then goes along. False if what happens
// is not known in closed form, goes too far for one sub-step, or would raise stored energy plus friction.
bool PushedParticles::Ticker::lone_step(const Apex& to, std::size_t i) noexcept {
  if (lying_.core_m(i) > 0.0) return island_step(to, i);
  if (lying_.half_m(i) > 0.0 || !is_alone(i)) return false;
  const bool held = holds_.pull_of(i).holds();  // true: the sphere is pulled unless it is pushed
  if (held && !(pressed_[i].normal_n > 0.0)) return false;
  LoneContact& contact = contacts_[kind_of(i)];
  const Flat was = lying_.position(i);
  const double away_m = length_of(was.x - base_.x, was.y - base_.y);
  const double before_n = contact.force_at(away_m, base_.height), sunk_n = contact.force_at(away_m, to.height);
  if (before_n < 0.0 || sunk_n < 0.0 || (held && before_n == 0.0)) return false;
  if (before_n == 0.0 && sunk_n == 0.0 && passes(i, to)) return free_step(to);
  const double sunk_j = contact.under(sunk_n, to.height).energy_j - contact.under(before_n, base_.height).energy_j;

  const LoneThresholds thresholds = contact.thresholds(to.height);
  const double holds_n = rest_threshold(i, thresholds.rest_n, thresholds.moving_n);
  const bool at_once = !(setup_.species[lying_.species(i)].ageing.si > 0.0);
  const LonePath path =
      push_alone(contact, thresholds, holds_n, at_once, was, {base_.x, base_.y}, {to.x, to.y}, to.height);
  const double moved_m = length_of(path.particle.x - was.x, path.particle.y - was.y);
  if (!path.possible || moved_m > reach_.alone_m) return false;

  const double x = path.particle.x - to.x, y = path.particle.y - to.y, end_m = length_of(x, y);
  const double lateral_n = contact.force_at(end_m, to.height);
  if (lateral_n < 0.0 || (lateral_n > 0.0 && !(end_m > 0.0)) || (held && lateral_n == 0.0)) return false;
  Apex apex{to.x, to.y, std::max(0.0, to.height)};
  if (lateral_n > 0.0) {
    const double lag = lateral_n / (setup_.springs.lateral.si * end_m);
    apex = {to.x - lag * x, to.y - lag * y, contact.under(lateral_n, to.height).apex_m};
  }
  if (!is_within(reach_.alone_m, apex, apex_)) return false;
  const double old_j = lever_j(setup_.springs, base_, apex_) + tip_contact_j(i, was, apex_);
  const double frozen_j = lever_j(setup_.springs, to, apex_) + tip_contact_j(i, was, apex_);
  const double now_j = lever_j(setup_.springs, to, apex) + tip_contact_j(i, path.particle, apex);
  // a lever that bends while the sphere stays may also keep its energy
  const bool taken = path.moved ? may_be_taken(now_j + thresholds.moving_n * moved_m - frozen_j) : now_j <= frozen_j;
  if (!taken) return false;

  tick_.given = tick_.given + Energy(sunk_j + path.given_j);
  tick_.work = tick_.work + Energy(sunk_j + path.given_j);
  tick_.lost = tick_.lost + Energy(path.lost_j);
  tick_.stored = tick_.stored + Energy(now_j - old_j);
  if (path.yields > 0) gave(holds_n, thresholds.moving_n);
  tick_.yields += path.yields - std::min<std::uint64_t>(path.yields, 1);
  base_ = to;
  apex_ = apex;
  if (path.moved) place(i, path.particle, lying_.turn(i));
  return true;
}

void PushedParticles::Ticker::place(std::size_t i, const Flat& at, const HalfTurn& turn) noexcept {
  lying_.move(i, at, turn);
  moved_at_s_[i] = tick_end_s_;
  if (moves_[i]) return;
  moves_[i] = true;
  moved_.push_back(static_cast<std::uint32_t>(i));  // no allocation: within the reserved capacity
}

void PushedParticles::Ticker::gave(double at_n, double goes_on_n) noexcept {
  ++tick_.yields;
  tick_.gave_at = Force(at_n);
  tick_.goes_on_at = Force(goes_on_n);
}

void PushedParticles::Ticker::put(std::size_t i, const Flat& at, const HalfTurn& turn) noexcept {
  if (carried_.particle() == i) carried_.drop();
  lying_.move(i, at, turn);
}

void PushedParticles::Ticker::hold_over(const LeverBase& base) noexcept {
  base_ = {base.position.x.si, base.position.y.si, std::max(clear_m_, base.z.si)};
  apex_ = base_;
  for (const std::uint32_t i : moved_) moves_[i] = false;
  moved_.clear();
  // nothing else has moved since it was taken
  if (carried_.any()) put(carried_.particle(), carried_.from(), lying_.turn(carried_.particle()));
  near_.clear();
  holds_.reset();
  press();
  std::fill(moved_at_s_.begin(), moved_at_s_.end(), -HUGE_VAL);
  time_s_ = tick_end_s_ = 0.0;
  settled_ = false;
  restless_.clear();
  tick_.given = tick_.work = tick_.lost = tick_.stored = tick_.torn_lost = Energy();
  tick_.lagging = false;
  publish();
}

// Finds the particles that the tip presses: the load of the next sub-step's friction.
void PushedParticles::Ticker::press() noexcept {
  for (const std::size_t i : touched_) pressed_[i] = {};
  touched_.clear();
  if (carried_.any()) return;
  for (const std::size_t i : near_) {
    const Flat nearest = nearest_on(lying_.outline(i), {apex_.x, apex_.y});
    const Overlap overlap =
        contacts_[kind_of(i)].profile().overlap(length_of(nearest.x - apex_.x, nearest.y - apex_.y), apex_.height);
    if (overlap.depth_m > 0.0 && holds_.form(i)) ++tick_.attached;
    if (!(overlap.depth_m > 0.0 || holds_.pull_of(i).holds())) continue;
    pressed_[i] = {setup_.springs.contact.si * overlap.depth_m, overlap.sine, overlap.cosine};
    touched_.add(i);
  }
}

void PushedParticles::Ticker::publish() noexcept {
  const auto place_of = [](const Apex& at) { return LeverBase{{Length(at.x), Length(at.y)}, Length(at.height)}; };
  tick_.base = place_of(base_);
  tick_.apex = place_of(apex_);
  tick_.lateral = {setup_.springs.lateral * Length(apex_.x - base_.x),
                   setup_.springs.lateral * Length(apex_.y - base_.y)};
  tick_.lift = setup_.springs.normal * Length(apex_.height - base_.height);
  tick_.near = !find_near() || !near_.empty() || carried_.any();
  tick_.particle = kNoParticle;
  tick_.state = PushState::Free;
  tick_.normal = tick_.threshold = Force(0.0);
  if (carried_.any()) {
    tick_.particle = carried_.particle();
    tick_.state = PushState::Carried;
    return;
  }
  for (const std::size_t i : touched_) {
    // a sphere that has just been set down presses by nothing
    const bool first = tick_.particle == kNoParticle && holds_.lifts(i);
    if (!first && std::abs(pressed_[i].normal_n) <= std::abs(tick_.normal.si)) continue;
    tick_.particle = i;
    tick_.normal = Force(pressed_[i].normal_n);
  }
  if (tick_.particle == kNoParticle) return;
  const std::size_t i = tick_.particle;
  LoneContact& contact = contacts_[kind_of(i)];
  const Pressed& pressed = pressed_[i];
  const bool moves = moved_at_s_[i] >= time_s_ && !moved_.empty();
  LoneThresholds thresholds = contact.under_load(pressed.normal_n, pressed.sine, pressed.cosine);
  if (touched_.size() > 1 || moved_.size() > 1) {
    tick_.state = PushState::Several;
  } else {
    const bool alone = !is_rod(setup_.species[lying_.species(i)]) && is_alone(i);
    if (alone && pressed.normal_n > 0.0) thresholds = contact.thresholds(base_.height);
    tick_.state = !moves ? PushState::Holds : thresholds.mode == PushMode::Rolls ? PushState::Rolls : PushState::Slides;
  }
  tick_.threshold = Force(rest_threshold(i, thresholds.rest_n, thresholds.moving_n) * share_of_push(i));
}

}  // namespace afm::physics
