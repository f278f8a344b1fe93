// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "fits/indenter.h"

namespace afm::fits {

// Exact force of a lever whose base is driven onto a sample and back, by the laws of the fits (docs/fits.md, F1 to
// F12): what a curve would be without noise. The way of the base is positive below the height at which the undeformed
// tip meets the undeformed sample. A law of adhesion jumps to contact there, and off at the fold of this lever. One
// thread.
class DrivenContact {
 public:
  // `indenter` is valid for its shape, which is not Auto. Reduced modulus in Pa, positive; work of adhesion in J/m^2,
  // positive for a law of adhesion, otherwise not used; stiffness of the lever in N/m, positive.
  DrivenContact(const Indenter& indenter, double reduced_modulus_pa, double work_j_per_m2, double spring_n_per_m);
  ~DrivenContact();
  DrivenContact(DrivenContact&&) noexcept;
  DrivenContact& operator=(DrivenContact&&) = delete;

  struct State {
    double depth_m = 0, force_n = 0;  // depth of the tip; force of the lever, negative for a pull
  };
  // State of the lever at a way of the base. Fastest if the way is near that of the previous call.
  State approaching(double way_m) { return way_m > 0.0 ? touching(way_m) : State{}; }
  State retracting(double way_m) { return way_m > way_off_m() ? touching(way_m) : State{}; }

  // Way of the base at which the tip lets go: zero without adhesion, otherwise negative.
  double way_off_m() const { return way_off_m_; }

  // Hardest pull of a soft lever, a magnitude: zero without adhesion. Tabor's parameter of the contact; also zero then.
  double pull_off_n() const;
  double tabor() const { return tabor_; }

  // Way at which the force of the lever is `force_n`, positive.
  double way_of(double force_n);

 private:
  struct Law;
  State touching(double way_m);

  std::unique_ptr<Law> law_;
  double way_off_m_ = 0, tabor_ = 0;
};

}  // namespace afm::fits
