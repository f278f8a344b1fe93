// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/contact_parameters.h"
#include "physics/friction/friction_tip.h"

namespace afm::physics {

// A tip with friction by any of the laws on one sample, under a varying load. Active only while the tip touches. The
// constructor allocates; everything else is for one thread and does not allocate, lock or throw.
class LateralContact {
 public:
  // `adhesion` is the magnitude of the pull-off force; the force on the tip plus `adhesion` is the load. Throws
  // std::invalid_argument for parameters out of range, including FrictionLaw::None, and for FrictionLaw::ContactArea
  // with a force law without contact area.
  LateralContact(const FrictionParameters& friction, Law law, const ContactParameters& contact, Force adhesion);

  using Step = LatticeTip::Step;  // result of a step; slips occur only on a lattice

  Step touch_down(const Sideways<Length>& support, Force load) noexcept;
  Step slide_to(const Sideways<Length>& support, Force load) noexcept;  // moves a touching tip
  void lift() noexcept { touching_ = false; }
  bool touching() const noexcept { return touching_; }

  // All values are zero while not touching.
  Sideways<Force> force() const noexcept;  // force on the support
  Energy stored() const noexcept;          // energy stored in spring and lattice
  Length lift_per_load() const noexcept;   // d stored/dN at a fixed support: energy supplied by a rising load

  Stiffness stiffness() const noexcept { return stiffness_; }  // stiffness of the tip's stiffest spring

 private:
  Stiffness stiffness_;
  FrictionTip tip_;  // never valueless, so visiting it cannot throw
  bool touching_ = false;
};

}  // namespace afm::physics
