// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/contact_parameters.h"
#include "physics/friction/friction_tip.h"

namespace afm::physics {

// One tip and its friction on one sample, by any of the laws, as the load comes and goes. Held only while it touches.
// Its constructor allocates; the rest is for one thread and does not allocate, lock or throw.
class LateralContact {
 public:
  // `adhesion` is the magnitude of the pull-off force: what is to be added to the force on the tip for a load. Throws
  // std::invalid_argument for parameters out of range, FrictionLaw::None among them, and for FrictionLaw::ContactArea
  // with a law of force that has no area.
  LateralContact(const FrictionParameters& friction, Law law, const ContactParameters& contact, Force adhesion);

  using Step = LatticeTip::Step;  // only a lattice has slips

  Step touch_down(const Sideways<Length>& support, Force load) noexcept;
  Step slide_to(const Sideways<Length>& support, Force load) noexcept;  // only while touching
  void lift() noexcept { touching_ = false; }
  bool touching() const noexcept { return touching_; }

  // All zero while not touching.
  Sideways<Force> force() const noexcept;  // on the support
  Energy stored() const noexcept;          // in spring and landscape
  Length lift_per_load() const noexcept;   // d stored/dN at a support that is held: what a rising load has to pay

  Stiffness stiffness() const noexcept { return stiffness_; }  // no spring in it is stiffer

  // The least force that slides the tip, at a load at or above zero; of a lattice the largest along x.
  Force yield(Force load) const noexcept;

 private:
  Stiffness stiffness_;
  FrictionTip tip_;  // never without a value, so that visiting it cannot throw
  bool touching_ = false;
};

}  // namespace afm::physics
