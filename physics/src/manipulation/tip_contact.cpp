// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/tip_contact.h"

#include <algorithm>
#include <cmath>

namespace afm::physics {

SideContact side_contact(const SphereCone& tip, Length sphere_radius, Length apex_height) noexcept {
  const Length sum = tip.radius + sphere_radius;
  const double sine = std::sin(tip.half_angle_rad), cosine = std::cos(tip.half_angle_rad);
  const double s = (apex_height + tip.radius - sphere_radius) / sum;
  if (s < sine) return {(sum + sine * (sphere_radius - apex_height - tip.radius)) / cosine, sine, cosine, true};
  if (s > 1.0) return {Length(0.0), 1.0, 0.0, false};
  const double cap_cosine = std::sqrt((1.0 - s) * (1.0 + s));
  return {sum * cap_cosine, s, cap_cosine, false};
}

Length touching_height(const SphereCone& tip, Length sphere_radius, Length distance) noexcept {
  const Length sum = tip.radius + sphere_radius;
  const double sine = std::sin(tip.half_angle_rad), cosine = std::cos(tip.half_angle_rad);
  const double share = distance / sum;
  Length height = sphere_radius - tip.radius;
  if (share <= cosine) {
    height = height + sum * std::sqrt((1.0 - share) * (1.0 + share));
  } else if (sine > 0.0) {
    height = height + (sum - distance * cosine) / sine;
  }
  return std::max(Length(0.0), height);
}

Length crest_height(const SphereCone& tip, Length sphere_radius) noexcept {
  return sphere_radius - tip.radius + (tip.radius + sphere_radius) * std::sin(tip.half_angle_rad);
}

Length effective_radius(const SphereCone& tip, Length sphere_radius, bool on_flank) noexcept {
  if (!on_flank) return tip.radius * (sphere_radius / (tip.radius + sphere_radius));
  const double sine = std::sin(tip.half_angle_rad), cosine = std::cos(tip.half_angle_rad);
  // the cone leaves the cap at the height R_t (1 - sin(theta)), with the radius R_t cos(theta)
  const Length height = sphere_radius * (1.0 + sine);
  const Length cone = tip.radius * cosine + (height - tip.radius * (1.0 - sine)) * (sine / cosine);
  const Length around = cone / cosine;
  const Length across = sphere_radius * (around / (sphere_radius + around));
  return sqrt(across * sphere_radius);
}

TipProfile::TipProfile(const SphereCone& tip, Length sphere_radius) noexcept
    : tip_radius_m_(tip.radius.si),
      sphere_radius_m_(sphere_radius.si),
      sum_m_(tip.radius.si + sphere_radius.si),
      sine_(std::sin(tip.half_angle_rad)),
      cosine_(std::cos(tip.half_angle_rad)),
      crest_m_(crest_height(tip, sphere_radius).si) {}

Overlap TipProfile::overlap(double away_m, double apex_height_m) const noexcept {
  // from the centre of the cap to that of the sphere: `away` sideways, `drop` down
  const double drop_m = apex_height_m + tip_radius_m_ - sphere_radius_m_;
  if (drop_m * cosine_ < away_m * sine_) {
    return {sum_m_ - away_m * cosine_ - drop_m * sine_, sine_, cosine_};
  }
  const double apart_m = std::sqrt(away_m * away_m + drop_m * drop_m);
  if (!(apart_m > 0.0)) return {sum_m_, 1.0, 0.0};
  return {sum_m_ - apart_m, drop_m / apart_m, away_m / apart_m};
}

double TipProfile::flank_distance_m(double apex_height_m) const noexcept {
  return (sum_m_ + sine_ * (sphere_radius_m_ - apex_height_m - tip_radius_m_)) / cosine_;
}

double TipProfile::reach_m() const noexcept { return std::max(sum_m_, flank_distance_m(0.0)); }

}  // namespace afm::physics
