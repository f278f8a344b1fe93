// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "physics/contact_parameters.h"
#include "physics/law.h"
#include "physics/law_tables.h"

namespace afm::physics {

// The law as the force on a tip at a height, without a lever: its tables for fixed grips, from which a moving tip gets
// its force. Throws std::invalid_argument (UnphysicalValue if one field is the cause) as build_law_tables() does, for a
// law that gives no force as a function of the height, and for a rigid contact.
std::shared_ptr<const LawTables> fixed_grips_tables(Law law, const ContactParameters& contact,
                                                    const LawOptions& options);

}  // namespace afm::physics
