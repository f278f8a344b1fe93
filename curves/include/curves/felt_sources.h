// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "curves/contact_setup.h"
#include "scene/shared/shared_blocks.h"

namespace afm::curves {

// The contact that a hand feels: the numbers of `felt`, in SI, each with its source in `loaded`. A number that differs
// from the loaded one has `otherwise` as its source; so has every number if `loaded` has no source at all.
ContactSetup felt_setup(const ContactSetup& loaded, const scene::SharedContact& felt, const std::string& otherwise);

// Text for a session: sources_json() of the contact that is felt, and of its friction. A number that a person has
// changed has that as its source.
std::string felt_sources(const ContactSetup& loaded, const scene::SharedContact& felt);

// Last keys of a report on a session: "parameters" as parameters_json(), "sources" and "estimated" as add_sources().
// `recorded` is the felt_sources() of its file. Empty, as in a file of 0.2.0: the sources of the built-in material of
// this name, for the numbers that it shares; all others are named as recorded.
nlohmann::ordered_json session_numbers(const std::string& material, const scene::SharedContact& felt,
                                       const std::string& recorded, const std::string& assets_dir);

// Lines "# source of KEY: VALUE, SOURCE" of a table for felt_sources(); none for an empty text.
std::string source_lines(const std::string& recorded);

}  // namespace afm::curves
