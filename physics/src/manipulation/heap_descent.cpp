// SPDX-License-Identifier: Apache-2.0
#include "heap_descent.h"

#include <algorithm>
#include <cmath>

namespace afm::physics {
namespace {

constexpr double kTinyGain = 1e-14;  // smallest gain of a round that counts, as a share of E + R
constexpr int kMostHalvings = 8;
constexpr double kRestRounding = 1e-12;  // share by which a force must exceed a threshold

// Solves stiffness * step = -gradient for a symmetric positive definite matrix (Cholesky). False if it is not.
template <class Matrix, class Vector>
bool solve_definite(std::size_t size, Matrix& stiffness, const Vector& gradient, Vector& step) noexcept {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double value = stiffness[i][j];
      for (std::size_t k = 0; k < j; ++k) value -= stiffness[i][k] * stiffness[j][k];
      if (i == j) {
        if (!(value > 0.0)) return false;
        stiffness[i][i] = std::sqrt(value);
      } else {
        stiffness[i][j] = value / stiffness[j][j];
      }
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    double value = -gradient[i];
    for (std::size_t k = 0; k < i; ++k) value -= stiffness[i][k] * step[k];
    step[i] = value / stiffness[i][i];
  }
  for (std::size_t i = size; i-- > 0;) {
    double value = step[i];
    for (std::size_t k = i + 1; k < size; ++k) value -= stiffness[k][i] * step[k];
    step[i] = value / stiffness[i][i];
  }
  return true;
}

double distance_between(const Flat& a, const Flat& b) noexcept {
  const double x = a.x - b.x, y = a.y - b.y;
  return std::sqrt(x * x + y * y);
}

}  // namespace

bool may_be_taken(double change_j) noexcept { return change_j < 0.0; }

void HeapDescent::begin(const Apex& base, const Apex& apex, double reach_m) noexcept {
  base_ = base;
  start_ = apex_ = apex;
  reach_m_ = reach_m;
  count_ = pair_count_ = 0;
}

bool HeapDescent::add(const Sphere& sphere) noexcept {
  if (count_ == kMostActive) return false;
  spheres_[count_++] = sphere;
  return true;
}

bool HeapDescent::add(const Pair& pair) noexcept {
  if (pair_count_ == kMostPairs) return false;
  pairs_[pair_count_++] = pair;
  return true;
}

double HeapDescent::stored(const Apex& apex) const noexcept {
  const double x = apex.x - base_.x, y = apex.y - base_.y, z = apex.height - base_.height;
  double energy_j = 0.5 * (springs_.lateral.si * (x * x + y * y) + springs_.normal.si * z * z);
  double squares = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Sphere& sphere = spheres_[i];
    const double depth = sphere.profile->overlap(distance_between(sphere.at, {apex.x, apex.y}), apex.height).depth_m;
    if (depth > 0.0) squares += depth * depth;
  }
  for (std::size_t p = 0; p < pair_count_; ++p) {
    const Pair& pair = pairs_[p];
    const Flat& other = pair.second == kMostActive ? pair.stays : spheres_[pair.second].at;
    const double depth = pair.distance_m - distance_between(spheres_[pair.first].at, other);
    if (depth > 0.0) squares += depth * depth;
  }
  return energy_j + 0.5 * springs_.contact.si * squares;
}

double HeapDescent::friction() const noexcept {
  double lost_j = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (spheres_[i].moved()) lost_j += spheres_[i].moving_n * distance_between(spheres_[i].at, spheres_[i].start);
  }
  return lost_j;
}

HeapDescent::Places HeapDescent::places() const noexcept {
  Places now{.apex = apex_};
  for (std::size_t i = 0; i < count_; ++i) now.spheres[i] = spheres_[i].at;
  return now;
}

void HeapDescent::restore(const Places& places) noexcept {
  apex_ = places.apex;
  for (std::size_t i = 0; i < count_; ++i) spheres_[i].at = places.spheres[i];
}

