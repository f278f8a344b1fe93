// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/result.h"
#include "physics/force_curve.h"
#include "scene/material_library.h"

namespace afm::app {

// What `touchafm curve` was asked for, as it was written; an empty text is an option that was not given.
struct CurveOptions {
  std::string materials_file;
  std::string material;
  std::string model = "paper";
  std::string from, to = "-5nm", step = "0.01nm";
  std::string tip_radius, spring_constant, sample_stiffness, hamaker, work_of_adhesion;
  bool json = false;
  std::string out;  // a file, or empty for stdout
};

// One cycle with everything that it was made from.
struct CurveRun {
  std::string model;
  scene::MaterialEntry material;  // with the overrides in its interaction, and their sources
  physics::SweepPlan plan;
  physics::ForceCurve curve;
};

// Loads the material, applies the overrides and sweeps. Wrong texts and values are errors of wrong usage that name the
// option. Without --from the sweep starts a tenth above Z_joc, at a whole nanometre.
core::Result<CurveRun> run_curve(const CurveOptions& options);

// CSV in SI: a # header with every parameter and its source, a line of column names with units, one line a sample.
std::string curve_csv(const CurveRun& run);

// The events as the design's section 4 prints them; null for a jump that did not happen in the sweep, for the energy of
// a loop that stayed open, and for a sample stiffness without bound (JSON has no infinity).
nlohmann::ordered_json curve_json(const CurveRun& run);

}  // namespace afm::app
