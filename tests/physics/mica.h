// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "physics/contact_parameters.h"
#include "physics/law_tables.h"

namespace afm::physics {

// The paper's mica with the contact of silicon nitride on mica (docs/physics.md), as in the reference cases:
// a0 = 0.3819 nm.
inline ContactParameters elastic_mica() {
  using namespace literals;
  ContactParameters mica;
  mica.tip_radius = 50_nm;
  mica.spring_constant = 0.1_N_per_m;
  mica.sample_stiffness = Stiffness(std::numeric_limits<double>::infinity());
  mica.hamaker = 24.5_zJ;
  mica.mean_surface_energy = 2.228_mJ_per_m2;
  mica.reduced_modulus = Pressure(51.5e9);
  return mica;
}

// Tables of the law under fixed grips.
inline std::shared_ptr<const LawTables> fixed_grips(Law law, ContactParameters contact) {
  contact.spring_constant = Stiffness(std::numeric_limits<double>::infinity());
  return build_law_tables(law, contact);
}

}  // namespace afm::physics