// Change of the overlap of tip and sphere; as a difference where both contacts are on the same side of the tip.
double HeapDescent::overlap_change(const Sphere& sphere, const Flat& was, const Apex& apex_was) const noexcept {
  const double x0 = was.x - apex_was.x, y0 = was.y - apex_was.y, x1 = sphere.at.x - apex_.x, y1 = sphere.at.y - apex_.y;
  const double away0 = std::sqrt(x0 * x0 + y0 * y0), away1 = std::sqrt(x1 * x1 + y1 * y1);
  const Overlap before = sphere.profile->overlap(away0, apex_was.height),
                now = sphere.profile->overlap(away1, apex_.height);
  if (before.depth_m <= 0.0 && now.depth_m <= 0.0) return 0.0;
  const double k = 0.5 * springs_.contact.si;
  if (before.depth_m <= 0.0) return k * now.depth_m * now.depth_m;
  if (now.depth_m <= 0.0) return -k * before.depth_m * before.depth_m;
  const double flank = sphere.profile->flank_sine();
  double change = now.depth_m - before.depth_m;
  const double dx = (sphere.at.x - was.x) - (apex_.x - apex_was.x), dy = (sphere.at.y - was.y) - (apex_.y - apex_was.y);
  const double squares = dx * (x0 + x1) + dy * (y0 + y1), rise = apex_.height - apex_was.height;
  if (before.sine == flank && now.sine == flank) {
    change = -(away0 + away1 > 0.0 ? squares / (away0 + away1) : 0.0) * now.cosine - rise * flank;
  } else if (before.sine > flank && now.sine > flank) {
    const double apart0 = sphere.profile->reach_sum_m() - before.depth_m,
                 apart1 = sphere.profile->reach_sum_m() - now.depth_m;
    const double drops = apex_.height + apex_was.height + 2.0 * sphere.profile->cap_offset_m();
    change = -(squares + rise * drops) / (apart0 + apart1);
  }
  return k * change * (now.depth_m + before.depth_m);
}

// Change of E + R, summed from differences: near rest it is smaller than what rounding leaves of the sums themselves.
double HeapDescent::change_since(const Places& before) const noexcept {
  const Apex& was = before.apex;
  double change_j = 0.5 * springs_.lateral.si *
                    ((apex_.x - was.x) * ((apex_.x - base_.x) + (was.x - base_.x)) +
                     (apex_.y - was.y) * ((apex_.y - base_.y) + (was.y - base_.y)));
  change_j += 0.5 * springs_.normal.si * (apex_.height - was.height) *
              ((apex_.height - base_.height) + (was.height - base_.height));
  for (std::size_t i = 0; i < count_; ++i) {
    const Sphere& sphere = spheres_[i];
    const Flat& old = before.spheres[i];
    change_j += overlap_change(sphere, old, was);
    const double x0 = old.x - sphere.start.x, y0 = old.y - sphere.start.y;
    const double x1 = sphere.at.x - sphere.start.x, y1 = sphere.at.y - sphere.start.y;
    const double ways = std::sqrt(x0 * x0 + y0 * y0) + std::sqrt(x1 * x1 + y1 * y1);
    if (ways > 0.0) {
      change_j += sphere.moving_n * ((sphere.at.x - old.x) * (x0 + x1) + (sphere.at.y - old.y) * (y0 + y1)) / ways;
    }
  }
  for (std::size_t p = 0; p < pair_count_; ++p) {
    const Pair& pair = pairs_[p];
    const bool stays = pair.second == kMostActive;
    const Flat &a1 = spheres_[pair.first].at, &a0 = before.spheres[pair.first];
    const Flat& b1 = stays ? pair.stays : spheres_[pair.second].at;
    const Flat& b0 = stays ? pair.stays : before.spheres[pair.second];
    const double apart0 = distance_between(a0, b0), apart1 = distance_between(a1, b1);
    const double depth0 = std::max(0.0, pair.distance_m - apart0), depth1 = std::max(0.0, pair.distance_m - apart1);
    if (!(depth0 + depth1 > 0.0)) continue;
    double change = depth1 - depth0;
    if (depth0 > 0.0 && depth1 > 0.0) {
      const double dx = (a1.x - a0.x) - (b1.x - b0.x), dy = (a1.y - a0.y) - (b1.y - b0.y);
      const double squares = dx * ((a1.x - b1.x) + (a0.x - b0.x)) + dy * ((a1.y - b1.y) + (a0.y - b0.y));
      change = -squares / (apart0 + apart1);
    }
    change_j += 0.5 * springs_.contact.si * change * (depth0 + depth1);
  }
  return change_j;
}

