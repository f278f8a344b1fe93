// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/law_tables.h"

namespace afm::physics {

// The law of Liu & Peng, whose two branches are straight lines: nothing before Hao's fold (3.6), then -k' Z until the
// lever pulls with F_ad. `interaction` has been validated. Throws std::invalid_argument if Z_joc <= Z_jtc: an adhesion
// too weak to hold what the van der Waals force has pulled in leaves this law no loop.
//
// It knows no potential of the contact. The well is taken to be as deep as the lever's energy just after the jump to
// contact, so that this jump loses nothing and the jump off contact loses the whole loop's energy.
LawTables paper_tables(const ContactParameters& contact);

}  // namespace afm::physics
