// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "physics/manipulation/particle_friction.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_contact.h"

namespace afm::physics {

struct Flat {
  double x = 0.0, y = 0.0;  // metres in the plane of the sample
};

inline double distance_between(const Flat& a, const Flat& b) noexcept {
  const double x = a.x - b.x, y = a.y - b.y;
  return std::sqrt(x * x + y * y);
}

// The tip against one sphere, at rest under a lateral force: base, apex and centre lie in one vertical plane.
struct Leaning {
  bool holds = false;     // false: the tip rides over the sphere at a smaller force
  double base_m = 0.0;    // distance from the base to the centre of the sphere
  double apex_m = 0.0;    // height of the apex
  double normal_n = 0.0;  // N, normal force
  double energy_j = 0.0;  // energy of lever and contact
};

// Lateral thresholds of one species under a tip of one normal.
struct LoneThresholds {
  double rest_n = 0.0;    // f_s, as force on the lever
  double moving_n = 0.0;  // f_k, as force on the lever
  PushMode mode = PushMode::Slides;
};

// Tip and springs against one species. The constructor solves the balances of the flank, so that a tick does not.
class LoneContact {
 public:
  LoneContact(const ParticleSpecies& species, const SphereCone& tip, const PushSprings& springs, double tip_friction);

  const TipProfile& profile() const noexcept { return profile_; }
  double pull_off_n() const noexcept { return pull_off_force(species_).si; }  // F_ad of sphere and sample

  // State of the tip on a base at z_m under a lateral force.
  Leaning under(double lateral_n, double z_m) const noexcept;

  // The lateral force at a distance of base and centre: 0 beyond touch. Negative if the tip rides over before.
  double force_at(double base_m, double z_m) const noexcept;

  // Thresholds for a base at z_m. The last one of the cap is kept, because it takes tens of microseconds.
  LoneThresholds thresholds(double z_m) noexcept;

  // f_s and f_k of a sphere that bears N of the tip at the angle, or nothing: the friction of the sample.
  LoneThresholds under_load(double normal_n, double sine, double cosine) const noexcept;

 private:
  LoneThresholds balanced(double sine, double cosine) const noexcept;
  bool lean_on_cap(double lateral_n, double z_m, double from_m, double& apex_m, double& sine, double& cosine,
                   double& depth_m) const noexcept;

  ParticleSpecies species_;
  PushSprings springs_;
  TipGrip flank_grip_, cap_grip_;
  TipProfile profile_;
  LoneThresholds flank_;
  LoneThresholds cap_;
  double cap_z_m_;  // height for which cap_ is valid; NaN: none
};

// One sphere without neighbours on a path of the base: exact for any length.
struct LonePath {
  bool possible = false;     // false: the tip rides over or runs round the sphere, or it slips too often
  Flat particle;             // place of the sphere at the end
  double given_j = 0.0;      // energy from the hand
  double lost_j = 0.0;       // loss by friction and slips
  std::uint64_t yields = 0;  // number of slips
  bool moved = false;
  bool exhausted = false;  // true: more slips than a tick may have
};

// Pushes a lone sphere by a base that goes from `from` to `to` at the height z_m. `threshold_n` is the force that holds
// the sphere at the start. With alpha from the path to it, r the distance of base and sphere at f_k:
//
//   tan(alpha/2) = tan(alpha_0/2) exp(travel/r)                              (M13)
//
// until alpha = 90 degrees, where the base passes the sphere.
LonePath push_alone(const LoneContact& contact, const LoneThresholds& thresholds, double threshold_n, bool ages_at_once,
                    const Flat& particle, const Flat& from, const Flat& to, double z_m) noexcept;

}  // namespace afm::physics
