// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

// Contact of a tip with a sphere that lies on the sample (docs/manipulation.md; equation numbers (M...)). Any
// thread.
namespace afm::physics {

// A cone that ends in a ball, tangent to it: the cap. Its half angle is the angle between axis and flank, from 0, a
// rod, to below pi/2.
struct SphereCone {
  Length radius;  // R_t, radius of the cap
  double half_angle_rad = 0.0;
};

// Contact of tip and sphere. The normal points from the tip into the sphere, at the angle phi below the horizontal.
struct SideContact {
  Length distance;    // rho, distance between the axes of tip and sphere
  double sine = 0.0;  // sine of phi
  double cosine = 1.0;
  bool on_flank = true;  // false: the contact is on the cap
};

// With s = (h + R_t - R_p)/(R_t + R_p), h the height of the apex:
//
//   s < sin(theta): phi = theta,     rho = [(R_t + R_p) + sin(theta) (R_p - h - R_t)]/cos(theta)   (M1, flank)
//   otherwise:      sin(phi) = s,    rho = (R_t + R_p) cos(phi)                                    (M2, cap)
//
// For s up to 1, where the apex is on top of the sphere; higher tips do not touch: distance 0.
SideContact side_contact(const SphereCone& tip, Length sphere_radius, Length apex_height) noexcept;

// Height of the apex, from 0, at which a tip touches the sphere at this distance of the axes: the inverse.
Length touching_height(const SphereCone& tip, Length sphere_radius, Length distance) noexcept;

// h_c = R_p - R_t + (R_t + R_p) sin(theta) (M3): the apex height at which the contact passes from flank to cap.
// Negative if the flank of a tip on the sample is too high to touch.
Length crest_height(const SphereCone& tip, Length sphere_radius) noexcept;

// R_eff of the contact: R_t R_p/(R_t + R_p) on the cap; on the flank sqrt(R_a R_p), with 1/R_a = 1/R_p + 1/r and
// r the radius of the cone at the height R_p (1 + sin(theta)), the apex on the sample, over cos(theta) (M4).
Length effective_radius(const SphereCone& tip, Length sphere_radius, bool on_flank) noexcept;

// Overlap of the undeformed bodies along the normal; negative: a gap. `away` is the distance of the axes.
struct Overlap {
  double depth_m = 0.0;
  double sine = 0.0;  // sine of phi
  double cosine = 1.0;
};

// SphereCone for a tick: distinguishes flank and cap without a sine. One sphere radius.
class TipProfile {
 public:
  TipProfile(const SphereCone& tip, Length sphere_radius) noexcept;

  Overlap overlap(double away_m, double apex_height_m) const noexcept;

  double crest_height_m() const noexcept { return crest_m_; }
  double reach_sum_m() const noexcept { return sum_m_; }                             // sum of the radii, R_t + R_p
  double cap_offset_m() const noexcept { return tip_radius_m_ - sphere_radius_m_; }  // R_t - R_p
  double flank_distance_m(double apex_height_m) const noexcept;                      // distance rho of (M1)
  double reach_m() const noexcept;  // distance of the axes beyond which no tip touches
  double flank_sine() const noexcept { return sine_; }
  double flank_cosine() const noexcept { return cosine_; }

 private:
  double tip_radius_m_, sphere_radius_m_, sum_m_;
  double sine_, cosine_;
  double crest_m_;
};

}  // namespace afm::physics