HeapDescent::Normal HeapDescent::normal_to(const Sphere& sphere, const Apex& apex) const noexcept {
  const double x = sphere.at.x - apex.x, y = sphere.at.y - apex.y;
  const double away = std::sqrt(x * x + y * y);
  const Overlap overlap = sphere.profile->overlap(away, apex.height);
  const double ux = away > 0.0 ? x / away : 1.0, uy = away > 0.0 ? y / away : 0.0;
  Normal normal;
  normal.overlap_m = overlap.depth_m;
  normal.towards = {ux * overlap.cosine, uy * overlap.cosine, -overlap.sine};
  normal.ball = overlap.sine > sphere.profile->flank_sine();
  normal.apart_m = std::max(1e-30, normal.ball ? sphere.profile->reach_sum_m() - overlap.depth_m : away);
  return normal;
}

// Force of E on a sphere, and the stiffness of what it touches.
Flat HeapDescent::pull_on(std::size_t i, double& spring) const noexcept {
  const Sphere& sphere = spheres_[i];
  const double k_n = springs_.contact.si;
  Flat force;
  spring = 0.0;
  if (const Normal normal = normal_to(sphere, apex_); normal.overlap_m > 0.0) {
    force.x += k_n * normal.overlap_m * normal.towards[0];
    force.y += k_n * normal.overlap_m * normal.towards[1];
    spring += k_n;
  }
  for (std::size_t p = 0; p < pair_count_; ++p) {
    const Pair& pair = pairs_[p];
    if (pair.first != i && pair.second != i) continue;
    const Flat& first = spheres_[pair.first].at;
    const Flat& other = pair.second == kMostActive ? pair.stays : spheres_[pair.second].at;
    const double apart = distance_between(first, other), depth = pair.distance_m - apart;
    if (!(depth > 0.0 && apart > 0.0)) continue;
    const double push = (pair.first == i ? k_n : -k_n) * depth / apart;
    force.x += push * (first.x - other.x);
    force.y += push * (first.y - other.y);
    spring += k_n;
  }
  return force;
}

// One proximal step for each sphere: decides which move. Returns whether one moved.
bool HeapDescent::sweep(double& gained_j) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < count_; ++i) {
    Sphere& sphere = spheres_[i];
    if (sphere.pinned) continue;
    double spring = 0.0;
    const Flat force = pull_on(i, spring);
    if (!(spring > 0.0)) continue;
    const bool at_rest = !sphere.moved();
    const double size = std::sqrt(force.x * force.x + force.y * force.y);
    if (at_rest && size <= sphere.rest_n * (1.0 + kRestRounding)) continue;
    const double f = sphere.moving_n;
    const double zx = sphere.at.x + force.x / spring - sphere.start.x;
    const double zy = sphere.at.y + force.y / spring - sphere.start.y;
    const double way = std::sqrt(zx * zx + zy * zy);
    const double share = way * spring > f ? 1.0 - f / (spring * way) : 0.0;
    const Places before = places();
    const Flat& was = before.spheres[i];
    double step = 1.0;
    bool taken = false;
    for (int halving = 0; halving < kMostHalvings && !taken; ++halving, step *= 0.5) {
      sphere.at = {was.x + step * (sphere.start.x + share * zx - was.x),
                   was.y + step * (sphere.start.y + share * zy - was.y)};
      if (step == 1.0 && share == 0.0) sphere.at = sphere.start;
      if (distance_between(sphere.at, sphere.start) > reach_m_) continue;
      if (const double change_j = change_since(before); may_be_taken(change_j)) {
        gained_j -= change_j;
        any = taken = true;
      }
    }
    if (!taken) sphere.at = was;
  }
  return any;
}

