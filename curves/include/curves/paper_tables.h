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

// Something that the paper prints and its own equations do not give, or that a reader of its numbers must know.
struct Erratum {
  std::string_view name;  // one or two words, used by tables
  std::string_view text;
};

std::span<const Erratum> errata();

// Number of the erratum in the list, counted from one; 0 for an empty name.
int erratum_number(std::string_view name);

// One number of a table, in the table's unit; magnitudes.
struct TableCell {
  std::string material;              // its name in the material file
  std::string quantity;              // "D_attr"
  std::string unit;                  // "nm", as the table prints it
  double per_si = 1.0;               // units in one SI unit
  std::string printed;               // as printed in the paper
  double exact = 0.0;                // computed by the paper's equations
  std::optional<double> measured;    // measured in the run, except for D_attr and delta_c
  std::optional<double> experiment;  // Table 2 only
  std::string printed_simulation;    // Table 2 only
  std::string_view erratum;          // empty where printed and exact agree
};

// A row of Table 1 that is given, not computed: as the material file writes it.
struct InputRow {
  std::string name;
  std::vector<std::string> values;  // one per material
};

struct PaperTables {
  std::vector<std::string> materials;  // titles, in the order of the columns
  std::vector<InputRow> inputs;
  std::vector<TableCell> table1;  // ordered by quantity, then by material
  std::vector<TableCell> table2;  // ordered by material, then by quantity
};

// What a demo measured: magnitudes in SI by quantity ("F_attr") for each material.
using MeasuredEvents = std::map<std::string, std::map<std::string, double>>;

// Reads a demo's summary.json. The error names the file and what is wrong in it.
core::Result<MeasuredEvents> load_measured_events(const std::string& path);

// The same of a run of the model alone, which looks every 0.1 nm as a moving hand does.
MeasuredEvents measured_events(const scene::MaterialLibrary& library);

// The paper's Tables 1 and 2 beside our evaluation of its equations for the library's numbers. Fails if the library
// lacks one of the paper's materials.
core::Result<PaperTables> paper_tables(const scene::MaterialLibrary& library, const MeasuredEvents& measured);

}  // namespace afm::curves
