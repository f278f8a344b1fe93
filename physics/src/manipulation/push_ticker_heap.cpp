// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "heap_descent.h"
#include "push_ticker.h"

// A sub-step among several particles, with a rod, at the rim of an island, or with a sphere on the tip.
namespace afm::physics {
namespace {

constexpr double kPressRounding = 1e-12;  // rounding error of an energy, as a share of it
constexpr std::size_t kNobody = HeapContacts::kMostActive;

}  // namespace

bool PushedParticles::Ticker::add_body(std::size_t i, bool near_tip) noexcept {
  const LoneContact& contact = contacts_[kind_of(i)];
  const Pressed& pressed = pressed_[i];
  const LoneThresholds thresholds = contact.under_load(pressed.normal_n, pressed.sine, pressed.cosine);
  const Outline there = lying_.outline(i);
  return heap_.add(HeapContacts::Body{.particle = i,
                                      .profile = &contact.profile(),
                                      .start = lying_.position(i),
                                      .at = lying_.position(i),
                                      .rest_n = rest_threshold(i, thresholds.rest_n, thresholds.moving_n),
                                      .moving_n = thresholds.moving_n,
                                      .pinned = lying_.is_pinned(i),
                                      .near_tip = near_tip,
                                      .half_m = there.half_m,
                                      .core_m = there.core_m,
                                      .start_axis = there.axis,
                                      .axis = there.axis,
                                      .pull = holds_.pull_of(i)});
}

// `second` is kMostActive for a particle that stays.
bool PushedParticles::Ticker::add_pairs(std::size_t first, std::size_t second, std::size_t particle) noexcept {
  HeapContacts::Pair pair{.first = first,
                          .second = second,
                          .stays = {},
                          .distance_m = lying_.touching_m(heap_.body(first).particle, particle)};
  if (second == HeapContacts::kMostActive) pair.stays = lying_.outline(particle);
  if (!(heap_.body(first).is_rod() && lying_.half_m(particle) > 0.0)) return heap_.add(pair);
  bool fits = true;
  for (const auto& [of_first, of_second] : {std::pair{-1, 0}, std::pair{1, 0}, std::pair{0, -1}, std::pair{0, 1}}) {
    pair.first_end = of_first;
    pair.second_end = of_second;
    fits = heap_.add(pair) && fits;
  }
  return fits;
}

// The neighbours of a body of the descent, as bodies of it too while there is room.
bool PushedParticles::Ticker::gather_pairs_of(std::size_t first) noexcept {
  const std::size_t i = heap_.body(first).particle;
  bool fits = true;
  lying_.neighbours(i, 2.0 * reach_.heap_m, [&](std::size_t j) {
    std::size_t second = heap_.find(j);
    if (second == heap_.size() && !add_body(j, false)) second = HeapContacts::kMostActive;
    if (second < first) return;  // known from the other side
    fits = add_pairs(first, second, j) && fits;
  });
  return fits;
}

bool PushedParticles::Ticker::gather(const Apex& to) noexcept {
  heap_.begin(to, apex_);
  if (!find_near()) return false;
  bool fits = true;
  for (const std::size_t i : near_) fits = add_body(i, true) && fits;
  // particles near the tip and their neighbours first, then those of an unsettled heap while there is room
  std::size_t n = 0;
  for (; n < near_.size(); ++n) fits = gather_pairs_of(n) && fits;
  for (const std::size_t i : restless_) {
    if (heap_.find(i) == heap_.size()) add_body(i, false);
  }
  for (; n < heap_.size(); ++n) fits = gather_pairs_of(n) && fits;
  heap_.find_contacts();
  return fits;
}

void PushedParticles::Ticker::heap_step(const Apex& to) noexcept {
  if (!gather(to)) {  // too many particles: the base waits
    exhausted_ = true;
    settled_ = false;
    return;
  }
  const double loaded_j = lever_j(setup_.springs, to, apex_) - lever_j(setup_.springs, base_, apex_),
               frozen_j = heap_.stored();
  const double share = left_.work / std::max(1, left_.heap_steps--);
  double work = share;
  const bool at_rest = descend(heap_, reach_.heap_m, work);
  left_.work -= share - work;
  if (!at_rest) exhausted_ = true;
  const Apex& now = heap_.apex();
  settled_ = at_rest && heap_.friction() == 0.0 && now.x == apex_.x && now.y == apex_.y && now.height == apex_.height;
  tick_.given = tick_.given + Energy(loaded_j);
  tick_.work = tick_.work + Energy(work_j(setup_.springs, base_, apex_, to, heap_.apex()));
  tick_.lost = tick_.lost + Energy(heap_.friction());
  tick_.stored = tick_.stored + Energy(loaded_j + heap_.stored() - frozen_j);
  base_ = to;
  apex_ = heap_.apex();
  restless_.clear();
  for (std::size_t n = 0; n < heap_.size() && !at_rest; ++n) {
    if (!heap_.body(n).pinned) restless_.add(heap_.body(n).particle);
  }
  for (std::size_t n = 0; n < heap_.size(); ++n) {
    const HeapContacts::Body& body = heap_.body(n);
    if (!body.moved()) continue;
    const double pushed = share_of_push(body.particle);
    const bool rested = body.rest_n > body.moving_n;
    if (rested) gave(body.rest_n * pushed, body.moving_n * pushed);
    if (pressed_[body.particle].normal_n < 0.0 && (holds_.begins_to_follow(body.particle) || rested)) {
      ++tick_.dragged;
      tick_.dragged_at = Force(body.rest_n);
    }
    const HalfTurn turn = lying_.turn(body.particle);
    place(body.particle, body.at, body.is_rod() ? turned(turn, half_tangent(body.turned_m, body.half_m)) : turn);
  }
}

RimForce PushedParticles::Ticker::rim_force(std::size_t i) const noexcept {
  const Flat at = lying_.position(i), lever{base_.x - apex_.x, base_.y - apex_.y};
  const double away_m = distance_between(at, {apex_.x, apex_.y}), k_l = setup_.springs.lateral.si;
  if (!(away_m > 0.0)) return {};
  const Flat normal{(at.x - apex_.x) / away_m, (at.y - apex_.y) / away_m};
  return {k_l * (lever.x * normal.x + lever.y * normal.y), k_l * (lever.y * normal.x - lever.x * normal.y)};
}

// One island without neighbours, which turns about a tip that sticks to its rim. False as lone_step().
bool PushedParticles::Ticker::island_step(const Apex& to, std::size_t i) noexcept {
  if (!is_alone(i)) return false;
  const ParticleSpecies& species = setup_.species[lying_.species(i)];
  const LoneContact& contact = contacts_[kind_of(i)];
  const LoneThresholds thresholds = contact.under_load(0.0, 0.0, 1.0);
  const IslandRim rim{setup_.springs, lying_.core_m(i), species.island_radius.si, setup_.tip_friction};
  const IslandFriction friction{rest_threshold(i, thresholds.rest_n, thresholds.moving_n), thresholds.moving_n,
                                !(species.ageing.si > 0.0)};
  const Flat was = lying_.position(i);
  const double away_m = distance_between(was, {apex_.x, apex_.y});
  std::optional<Flat> normal;
  if (pressed_[i].normal_n > 0.0) {
    if (away_m <= lying_.core_m(i)) return false;  // base above the island's flat part
    normal = Flat{(was.x - apex_.x) / away_m, (was.y - apex_.y) / away_m};
  }
  const IslandPath path = push_island(contact, rim, friction, was, normal, {base_.x, base_.y}, to);
  if (!path.met) return free_step(to);
  if (!path.possible || distance_between(path.at, was) > reach_.alone_m) return false;
  if (!is_within(reach_.alone_m, path.apex, apex_)) return false;
  const double loaded_j = lever_j(setup_.springs, to, apex_) - lever_j(setup_.springs, base_, apex_);
  const double contact_j = tip_contact_j(i, was, apex_);
  const double frozen_j = lever_j(setup_.springs, to, apex_) + contact_j;
  const double now_j = lever_j(setup_.springs, to, path.apex) + tip_contact_j(i, path.at, path.apex);
  const double change_j = now_j + path.lost_j - frozen_j;
  // an island that stays may keep the energy, too, which rounding then changes
  const double rounding_j = path.moved ? 0.0 : kPressRounding * frozen_j;
  if (!may_be_taken(change_j - rounding_j)) return false;
  tick_.given = tick_.given + Energy(loaded_j + std::min(std::max(0.0, change_j), rounding_j));
  tick_.work = tick_.work + Energy(work_j(setup_.springs, base_, apex_, to, path.apex));
  tick_.lost = tick_.lost + Energy(path.lost_j);
  tick_.stored = tick_.stored + Energy(loaded_j + now_j - frozen_j);
  if (path.yields > 0) gave(friction.holds_n * path.share, thresholds.moving_n * path.share);
  tick_.yields += path.yields - std::min<std::uint64_t>(path.yields, 1);
  base_ = to;
  apex_ = path.apex;
  const double half = 0.5 * path.turned_rad;
  if (path.moved) place(i, path.at, turned(lying_.turn(i), half * (1.0 + half * half / 3.0)));
  return true;
}

// Contacts that pull by more than they hold tear. What they stored is lost, and so is the energy of the lever that then
// springs back.
void PushedParticles::Ticker::tear(const Apex& to) noexcept {
  const auto surplus = [this] { return tick_.given - tick_.lost - tick_.stored; };
  const auto let_go = [this] {
    bool any = false;
    for (const std::size_t n : heap_.near_tip()) {
      const HeapContacts::Body& body = heap_.body(n);
      const HeapContacts::Normal normal = heap_.normal_of(n);
      const double holds_n = body.pull.on(normal.ball), gap_m = -normal.overlap_m;
      if (!body.pull.holds() || !(setup_.springs.contact.si * gap_m > holds_n)) continue;
      const Energy contact(0.5 * setup_.springs.contact.si * gap_m * gap_m);
      tick_.stored = tick_.stored - contact;
      tick_.lost = tick_.lost + contact;
      // an apex on the sample does not bend the lever upwards or down
      const double sine = apex_.height > 0.0 ? -normal.towards[2] : 0.0;
      const double cosine = std::sqrt(normal.towards[0] * normal.towards[0] + normal.towards[1] * normal.towards[1]);
      const Stiffness spring = stiffness_along_normal(setup_.springs, sine, cosine);
      tick_.torn_at = Force(holds_n);
      tick_.torn_lost = tick_.torn_lost + tear_energy(tick_.torn_at, spring);
      ++tick_.torn;
      holds_.tear(body.particle);
      any = true;
    }
    return any;
  };
  if (!let_go()) return;
  const Energy before = surplus();
  const bool exhausted = exhausted_;
  settled_ = false;
  for (int i = 0; i < kMostSprings && !settled_; ++i) {
    exhausted_ = exhausted;
    heap_step(to);
    if (let_go()) settled_ = false;
  }
  tick_.lost = tick_.lost + std::max(Energy(0.0), surplus() - before);
}

// A body of the heap that the tip pulls off the sample; kNobody without one. An apex on the sample lifts nothing.
std::size_t PushedParticles::Ticker::lifted() const noexcept {
  if (!(apex_.height > 0.0)) return kNobody;
  for (const std::size_t n : heap_.near_tip()) {
    const HeapContacts::Body& body = heap_.body(n);
    if (!body.pull.holds() || body.pinned || !holds_.lifts(body.particle)) continue;
    const HeapContacts::Normal normal = heap_.normal_of(n);
    const double pull_n = std::min(-setup_.springs.contact.si * normal.overlap_m, body.pull.on(normal.ball));
    if (-normal.towards[2] * pull_n > contacts_[kind_of(body.particle)].pull_off_n()) return n;
  }
  return kNobody;
}

// Lifts a sphere whose hold on the sample is weaker than the pull of the tip, unless that would need energy. The
// energy of its contacts and of the lever that springs back is lost; everything else that the tip holds is released.
bool PushedParticles::Ticker::lift() noexcept {
  const bool exhausted = exhausted_;
  // only at rest does a gap tell the pull
  for (int k = 0; k < kMostSprings && left_.work > 0.0 && !restless_.empty() && lifted() != kNobody; ++k) {
    exhausted_ = exhausted;
    heap_step(base_);
  }
  const std::size_t n = lifted();
  if (n == kNobody || !restless_.empty()) return false;
  const std::size_t i = heap_.body(n).particle;
  double before_j = lever_j(setup_.springs, base_, apex_);
  const auto add = [&](double depth_m) { before_j += 0.5 * setup_.springs.contact.si * depth_m * depth_m; };
  for (const std::size_t other : heap_.near_tip()) {
    const HeapContacts::Normal normal = heap_.normal_of(other);
    if (normal.acts) add(normal.overlap_m);
  }
  for (const std::size_t pair : heap_.pairs_of(n)) add(std::max(0.0, heap_.touch_of(pair).overlap_m));

  const HeapContacts::Normal normal = heap_.normal_of(n);
  const double touches_at_m = apex_.height - normal.overlap_m * normal.towards[2];
  carried_.take(i, setup_.species[lying_.species(i)].contact.tip_radius, lying_.position(i), setup_.tip, apex_,
                touches_at_m);
  const bool fits = find_obstacles();
  const double after_j = carried_.energy_j(base_, apex_);
  if (!fits || !(after_j <= before_j)) {
    carried_.drop();
    return false;
  }
  for (const std::size_t other : heap_.near_tip()) {
    if (other != n) holds_.tear(heap_.body(other).particle);
  }
  place(i, carried_.place(apex_), lying_.turn(i));
  tick_.stored = tick_.stored + Energy(after_j - before_j);
  tick_.lost = tick_.lost + Energy(before_j - after_j);
  tick_.lifted_at = Force(contacts_[kind_of(i)].pull_off_n());
  ++tick_.lifted;
  const auto surplus = [this] { return tick_.given - tick_.lost - tick_.stored; };
  const Energy before = surplus();
  settled_ = false;
  for (int k = 0; k < kMostSprings && carried_.any() && !settled_; ++k) {
    exhausted_ = exhausted;
    carry_step(base_);
  }
  tick_.lost = tick_.lost + std::max(Energy(0.0), surplus() - before);
  return true;
}

// Finds the particles that tip and sphere may touch within a step. False: there are too many.
bool PushedParticles::Ticker::find_obstacles() noexcept {
  carried_.begin();
  const std::size_t carried = carried_.particle();
  const Flat tip{apex_.x, apex_.y}, sphere = carried_.place(apex_);
  const double radius_m = setup_.species[lying_.species(carried)].contact.tip_radius.si;
  const auto is_near = [&](std::size_t i, const Flat& to, double lowest_m, double most_m) {
    const double diameter_m = 2.0 * setup_.species[lying_.species(i)].contact.tip_radius.si;
    return lowest_m - reach_.alone_m <= diameter_m &&
           distance_between(nearest_on(lying_.outline(i), to), to) <= most_m + reach_.alone_m;
  };
  const auto near_tip = [&](std::size_t i) {
    return is_near(i, tip, apex_.height, contacts_[kind_of(i)].profile().reach_m());
  };
  const auto near_sphere = [&](std::size_t i) {
    const double other_m = setup_.species[lying_.species(i)].contact.tip_radius.si;
    return is_near(i, sphere, carried_.height_m(apex_), radius_m + other_m);
  };
  bool fits = true;
  const auto add = [&](std::size_t i) {
    const ParticleSpecies& species = setup_.species[lying_.species(i)];
    fits = carried_.add({.outline = lying_.outline(i),
                         .radius_m = species.contact.tip_radius.si,
                         .profile = &contacts_[kind_of(i)].profile()}) &&
           fits;
  };
  lying_.near(tip, [&](std::size_t i) {
    if (i != carried && near_tip(i)) add(i);
  });
  lying_.near(sphere, [&](std::size_t i) {
    if (i != carried && near_sphere(i) && !near_tip(i)) add(i);
  });
  return fits;
}

// All particles stay where they are but the one on the tip, which follows the apex.
void PushedParticles::Ticker::carry_step(const Apex& to) noexcept {
  if (!find_obstacles()) {  // too many obstacles: the base waits
    exhausted_ = true;
    settled_ = false;
    return;
  }
  const double loaded_j = lever_j(setup_.springs, to, apex_) - lever_j(setup_.springs, base_, apex_);
  const double frozen_j = carried_.energy_j(to, apex_);
  Apex apex = apex_;
  settled_ = carried_.settle(to, reach_.alone_m, apex);
  if (!settled_) exhausted_ = true;
  const double stored_j = loaded_j + carried_.energy_j(to, apex) - frozen_j;
  // a tip that nothing touches follows the base
  const bool follows = carried_.is_free(base_, apex_) && carried_.is_free(to, apex);
  tick_.given = tick_.given + Energy(follows ? stored_j : loaded_j);
  tick_.work = tick_.work + Energy(work_j(setup_.springs, base_, apex_, to, apex));
  tick_.stored = tick_.stored + Energy(stored_j);
  base_ = to;
  apex_ = apex;
  const std::size_t i = carried_.particle();
  const Flat was = lying_.position(i), now = carried_.place(apex_);
  if (was.x != now.x || was.y != now.y) place(i, now, lying_.turn(i));
  if (carried_.lies(apex_)) set_down();
}

// The sphere lies on the sample, still held by the tip, unless it would then press others harder: distances of spheres
// that lie are measured along the sample.
void PushedParticles::Ticker::set_down() noexcept {
  const std::size_t i = carried_.particle();
  const double hanging_j = carried_.pressed_j(apex_);
  double lying_j = 0.0;
  lying_.near(lying_.position(i), [&](std::size_t j) {
    if (j != i) lying_j += lying_.pair_j(i, j, setup_.springs.contact);
  });
  if (lying_j > hanging_j * (1.0 + kPressRounding)) return;
  tick_.stored = tick_.stored + Energy(lying_j - hanging_j);
  carried_.drop();
  ++tick_.set_down;
  settled_ = false;
}

}  // namespace afm::physics
