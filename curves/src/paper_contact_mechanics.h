// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scene/samples/material_library.h"

namespace afm::curves {

// Comparison of the paper's law with the one that suits the Tabor parameter, for the same numbers and with a0 chosen
// for the same F_ad: places of the jumps, forces before and after, dissipated energy. A Markdown table, and in JSON an
// object by material, SI, forces signed.
std::string contact_mechanics_markdown(const scene::MaterialLibrary& library);
nlohmann::ordered_json contact_mechanics_json(const scene::MaterialLibrary& library);

}  // namespace afm::curves
