// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

// One point of a branch of a force law, without lever and support: the apex at height h above the undeformed surface
// has the force F (signed as in physics/contact.h). The derivatives are with respect to the branch's parameter, SI.
struct LawPoint {
  Length h;
  Force force;
  double dh_ds = 0.0;
  double dforce_ds = 0.0;
};

// A branch as a curve in a parameter s, so that it may turn back where h would be ambiguous, as in JKR's neck. Along a
// branch h and F are continuous; their derivatives may jump only at `kinks`. Used for building tables, never by the
// servo.
struct LawBranch {
  double first = 0.0;  // parameter at the start: the largest h of a free branch, the deepest point of an attached one
  double last = 0.0;   // parameter at the end: contact for a free branch, the end of the neck for an attached one
  std::function<LawPoint(double s)> at;
  std::vector<double> kinks;  // parameters at kinks, strictly between first and last, ascending
};

// A force law between tip and sample, as two branches: that of a free tip, with h falling from far away to the
// beginning of contact, and that of a tip in contact, from deep inside to the end of contact. A law that is
// single-valued in h (DMT, Lennard-Jones, Hertz, Maugis-Dugdale for stiff contacts) has an attached branch that
// continues through contact to far away, and a free one that extends to its largest attraction, so that each branch
// contains the fold that ends it, for any stiffness of the lever. For rigid bodies h may be constant while F falls.
struct ForceLaw {
  LawBranch free;
  LawBranch attached;
  Length contact_gap;  // gap D while attached: 0, or a0 if the law has an atomic distance

  // The law's potential at the attached branch's last point, zero for a tip infinitely far away. With F = -dU/dh along
  // each branch it determines both branches, and thus the energy that each jump dissipates. Empty: the law has no
  // potential (Hao's attached tip rests on a wall whose well is not defined), so only the area of its loop is known.
  std::optional<Energy> attached_end_potential;
};

}  // namespace afm::physics
