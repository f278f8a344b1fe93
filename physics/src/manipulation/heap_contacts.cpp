// SPDX-License-Identifier: Apache-2.0
#include "heap_contacts.h"

#include <algorithm>
#include <cmath>

namespace afm::physics {
namespace {

// Derivative with a rod's turn of the way of a point of it along a unit vector.
double turning_of(const HeapContacts::Body& body, const Flat& point, double ux, double uy) noexcept {
  if (!body.is_rod()) return 0.0;
  const double tangent = half_tangent(body.turned_m, body.half_m);
  const double arm = ((point.x - body.at.x) * body.axis.x + (point.y - body.at.y) * body.axis.y) / body.half_m;
  return arm / (1.0 + tangent * tangent) * (uy * body.axis.x - ux * body.axis.y);
}

}  // namespace

void HeapContacts::begin(const Apex& base, const Apex& apex) noexcept {
  base_ = base;
  apex_ = apex;
  count_ = pair_count_ = near_count_ = 0;
}

bool HeapContacts::add(const Body& body) noexcept {
  if (count_ == kMostActive) return false;
  if (body.near_tip) near_[near_count_++] = count_;
  link_count_[count_] = 0;
  mover_[count_] = kMostActive;
  particles_[count_] = body.particle;
  bodies_[count_++] = body;
  return true;
}

bool HeapContacts::add(const Pair& pair) noexcept {
  const bool stays = pair.second == kMostActive;
  if (pair_count_ == kMostPairs || link_count_[pair.first] == kMostLinks) return false;
  if (!stays && link_count_[pair.second] == kMostLinks) return false;
  const auto number = static_cast<std::uint16_t>(pair_count_);
  links_[pair.first][link_count_[pair.first]++] = number;
  if (!stays) links_[pair.second][link_count_[pair.second]++] = number;
  pairs_[pair_count_] = pair;
  pairs_[pair_count_++].of_spheres =
      bodies_[pair.first].is_sphere() &&
      (stays ? !(pair.stays.half_m > 0.0) && !(pair.stays.core_m > 0.0) : bodies_[pair.second].is_sphere());
  return true;
}

std::size_t HeapContacts::find(std::size_t particle) const noexcept {
  std::size_t i = 0;
  while (i < count_ && particles_[i] != particle) ++i;
  return i;
}

void HeapContacts::find_contacts() noexcept {
  for (const std::size_t i : near_tip()) tips_[i] = contact_at(i, bodies_[i].place(), apex_);
  for (std::size_t p = 0; p < pair_count_; ++p) {
    const Nearest nearest = nearest_now(pairs_[p]);
    apart_m_[p] = distance_between(nearest.first, nearest.second);
  }
}

double HeapContacts::stored() const noexcept {
  const double x = apex_.x - base_.x, y = apex_.y - base_.y, z = apex_.height - base_.height;
  const double lever_j = 0.5 * (springs_.lateral.si * (x * x + y * y) + springs_.normal.si * z * z);
  double squares = 0.0;
  for (const std::size_t i : near_tip()) {
    const double depth = acts(i, tips_[i]) ? tips_[i].overlap.depth_m : 0.0;
    squares += depth * depth;
  }
  for (std::size_t p = 0; p < pair_count_; ++p) {
    const double depth = std::max(0.0, pairs_[p].distance_m - apart_m_[p]);
    squares += depth * depth;
  }
  return lever_j + 0.5 * springs_.contact.si * squares;
}

double HeapContacts::friction() const noexcept {
  double lost_j = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Body& body = bodies_[i];
    if (!body.moved()) continue;
    const double way_m =
        body.is_rod() ? mean_way(body.motion_to(body.place())).way : distance_between(body.at, body.start);
    lost_j += body.moving_n * way_m;
  }
  return lost_j;
}

void HeapContacts::choose(std::span<const std::size_t> movers) noexcept {
  std::fill_n(mover_.begin(), count_, kMostActive);
  for (std::size_t m = 0; m < movers.size(); ++m) mover_[movers[m]] = m;
}

HeapContacts::Place HeapContacts::Body::place_at(const Flat& there, double turned_there_m) const {
  if (!is_rod()) return {there, 0.0, axis};
  return {there, turned_there_m, turned(start_axis, half_tangent(turned_there_m, half_m))};
}

RodVector HeapContacts::Body::motion_to(const Place& there) const {
  const double x = there.at.x - start.x, y = there.at.y - start.y;
  return {x * start_axis.x + y * start_axis.y, y * start_axis.x - x * start_axis.y, there.turned_m};
}

