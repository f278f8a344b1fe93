// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/paper_tables.h"
#include "scene/material_library.h"

namespace afm::app {

// The tables for people: printed, exact and, where a demo was given, measured beside each other; the figures; the
// errata.
std::string paper_markdown(const PaperTables& tables);

// The same for machines: SI, magnitudes.
std::string paper_json(const PaperTables& tables);

// A line per number, in the table's unit.
std::string table1_csv(const PaperTables& tables);
std::string table2_csv(const PaperTables& tables);

// The cycle of one material with the paper's letters A to F.
std::string figure2_svg(const scene::MaterialEntry& material);

// The cycles of the library's materials in one plot.
std::string figure5e_svg(const scene::MaterialLibrary& library);

}  // namespace afm::app
