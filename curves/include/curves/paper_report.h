// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "curves/paper_tables.h"
#include "scene/samples/material_library.h"

namespace afm::curves {

// The tables for readers: printed, exact and measured values side by side, results of contact mechanics for the same
// samples, the figures, the section on the survey (Table 3) as given, and the errata. `run` describes the run that
// measured: "of the demo".
std::string paper_markdown(const PaperTables& tables, const scene::MaterialLibrary& library, std::string_view run,
                           std::string_view survey);

// The tables as JSON: SI, magnitudes.
std::string paper_json(const PaperTables& tables, const scene::MaterialLibrary& library,
                       const nlohmann::ordered_json& survey);

// Tables with one line per number, in the table's unit.
std::string table1_csv(const PaperTables& tables);
std::string table2_csv(const PaperTables& tables);

// The cycle of one material with the paper's letters A to F.
std::string figure2_svg(const scene::MaterialEntry& material);

// The cycles of the library's materials in one plot.
std::string figure5e_svg(const scene::MaterialLibrary& library);

}  // namespace afm::curves
