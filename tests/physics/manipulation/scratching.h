// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "physics/elasticity.h"
#include "physics/manipulation/scratching_tip.h"
#include "pushing.h"

namespace afm::physics::test {

// PMMA under a silicon tip, as in the table of cases.
inline SoftSurface pmma() {
  return {.hardness = Pressure(0.3e9),
          .reduced_modulus = reduced_modulus({Pressure(165e9), 0.22}, {Pressure(3e9), 0.38}),
          .work_of_adhesion = SurfaceEnergy(0.08),
          .pile_up_share = 0.7};
}

inline SphereCone marking_tip() { return flank_tip(Length(20e-9), 20.0); }

// A tip over 600 x 300 nm of PMMA, high above it.
inline ScratchingTip on_pmma(const PushSprings& springs = {Stiffness(10.0), Stiffness(1.0), Stiffness(100.0)}) {
  return {
      marking_tip(),           springs, pmma(), {Length(-300e-9), Length(-150e-9)}, {Length(300e-9), Length(150e-9)},
      base_at(0.0, 0.0, 50e-9)};
}

// Moves the base on a straight line, by at most `step_m` per tick; calls look(tick) after each.
template <class Look>
void scratch(ScratchingTip& tip, const LeverBase& to, double step_m, const Look& look) {
  const LeverBase from = tip.last().base;
  const Sideways<Length> way = to.position - from.position;
  const Length up = to.z - from.z;
  const int ticks = std::max(1, static_cast<int>(std::ceil(std::hypot(magnitude(way).si, up.si) / step_m)));
  for (int i = 1; i <= ticks; ++i) {
    const double share = static_cast<double>(i) / ticks;
    look(tip.move_to(i == ticks ? to : LeverBase{from.position + way * share, from.z + up * share}));
  }
}
inline void scratch(ScratchingTip& tip, const LeverBase& to, double step_m) {
  scratch(tip, to, step_m, [](const ScratchTick&) {});
}

}  // namespace afm::physics::test
