// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "scene/samples/material_library.h"

namespace afm::curves {

// A number in the paper that its own equations do not reproduce, or a note that readers of its numbers need.
struct Erratum {
  std::string_view name;  // name of one or two words, used by tables
  std::string_view text;
};

std::span<const Erratum> errata();

// Number in the list of errata, from 1; 0 for an empty name.
int erratum_number(std::string_view name);

// One number of a table, in the table's unit; magnitudes.
struct TableCell {
  std::string material;              // name in the material file
  std::string quantity;              // symbol of the quantity, "D_attr"
  std::string unit;                  // unit as the table prints it, "nm"
  double per_si = 1.0;               // units of the table per SI unit
  std::string printed;               // text as printed in the paper
  double exact = 0.0;                // value computed by the paper's equations
  std::optional<double> measured;    // value measured in the run; empty for D_attr and delta_c
  std::optional<double> experiment;  // measured value of Table 2; empty in Table 1
  std::string printed_simulation;    // printed simulation of Table 2; empty in Table 1
  std::string_view erratum;          // name of the erratum; empty if printed and exact values agree
};

// A row of Table 1 with inputs, in the notation of the material file.
struct InputRow {
  std::string name;
  std::vector<std::string> values;  // one value per material
};

struct PaperTables {
  std::vector<std::string> materials;  // titles of the materials, in the order of the columns
  std::vector<InputRow> inputs;
  std::vector<TableCell> table1;  // cells ordered by quantity, then by material
  std::vector<TableCell> table2;  // cells ordered by material, then by quantity
};

// Results of a demo: magnitudes in SI by quantity ("F_attr") for each material.
using MeasuredEvents = std::map<std::string, std::map<std::string, double>>;

// Reads a demo's summary.json. The error names the file and the fault.
core::Result<MeasuredEvents> load_measured_events(const std::string& path);

// Events as in a demo from the model only, sampled every 0.1 nm like a moving hand.
MeasuredEvents measured_events(const scene::MaterialLibrary& library);

// The paper's Tables 1 and 2 next to our evaluation of its equations for the library's numbers. Fails if the library
// lacks one of the paper's materials.
core::Result<PaperTables> paper_tables(const scene::MaterialLibrary& library, const MeasuredEvents& measured);

}  // namespace afm::curves