void HeapDescent::add_tip(System& s, const std::array<std::size_t, kMostActive>& place, std::size_t i,
                          bool curved) const noexcept {
  const Normal normal = normal_to(spheres_[i], apex_);
  if (!(normal.overlap_m > 0.0)) return;
  const double k = springs_.contact.si, force = k * normal.overlap_m;
  const auto& d = normal.towards;
  // d overlap/d apex = d, against the sphere: -d; curvature -(1 - dd')/r, on the flank in the plane alone
  const double away = std::sqrt(d[0] * d[0] + d[1] * d[1]);
  const std::array<double, 3> u{away > 0.0 ? d[0] / away : 1.0, away > 0.0 ? d[1] / away : 0.0, 0.0};
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      double value = k * d[a] * d[b];
      if (curved) {
        const double same = a == b ? 1.0 : 0.0;
        if (normal.ball) value -= force * (same - d[a] * d[b]) / normal.apart_m;
        if (!normal.ball && a < 2 && b < 2) value -= force * away * (same - u[a] * u[b]) / normal.apart_m;
      }
      s.stiffness[a][b] += value;
      if (place[i] == 0) continue;
      if (b < 2) s.stiffness[a][place[i] + b] -= value;
      if (a < 2) s.stiffness[place[i] + a][b] -= value;
      if (a < 2 && b < 2) s.stiffness[place[i] + a][place[i] + b] += value;
    }
    s.gradient[a] += force * d[a];
    if (place[i] != 0 && a < 2) s.gradient[place[i] + a] -= force * d[a];
  }
}

void HeapDescent::add_pair(System& s, const std::array<std::size_t, kMostActive>& place, const Pair& pair,
                           bool curved) const noexcept {
  const Flat& first = spheres_[pair.first].at;
  const bool stays = pair.second == kMostActive;
  const Flat& other = stays ? pair.stays : spheres_[pair.second].at;
  const double apart = distance_between(first, other), depth = pair.distance_m - apart;
  if (!(depth > 0.0 && apart > 0.0)) return;
  const double k = springs_.contact.si;
  const std::array<double, 2> u{(first.x - other.x) / apart, (first.y - other.y) / apart};
  const std::size_t p = place[pair.first], q = stays ? 0 : place[pair.second];
  for (std::size_t a = 0; a < 2; ++a) {
    for (std::size_t b = 0; b < 2; ++b) {
      double value = k * u[a] * u[b];
      if (curved) value -= k * depth * ((a == b ? 1.0 : 0.0) - u[a] * u[b]) / apart;
      if (p != 0) s.stiffness[p + a][p + b] += value;
      if (q != 0) s.stiffness[q + a][q + b] += value;
      if (p != 0 && q != 0) {
        s.stiffness[p + a][q + b] -= value;
        s.stiffness[q + a][p + b] -= value;
      }
    }
    if (p != 0) s.gradient[p + a] -= k * depth * u[a];
    if (q != 0) s.gradient[q + a] += k * depth * u[a];
  }
}

