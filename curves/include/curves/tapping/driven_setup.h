// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "curves/contact_options.h"
#include "curves/contact_setup.h"
#include "curves/tapping/tapping_options.h"

namespace afm::curves {

struct PathOptions;

// A vibrating lever as a user describes it; empty text: not given.
struct TappingChoice {
  std::string mode = "contact";  // or tapping, fm
  TappingOptions numbers;
  std::string contact_gap;  // instead of the work of adhesion
};

// The contact under a lever that swings, with the work of adhesion for `choice.contact_gap` if that is given. Mode is
// tapping or fm. WrongUsage, naming the option, as contact_setup(), and for a model that cannot be tapped on.
core::Result<ContactSetup> driven_setup(const TappingChoice& choice, const ContactOptions& contact);

// WrongUsage, naming the option, for a path that has no effect.
core::Result<void> check_path(const TappingChoice& choice, const PathOptions& path);

}  // namespace afm::curves
