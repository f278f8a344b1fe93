// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/push_figures.h"

#include <algorithm>
#include <cmath>

#include "fixed_point.h"
#include "physics/manipulation/rod.h"

namespace afm::physics {
namespace {

constexpr double kLargestLoad = 1e-3;  // upper bound of a load, N

// The largest of k_c h cot(phi(h)) - f_s(k_c h), from the end of the flank over the cap.
double surplus_of_push(const ParticleSpecies& species, const SphereCone& tip, double spring) {
  constexpr int kHeights = 400;
  const double radius = species.contact.tip_radius.si;
  const double crest = std::max(0.0, crest_height(tip, Length(radius)).si);
  double most = -HUGE_VAL;
  for (int i = 0; i < kHeights; ++i) {
    const double height = crest + (2.0 * radius - crest) * i / kHeights;
    const SideContact at = side_contact(tip, Length(radius), Length(height));
    if (!(at.sine > 0.0)) continue;
    const double load = spring * height;
    most = std::max(most, load * at.cosine / at.sine - sliding_threshold(species, Force(load)).si);
  }
  return most;
}

}  // namespace

Stiffness stiffness_along_normal(const PushSprings& springs, double sine, double cosine) noexcept {
  return Stiffness(1.0 /
                   (1.0 / springs.contact.si + cosine * cosine / springs.lateral.si + sine * sine / springs.normal.si));
}

Stiffness stiffness_sideways(const PushSprings& springs, double sine, double cosine) noexcept {
  return stiffness_along_normal(springs, sine, cosine) * (cosine * cosine);
}

Force gentle_load(const ParticleSpecies& species, const SphereCone& tip, double tip_friction) {
  const double slope = std::tan(tip.half_angle_rad - std::atan(tip_friction));
  if (!(slope > 0.0)) return Force(0.0);
  return Force(
      least_fixed_point([&](double load) { return slope * sliding_threshold(species, Force(load)).si; }, kLargestLoad));
}

Force climbing_load(const ParticleSpecies& species, const SphereCone& tip, double tip_friction) {
  const bool locks = std::atan(tip_friction) >= tip.half_angle_rad;
  const double friction = locks ? 0.0 : tip_friction;
  if (!is_rod(species)) return gentle_load(species, tip, friction);
  const double slope = std::tan(tip.half_angle_rad - std::atan(friction));
  return slope * rod_threshold(species.measured_threshold, species.length, 0.5 * species.length);
}

Stiffness softest_lever(const ParticleSpecies& species, const SphereCone& tip) {
  double soft = 1e-9, stiff = 1e6;
  if (surplus_of_push(species, tip, stiff) < 0.0) return Stiffness(HUGE_VAL);
  while (stiff > soft * (1.0 + 1e-12)) {
    const double middle = std::sqrt(soft * stiff);
    if (!(middle > soft && middle < stiff)) break;
    (surplus_of_push(species, tip, middle) < 0.0 ? soft : stiff) = middle;
  }
  return Stiffness(stiff);
}

Force largest_push(const SphereCone& tip, Length sphere_radius, Stiffness normal_spring, Force preload) noexcept {
  const Length crest{std::max(0.0, crest_height(tip, sphere_radius).si)};
  return (preload + normal_spring * crest) / std::tan(tip.half_angle_rad);
}

double largest_offset(double travel_over_rho) noexcept { return 1.0 / std::cosh(travel_over_rho); }

Velocity fastest_steering(Length rho, Time delay) noexcept { return rho / delay; }

}  // namespace afm::physics
