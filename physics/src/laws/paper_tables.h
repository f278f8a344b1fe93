// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/law_tables.h"

namespace afm::physics {

// The law of Liu & Peng, whose two branches are straight lines: zero before Hao's fold (3.6), then -k' Z until the
// lever pulls with F_ad. `interaction` must be valid. Throws std::invalid_argument if Z_joc <= Z_jtc: the adhesion is
// then too weak to hold the tip after its jump to contact, and the law has no loop.
//
// It defines no potential of the contact. The well is assumed to be as deep as the lever's energy just after the jump
// to contact, so that this jump loses nothing and the jump off contact loses the whole loop's energy.
LawTables paper_tables(const ContactParameters& contact);

}  // namespace afm::physics
