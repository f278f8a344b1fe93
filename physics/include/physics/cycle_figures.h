// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

namespace afm::physics {

// Results of one approach-retract cycle of a law, solved exactly when its tables are built. Forces are those of the
// lever, signed as in physics/contact.h; heights are of the apex above the undeformed surface.
struct CycleFigures {
  bool hysteretic = false;  // false: the lever is too stiff for jumps, and both branches are one curve

  Length z_jtc;  // Z at the jump to contact; without hysteresis, where contact begins
  Force force_before_jtc;
  Force force_after_jtc;
  Length tip_height_before_jtc;
  Length tip_height_after_jtc;

  Length z_joc;            // Z at the jump off contact
  Force force_before_joc;  // pull-off force, -F_ad
  Force force_after_joc;
  Length tip_height_before_joc;
  Length tip_height_after_joc;

  Energy lost_at_jtc;  // energy lost at the jump to contact: drop of the potential of lever and law
  Energy lost_at_joc;
  Energy loop_energy;  // energy dissipated in a cycle: the area of the loop

  Stiffness critical_stiffness;  // k_c at and above which the hysteresis vanishes; infinite if it never does
};

}  // namespace afm::physics
