// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
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
  double first = 0.0;  // parameter at the largest h of a free branch, or the deepest point of an attached one
  double last = 0.0;   // end of the branch: contact for a free branch, the end of the neck for an attached one
  std::function<LawPoint(double s)> at;
  std::vector<double> kinks;  // strictly between first and last, ascending
};

// A law of force between tip and sample: the branch of a tip that does not touch, h falling from far away to where
// contact begins, and the branch of one that does, from deep inside to where no contact can be held. A law that is
// single-valued in h (DMT, Lennard-Jones, Hertz, Maugis-Dugdale for stiff contacts) has an attached branch that goes on
// through contact to far away, and a free one that reaches to its largest attraction, so that each branch holds the
// fold that ends it, however stiff the lever. Where the bodies are rigid h may stand still
// while F falls.
struct ForceLaw {
  LawBranch free;
  LawBranch attached;
  Length contact_gap;  // D while attached: 0, or a0 where the law keeps an atomic distance

  // The potential of the law at the attached branch's last point, zero for a tip infinitely far away: with F = -dU/dh
  // along each branch it fixes both, and so what each jump dissipates. None: the law has no potential (Hao's attached
  // tip rests on a wall whose well nobody has given), and only its loop has an area.
  std::optional<Energy> attached_end_potential;
};

}  // namespace afm::physics
