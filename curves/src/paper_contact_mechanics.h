// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scene/samples/material_library.h"

namespace afm::curves {

// The paper's law beside the one that the Tabor parameter chooses for the same numbers, its a0 chosen so that F_ad is
// the same: where the jumps are, the forces before and after them, what the loop costs. A Markdown table for people,
// and for machines an object by material, SI, forces signed.
std::string contact_mechanics_markdown(const scene::MaterialLibrary& library);
nlohmann::ordered_json contact_mechanics_json(const scene::MaterialLibrary& library);

}  // namespace afm::curves
