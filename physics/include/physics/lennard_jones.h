// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/contact_parameters.h"
#include "physics/units.h"

namespace afm::physics {

// A rigid sphere over a rigid half-space whose surfaces attract by the 3-9 law of Lennard-Jones atoms (Bradley 1932;
// Derjaguin's approximation of the sphere), for a gap D > 0:
//
//   F = -(8 pi W R/3) [(z0/D)^2 - (z0/D)^8/4],   U = -(8 pi W R z0/3) [z0/D - (z0/D)^7/28]
//
// The minimum -2 pi W R is at z0, where the surfaces' traction vanishes; the steepest attraction is at 3^(1/6) z0. At
// large distances it is the van der Waals force with A = 16 pi W z0^2. Any thread; does not allocate.
class LennardJones {
 public:
  LennardJones(SurfaceEnergy work_of_adhesion, Length tip_radius, Length atomic_distance) noexcept
      : force_scale_(work_of_adhesion * tip_radius), z0_(atomic_distance) {}

  Energy potential(Length gap) const noexcept;  // potential U, zero far away
  Force force(Length gap) const noexcept;
  Stiffness gradient(Length gap) const noexcept;  // derivative of the force, dF/dD

  Length atomic_distance() const noexcept { return z0_; }

 private:
  Force force_scale_;  // W R, scale of the force
  Length z0_;
};

}  // namespace afm::physics
