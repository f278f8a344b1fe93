// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "physics/contact_parameters.h"
#include "physics/force_law.h"
#include "physics/law.h"
#include "physics/law_tables.h"
#include "physics/tip_force.h"
#include "physics/units.h"

namespace afm::physics {

class SwingShape;

// One swing of the tip: height = centre - amplitude cos(angle), and its bend if it has one, with its lowest point at
// angle 0.
struct TapSwing {
  Length amplitude;     // A, amplitude zero-to-peak
  Length centre;        // mean height of the tip
  double angular_rate;  // angular rate for the viscosity, rad/s
  double ratio = 1.0;   // drive over resonance, for the harmonics; with a bend, the ratio of the bend holds
};

// Means of the sample's force F over one swing. The mean deflection and the higher harmonics, which answer like a
// spring, shift the lowest point of a lever that is driven at r of its resonance by <F G>/k with
//
//   G(t) = 1 + 2 sum over n > 1 of cos(n t)/(1 - n^2 r^2),   at the resonance (pi - t) sin(t) - cos(t)/2,
//
// 0 <= t <= 2 pi from the lowest point (tapping/harmonic_response.h); for a short contact at the resonance that is half
// of <F>/k towards the sample, not <F>/k away from it.
struct SwingAverages {
  Force mean;                  // <F>, mean force
  Force shift_at_lowest;       // k times the deflection at the lowest point less its first harmonic
  Energy virial;               // virial V = <F A cos(r t - phi)>: positive where the sample attracts on balance
  Energy lost;                 // energy lost in the sample per swing
  Force peak;                  // force at the lowest point
  Length lowest;               // lowest height of the tip
  double contact_share = 0.0;  // share of the swing in which the tip is in contact
};

// The sample under a tip that swings: a law of fixed grips, including its hysteresis, and optionally the viscosity of a
// Kelvin-Voigt contact, F = -eta sqrt(R delta) h' for an indentation delta (Garcia et al. 2006; Garcia &
// San Paulo 1999 for the rest of the contact).
//
// Constant after construction; any thread. Only the constructor allocates.
class TapSurface {
 public:
  // Throws std::invalid_argument (UnphysicalValue if one field is the cause) for a law without dynamics or of rigid
  // bodies, as build_law_tables() does, for a rigid contact, and unless the viscosity is within 0 to 1e6 Pa s.
  TapSurface(Law law, const ContactParameters& contact, const LawOptions& options = {},
             Viscosity viscosity = Viscosity());

  // Averages from the law's tables, accurate to 1e-8 of the force. Updates a given `shape` with the forces.
  SwingAverages averages(const TapSwing& swing, SwingShape* shape = nullptr) const noexcept;

  // Averages from the law itself: to 1e-11, but some twenty times as long.
  SwingAverages exact_averages(const TapSwing& swing) const;

  // dF/dh at a height, for a tip that comes from above.
  Stiffness exact_gradient(Length height) const;

  // Force for direct integration with a lever of this spring constant and swings of this amplitude.
  std::shared_ptr<const TipForce> tip_force(Length amplitude) const;

  // eta sqrt(R delta) at a height, in N s/m; zero without contact.
  double friction_si(Length height) const noexcept;

  bool viscous() const noexcept { return viscous_si_ > 0.0; }
  const ContactParameters& contact() const noexcept { return contact_; }
  Length contact_height() const noexcept { return grips_->figures.z_jtc; }     // contact of a free tip
  Length release_height() const noexcept { return grips_->figures.z_joc; }     // release of an attached tip
  Length zero_of_indentation() const noexcept { return grips_->contact_gap; }  // height at which delta is zero

 private:
  ContactParameters contact_;  // parameters, including the lever's spring constant
  std::shared_ptr<const LawTables> grips_;
  ForceLaw law_;
  double viscous_si_ = 0.0;  // eta sqrt(R), viscosity times the root of the tip radius
};

}  // namespace afm::physics
