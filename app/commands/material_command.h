// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/options/contact_options.h"
#include "core/result.h"

namespace afm::app {

// Every known material and probe with its chief numbers, a line each.
core::Result<std::string> material_list(const ContactOptions& options);

// One contact for people: each number with its source, the place on the adhesion map, the law and why, and what a cycle
// comes to.
core::Result<std::string> material_text(const curves::ContactSetup& setup);

// The adhesion map with the contact on it, as SVG.
core::Result<std::string> material_map(const curves::ContactSetup& setup);

}  // namespace afm::app
