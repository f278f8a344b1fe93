// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/force_law.h"
#include "physics/interaction.h"
#include "physics/law.h"

// The laws of force as curves, before lever and support bend (physics/law_tables.h bends them). Each throws
// UnphysicalValue for values outside the ranges of validate(), and where it needs a modulus that is infinite. Options
// for which a law has no place are ignored. They allocate, and their branches refer to nothing outside themselves.
namespace afm::physics {

// Any law but Paper, whose tables are closed forms, and Measured, which is not computed: for these
// std::invalid_argument.
ForceLaw force_law(Law law, const Interaction& interaction, const LawOptions& options = {});

// Van der Waals attraction down to a wall at h = 0, which holds with up to F_ad.
ForceLaw hao_law(const Interaction& interaction, const LawOptions& options = {});

// Elastic contact from h = 0, no adhesion.
ForceLaw hertz_law(const Interaction& interaction, const LawOptions& options = {});

// Van der Waals attraction down to a0 (physics/van_der_waals.h), where it is F_ad, and from there
// F = 4/3 E* sqrt(R) (a0 - h)^(3/2) - F_ad (Garcia & San Paulo 1999). An infinite E* makes the contact a wall at a0.
ForceLaw dmt_law(const Interaction& interaction, const LawOptions& options = {});

// No force down to h = 0, where the surfaces jump into contact; JKR's contact down to the end of its neck.
ForceLaw jkr_law(const Interaction& interaction, const LawOptions& options = {});

// Bradley's rigid sphere with W and z0 (physics/lennard_jones.h).
ForceLaw lennard_jones_law(const Interaction& interaction, const LawOptions& options = {});

}  // namespace afm::physics
