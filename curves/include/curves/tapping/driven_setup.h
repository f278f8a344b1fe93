// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.h"
#include "curves/contact_options.h"
#include "curves/contact_setup.h"
#include "curves/tapping/tapped_hand.h"

namespace afm::curves {

struct PathOptions;

// The contact under a lever that swings, with the work of adhesion for `choice.contact_gap` if that is given. Mode is
// tapping or fm. WrongUsage, naming the option, as contact_setup(), and for a model that cannot be tapped on.
core::Result<ContactSetup> driven_setup(const TappingChoice& choice, const ContactOptions& contact);

// WrongUsage, naming the option, if one has no effect without tapping.
core::Result<void> check_contact_mode(const TappedHand& hand);

// The sample under that lever. Mode is tapping. WrongUsage, naming the option, for a number that is none or cannot be
// felt, and for a model that cannot be tapped on.
core::Result<ContactSetup> tapped_setup(const scene::MaterialEntry& entry, const TappedHand& hand);

// WrongUsage, naming the option, for a path that has no effect.
core::Result<void> check_path(const TappingChoice& choice, const PathOptions& path);

}  // namespace afm::curves