// Gradient and stiffness of E + R over the apex and the spheres with a place.
void HeapDescent::assemble(System& s, const std::array<std::size_t, kMostActive>& place, bool curved) const noexcept {
  const double k_l = springs_.lateral.si, k_c = springs_.normal.si;
  s.gradient = {k_l * (apex_.x - base_.x), k_l * (apex_.y - base_.y), k_c * (apex_.height - base_.height)};
  s.stiffness = {};
  s.stiffness[0][0] = s.stiffness[1][1] = k_l;
  s.stiffness[2][2] = k_c;
  for (std::size_t i = 0; i < count_; ++i) add_tip(s, place, i, curved);
  for (std::size_t p = 0; p < pair_count_; ++p) add_pair(s, place, pairs_[p], curved);
  for (std::size_t i = 0; i < count_; ++i) {
    if (place[i] == 0) continue;
    const Sphere& sphere = spheres_[i];
    const double x = sphere.at.x - sphere.start.x, y = sphere.at.y - sphere.start.y;
    const double way = std::sqrt(x * x + y * y);
    const std::array<double, 2> u{x / way, y / way};
    for (std::size_t a = 0; a < 2; ++a) {
      s.gradient[place[i] + a] += sphere.moving_n * u[a];
      for (std::size_t b = 0; b < 2; ++b) {
        s.stiffness[place[i] + a][place[i] + b] += sphere.moving_n / way * ((a == b ? 1.0 : 0.0) - u[a] * u[b]);
      }
    }
  }
  // an apex that the lever presses on the sample stays there
  if (apex_.height <= 0.0 && s.gradient[2] > 0.0) {
    for (std::size_t j = 0; j < s.size; ++j) s.stiffness[2][j] = s.stiffness[j][2] = 0.0;
    s.stiffness[2][2] = k_c;
    s.gradient[2] = 0.0;
  }
}

bool HeapDescent::within_reach(const Apex& apex) const noexcept {
  const double x = apex.x - start_.x, y = apex.y - start_.y, z = apex.height - start_.height;
  if (!(x * x + y * y + z * z <= reach_m_ * reach_m_)) return false;
  return std::all_of(spheres_.begin(), spheres_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [this](const Sphere& s) { return distance_between(s.at, s.start) <= reach_m_; });
}

// One Newton step of the apex, and of the spheres that move. Taken only if it lowers the sum.
bool HeapDescent::newton(double& gained_j, bool tip_alone) noexcept {
  System system;
  std::array<std::size_t, kMostActive> place{};
  for (std::size_t i = 0; i < count_ && !tip_alone; ++i) {
    if (!spheres_[i].moved() || system.size + 2 > kMostUnknowns) continue;
    place[i] = system.size;
    system.size += 2;
  }
  std::array<double, kMostUnknowns> step{};
  assemble(system, place, true);
  if (!solve_definite(system.size, system.stiffness, system.gradient, step)) {
    assemble(system, place, false);
    if (!solve_definite(system.size, system.stiffness, system.gradient, step)) return false;
  }
  const Places before = places();
  double share = 1.0;
  for (int halving = 0; halving < kMostHalvings; ++halving, share *= 0.5) {
    const Apex& was = before.apex;
    apex_ = {was.x + share * step[0], was.y + share * step[1], std::max(0.0, was.height + share * step[2])};
    for (std::size_t i = 0; i < count_; ++i) {
      const Flat& old = before.spheres[i];
      if (place[i] != 0) spheres_[i].at = {old.x + share * step[place[i]], old.y + share * step[place[i] + 1]};
    }
    if (!within_reach(apex_)) continue;
    if (const double change_j = change_since(before); may_be_taken(change_j)) {
      gained_j -= change_j;
      return true;
    }
  }
  restore(before);
  return false;
}

bool HeapDescent::descend(int most_steps) noexcept {
  int steps = 0;
  while (steps < most_steps) {
    double gained_j = 0.0;
    for (int i = 0; i < 3 && steps < most_steps; ++i, ++steps) {
      if (!newton(gained_j, true)) break;
    }
    bool moved = sweep(gained_j);
    ++steps;
    for (int i = 0; i < 3 && steps < most_steps; ++i, ++steps) {
      if (!newton(gained_j, false)) break;
      moved = true;
    }
    if (!moved || gained_j <= kTinyGain * (stored() + friction())) return true;
  }
  return false;
}

}  // namespace afm::physics