HeapContacts::TipContact HeapContacts::contact_at(std::size_t i, const Place& at, const Apex& apex) const noexcept {
  const Flat point = nearest_on(bodies_[i].outline(at), {apex.x, apex.y});
  const double x = point.x - apex.x, y = point.y - apex.y, away_m = std::sqrt(x * x + y * y);
  return {x, y, away_m, bodies_[i].profile->overlap(away_m, apex.height)};
}

HeapContacts::Place HeapContacts::place_of(std::size_t i, const Step& step) const noexcept {
  return mover_[i] == kMostActive ? bodies_[i].place() : step.to[mover_[i]];
}

Outline HeapContacts::second_of(const Pair& pair) const noexcept {
  if (pair.second == kMostActive) return pair.stays;
  const Body& second = bodies_[pair.second];
  return second.outline(second.place());
}

HeapContacts::Nearest HeapContacts::nearest_of(const Pair& pair, const Outline& first, const Outline& second) noexcept {
  if (pair.first_end != 0) {
    const Flat end = along(first, pair.first_end * first.half_m);
    return {end, nearest_on(second, end)};
  }
  if (pair.second_end != 0) {
    const Flat end = along(second, pair.second_end * second.half_m);
    return {nearest_on(first, end), end};
  }
  return {nearest_on(first, second.at), nearest_on(second, first.at)};  // nearest points, if one body is a sphere
}

// Changes are summed from differences: near rest they are smaller than what rounding leaves of the sums themselves.
double HeapContacts::change_of(const Step& step) noexcept {
  const Apex& apex = step.moves_apex ? step.apex : apex_;
  double change_j = step.moves_apex ? lever_change(apex) : 0.0;
  for (const std::size_t i : near_tip()) {
    if (!step.moves_apex && mover_[i] == kMostActive) continue;
    const Place to = place_of(i, step);
    tips_then_[i] = contact_at(i, to, apex);
    change_j += tip_change(i, to, apex);
  }
  for (std::size_t m = 0; m < step.count; ++m) {
    const std::size_t i = step.movers[m];
    change_j += friction_change(i, step.to[m]);
    for (const std::size_t p : pairs_of(i)) {
      if (counts_to(i, p)) change_j += pair_change(p, step);
    }
  }
  return change_j;
}

void HeapContacts::take(const Step& step) noexcept {
  for (const std::size_t i : near_tip()) {
    if (step.moves_apex || mover_[i] != kMostActive) tips_[i] = tips_then_[i];
  }
  if (step.moves_apex) apex_ = step.apex;
  for (std::size_t m = 0; m < step.count; ++m) {
    const std::size_t i = step.movers[m];
    bodies_[i].at = step.to[m].at;
    bodies_[i].turned_m = step.to[m].turned_m;
    bodies_[i].axis = step.to[m].axis;
    for (const std::size_t p : pairs_of(i)) {
      if (counts_to(i, p)) apart_m_[p] = apart_then_m_[p];
    }
  }
}

double HeapContacts::lever_change(const Apex& to) const noexcept {
  const double sideways = (to.x - apex_.x) * ((to.x - base_.x) + (apex_.x - base_.x)) +
                          (to.y - apex_.y) * ((to.y - base_.y) + (apex_.y - base_.y));
  const double upwards = (to.height - apex_.height) * ((to.height - base_.height) + (apex_.height - base_.height));
  return 0.5 * (springs_.lateral.si * sideways + springs_.normal.si * upwards);
}

// Change of a contact's energy, computed as a difference if both contacts are on the same side of the tip.
double HeapContacts::tip_change(std::size_t i, const Place& to, const Apex& apex) const noexcept {
  const TipContact &was = tips_[i], &now = tips_then_[i];
  const double depth0 = was.overlap.depth_m, depth1 = now.overlap.depth_m, k = 0.5 * springs_.contact.si;
  if (!acts(i, was)) return acts(i, now) ? k * depth1 * depth1 : 0.0;
  if (!acts(i, now)) return -k * depth0 * depth0;
  const TipProfile& profile = *bodies_[i].profile;
  const double flank = profile.flank_sine(), rise = apex.height - apex_.height;
  const bool rod = bodies_[i].is_rod() || bodies_[i].core_m > 0.0;  // true: the nearest point moves along the body
  const double dx = rod ? now.x - was.x : (to.at.x - bodies_[i].at.x) - (apex.x - apex_.x);
  const double dy = rod ? now.y - was.y : (to.at.y - bodies_[i].at.y) - (apex.y - apex_.y);
  const double squares = dx * (was.x + now.x) + dy * (was.y + now.y);
  double change = depth1 - depth0;
  if (was.overlap.sine == flank && now.overlap.sine == flank) {
    const double ways = was.away_m + now.away_m;
    change = -(ways > 0.0 ? squares / ways : 0.0) * now.overlap.cosine - rise * flank;
  } else if (was.overlap.sine > flank && now.overlap.sine > flank) {
    const double drops = apex.height + apex_.height + 2.0 * profile.cap_offset_m();
    change = -(squares + rise * drops) / ((profile.reach_sum_m() - depth0) + (profile.reach_sum_m() - depth1));
  }
  return k * change * (depth0 + depth1);
}

