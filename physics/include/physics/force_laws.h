// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "physics/contact_parameters.h"
#include "physics/force_law.h"
#include "physics/law.h"

// Force laws as curves, without lever and support (which physics/law_tables.h adds). Each throws UnphysicalValue for
// values outside the ranges of validate(), and for an infinite modulus if it needs a finite one. Options that do not
// apply to a law are ignored. All allocate; the branches do not refer to anything outside themselves.
namespace afm::physics {

// The law of that name, including the liquid bridge of the options (physics/meniscus.h), which the functions below
// omit. Throws std::invalid_argument for Paper, whose tables are closed forms, and for Measured, which is not computed.
ForceLaw force_law(Law law, const ContactParameters& contact, const LawOptions& options = {});

// Publications of a law's equations, as in docs/physics.md: "Bradley 1932". Empty for Measured, whose source is a file,
// and for an unknown law.
std::string_view source_of(Law law);

// Van der Waals attraction down to a wall at h = 0, which adheres with up to F_ad.
ForceLaw hao_law(const ContactParameters& contact, const LawOptions& options = {});

// Elastic contact from h = 0, no adhesion.
ForceLaw hertz_law(const ContactParameters& contact, const LawOptions& options = {});

// Van der Waals attraction down to a0 (physics/van_der_waals.h), where it is F_ad, and below F = 4/3 E* sqrt(R) (a0 -
// h)^(3/2) - F_ad (Garcia & San Paulo 1999). An infinite E* makes the contact a wall at a0.
ForceLaw dmt_law(const ContactParameters& contact, const LawOptions& options = {});

// No force down to h = 0, where the surfaces jump into contact; then JKR's contact to the end of its neck.
ForceLaw jkr_law(const ContactParameters& contact, const LawOptions& options = {});

// Maugis-Dugdale's contact, with the cohesive stress of surfaces that attract by the 3-9 law, joined to van der Waals
// attraction. The zero of contact is always a0: h = a0 - delta. Van der Waals force and the force of the contact, which
// continues as a cohesive zone without contact where the family does (maugis_fixed_grips_end), describe the same
// attraction. They are joined as follows:
//
// - If the zone, followed to its end under fixed grips, pulls harder there than the van der Waals force, the law has a
//   loop even for fixed grips: the tip is free until the van der Waals force equals the contact's, and attached until
//   the end.
// - If the van der Waals force becomes the stronger one on the way out through the zone, it takes over there, and the
//   law is single-valued.
// - If it is already stronger at the end of the contact (attraction of a long range and little adhesion), the pull
//   keeps its value at the contact's end, as Dugdale's stress does, until the van der Waals force is no stronger. The
//   law is single-valued.
//
// Thus forces are continuous where contact forms, no jump weakens the attraction on the way in, and every value changes
// continuously with the parameters. For lambda -> 0 the contact is DMT's, with its jump from afar and its pull-off, but
// just outside of a0 the attraction rises with Maugis' constant stress rather than van der Waals'; for lambda ->
// infinity it is JKR's at a0.
ForceLaw maugis_law(const ContactParameters& contact, const LawOptions& options = {});

// Bradley's rigid sphere with W and z0 (physics/lennard_jones.h).
ForceLaw lennard_jones_law(const ContactParameters& contact, const LawOptions& options = {});

}  // namespace afm::physics
