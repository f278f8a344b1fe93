// SPDX-License-Identifier: Apache-2.0
#include "carried_sphere.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "definite_solution.h"

namespace afm::physics {
namespace {

constexpr int kMostSettling = 16;
constexpr int kSettleHalvings = 8;
constexpr double kSettledGain = 1e-12;  // smallest gain of a step that counts, as a fraction of the energy

}  // namespace

void CarriedSphere::take(std::size_t particle, Length radius, const Flat& at, const SphereCone& tip, const Apex& apex,
                         double touches_at_m) noexcept {
  const double x = at.x - apex.x, y = at.y - apex.y, away_m = std::sqrt(x * x + y * y);
  particle_ = particle;
  radius_m_ = radius.si;
  from_ = at;
  lowest_apex_m_ = std::max(0.0, touches_at_m);
  const double touching_m = side_contact(tip, radius, Length(lowest_apex_m_)).distance.si;
  offset_ = away_m > 0.0 ? Flat{touching_m * x / away_m, touching_m * y / away_m} : Flat{touching_m, 0.0};
}

bool CarriedSphere::add(const Obstacle& obstacle) noexcept {
  if (count_ == kMostObstacles) return false;
  obstacles_[count_++] = obstacle;
  return true;
}

CarriedSphere::Meeting CarriedSphere::of_tip(const Obstacle& obstacle, const Apex& apex) const noexcept {
  const Flat nearest = nearest_on(obstacle.outline, {apex.x, apex.y});
  const double x = nearest.x - apex.x, y = nearest.y - apex.y, away_m = std::sqrt(x * x + y * y);
  const Overlap overlap = obstacle.profile->overlap(away_m, apex.height);
  const double ux = away_m > 0.0 ? x / away_m : 1.0, uy = away_m > 0.0 ? y / away_m : 0.0;
  return {overlap.depth_m, {ux * overlap.cosine, uy * overlap.cosine, -overlap.sine}};
}

CarriedSphere::Meeting CarriedSphere::of_sphere(const Obstacle& obstacle, const Apex& apex) const noexcept {
  const Flat at = place(apex), nearest = nearest_on(obstacle.outline, at);
  const double x = at.x - nearest.x, y = at.y - nearest.y, z = height_m(apex) + radius_m_ - obstacle.radius_m;
  const double apart_m = std::sqrt(x * x + y * y + z * z);
  if (!(apart_m > 0.0)) return {radius_m_ + obstacle.radius_m, {0.0, 0.0, -1.0}};
  return {radius_m_ + obstacle.radius_m - apart_m, {-x / apart_m, -y / apart_m, -z / apart_m}};
}

bool CarriedSphere::touches(const Apex& apex) const noexcept {
  return std::any_of(
      obstacles_.begin(), obstacles_.begin() + static_cast<std::ptrdiff_t>(count_),
      [&](const Obstacle& o) { return of_tip(o, apex).overlap_m > 0.0 || of_sphere(o, apex).overlap_m > 0.0; });
}

bool CarriedSphere::is_free(const Apex& base, const Apex& apex) const noexcept {
  const Apex rests = at_rest(base);
  return apex.x == rests.x && apex.y == rests.y && apex.height == rests.height && !touches(apex);
}

double CarriedSphere::pressed_j(const Apex& apex) const noexcept {
  double sum_j = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double depth_m = std::max(0.0, of_sphere(obstacles_[i], apex).overlap_m);
    sum_j += 0.5 * springs_.contact.si * depth_m * depth_m;
  }
  return sum_j;
}

double CarriedSphere::energy_j(const Apex& base, const Apex& apex) const noexcept {
  double squares = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double tip_m = std::max(0.0, of_tip(obstacles_[i], apex).overlap_m);
    const double sphere_m = std::max(0.0, of_sphere(obstacles_[i], apex).overlap_m);
    squares += tip_m * tip_m + sphere_m * sphere_m;
  }
  return lever_j(springs_, base, apex) + 0.5 * springs_.contact.si * squares;
}

// The step to the minimum of lever and touching contacts, as if those were flat.
bool CarriedSphere::newton(const Apex& base, const Apex& apex, Vector& step) const noexcept {
  const double k_l = springs_.lateral.si, k_c = springs_.normal.si, k_n = springs_.contact.si;
  Vector gradient{k_l * (apex.x - base.x), k_l * (apex.y - base.y), k_c * (apex.height - base.height)};
  Matrix stiffness{Vector{k_l, 0.0, 0.0}, Vector{0.0, k_l, 0.0}, Vector{0.0, 0.0, k_c}};
  const auto add = [&](const Meeting& meeting) {
    if (!(meeting.overlap_m > 0.0)) return;
    for (std::size_t row = 0; row < 3; ++row) {
      gradient[row] += k_n * meeting.overlap_m * meeting.towards[row];
      for (std::size_t column = 0; column < 3; ++column) {
        stiffness[row][column] += k_n * meeting.towards[row] * meeting.towards[column];
      }
    }
  };
  for (std::size_t i = 0; i < count_; ++i) {
    add(of_tip(obstacles_[i], apex));
    add(of_sphere(obstacles_[i], apex));
  }
  // a sphere that lies on the sample moves along it
  const bool along_sample = lies(apex) && gradient[2] > 0.0;
  step = {};
  return solve_definite(along_sample ? 2U : 3U, stiffness, gradient, step);
}

bool CarriedSphere::settle(const Apex& base, double reach_m, Apex& apex) const noexcept {
  const Apex rests = at_rest(base);
  if (is_within(reach_m, rests, apex) && !touches(rests)) {
    apex = rests;
    return true;
  }
  const Apex start = apex;
  double now_j = energy_j(base, apex);
  for (int i = 0; i < kMostSettling; ++i) {
    Vector step{};
    if (!newton(base, apex, step)) return true;
    const double length_m = std::sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
    double share = length_m > reach_m ? 0.5 * reach_m / length_m : 1.0, gain_j = 0.0;
    bool held_back = length_m > reach_m;
    for (int halving = 0; halving < kSettleHalvings; ++halving, share *= 0.5) {
      const Apex next{apex.x + share * step[0], apex.y + share * step[1],
                      std::max(lowest_apex_m_, apex.height + share * step[2])};
      if (!is_within(reach_m, next, start)) {
        held_back = true;
        continue;
      }
      const double next_j = energy_j(base, next);
      if (!(next_j < now_j)) continue;
      gain_j = now_j - next_j;
      now_j = next_j;
      apex = next;
      break;
    }
    if (held_back) return false;
    if (!(gain_j > kSettledGain * now_j)) return true;
  }
  return false;
}

}  // namespace afm::physics
