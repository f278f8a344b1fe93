// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "physics/units.h"

namespace afm::physics {

// One point of a branch of a force law before lever and support bend: the apex at the height h above the undeformed
// surface feels the force F (signed as in physics/contact.h). The derivatives are with respect to the branch's
// parameter, SI.
struct LawPoint {
  Length h;
  Force force;
  double dh_ds = 0.0;
  double dforce_ds = 0.0;
};

// A branch as a curve in a parameter s, so that it may turn back on itself where h alone would be ambiguous, as JKR's
// neck does. Along a branch h and F are continuous; their derivatives may jump at `kinks` only. Building uses it, the
// servo never does.
struct LawBranch {
  double first = 0.0;  // where h is largest for a free branch, deepest for an attached one
  double last = 0.0;   // where the branch ends: contact for a free branch, the end of the neck for an attached one
  std::function<LawPoint(double s)> at;
  std::vector<double> kinks;  // strictly between first and last, ascending
};

// A law of force between tip and sample: the branch of a tip that does not touch, h falling from far away to where
// contact begins, and the branch of one that does, from deep inside to where no contact can be held. They meet where
// the law is single-valued (DMT, Lennard-Jones, Hertz) and need not otherwise (JKR, Maugis-Dugdale).
struct ForceLaw {
  LawBranch free;
  LawBranch attached;
  Length contact_gap;  // D while attached: 0, or a0 where the law keeps an atomic distance
};

}  // namespace afm::physics