double HeapContacts::friction_change(std::size_t i, const Place& there) const noexcept {
  const Body& body = bodies_[i];
  if (body.is_rod()) {
    return body.moving_n * (mean_way(body.motion_to(there)).way - mean_way(body.motion_to(body.place())).way);
  }
  const Flat& to = there.at;
  const double x0 = body.at.x - body.start.x, y0 = body.at.y - body.start.y;
  const double x1 = to.x - body.start.x, y1 = to.y - body.start.y;
  const double ways = std::sqrt(x0 * x0 + y0 * y0) + std::sqrt(x1 * x1 + y1 * y1);
  if (!(ways > 0.0)) return 0.0;
  return body.moving_n * ((to.x - body.at.x) * (x0 + x1) + (to.y - body.at.y) * (y0 + y1)) / ways;
}

double HeapContacts::pair_change(std::size_t p, const Step& step) noexcept {
  const Pair& pair = pairs_[p];
  const Nearest now = nearest_then(pair, step);
  const Flat &a1 = now.first, &b1 = now.second;
  const double apart0 = apart_m_[p], apart1 = apart_then_m_[p] = distance_between(a1, b1);
  const double depth0 = std::max(0.0, pair.distance_m - apart0), depth1 = std::max(0.0, pair.distance_m - apart1);
  if (!(depth0 + depth1 > 0.0)) return 0.0;
  double change = depth1 - depth0;
  if (depth0 > 0.0 && depth1 > 0.0) {
    const auto [a0, b0] = nearest_now(pair);
    const double dx = (a1.x - a0.x) - (b1.x - b0.x), dy = (a1.y - a0.y) - (b1.y - b0.y);
    const double squares = dx * ((a1.x - b1.x) + (a0.x - b0.x)) + dy * ((a1.y - b1.y) + (a0.y - b0.y));
    change = -squares / (apart0 + apart1);
  }
  return 0.5 * springs_.contact.si * change * (depth0 + depth1);
}

HeapContacts::Normal HeapContacts::normal_of(std::size_t i) const noexcept {
  const Body& body = bodies_[i];
  if (!body.near_tip) return {};
  const TipContact& tip = tips_[i];
  const double ux = tip.away_m > 0.0 ? tip.x / tip.away_m : 1.0, uy = tip.away_m > 0.0 ? tip.y / tip.away_m : 0.0;
  const bool ball = tip.overlap.sine > body.profile->flank_sine();
  return {
      .overlap_m = tip.overlap.depth_m,
      .acts = acts(i, tip),
      .towards = {ux * tip.overlap.cosine, uy * tip.overlap.cosine, -tip.overlap.sine},
      .apart_m = std::max(1e-30, ball ? body.profile->reach_sum_m() - tip.overlap.depth_m : tip.away_m + body.core_m),
      .ball = ball,
      .turning = -turning_of(body, {tip.x + apex_.x, tip.y + apex_.y}, ux, uy) * tip.overlap.cosine};
}

HeapContacts::Touch HeapContacts::touch_of(std::size_t p) const noexcept {
  const Pair& pair = pairs_[p];
  const double apart = apart_m_[p], depth = pair.distance_m - apart;
  if (!(apart > 0.0)) return {};
  const auto [first, second] = nearest_now(pair);
  const double ux = (first.x - second.x) / apart, uy = (first.y - second.y) / apart;
  if (pair.of_spheres) return {.overlap_m = depth, .apart_m = apart, .u = {ux, uy}};
  const Body& body = bodies_[pair.first];
  const bool stays = pair.second == kMostActive;
  return {.overlap_m = depth,
          .apart_m = apart + body.core_m + (stays ? pair.stays.core_m : bodies_[pair.second].core_m),
          .u = {ux, uy},
          .turning_first = turning_of(body, first, ux, uy),
          .turning_second = stays ? 0.0 : -turning_of(bodies_[pair.second], second, ux, uy)};
}

}  // namespace afm::physics
