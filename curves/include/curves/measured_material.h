// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "physics/curve_analysis.h"
#include "scene/samples/material_library.h"
#include "scene/shared/shared_blocks.h"

namespace afm::curves {

// A curve that an instrument recorded, as something that can be laid under the tip.
struct MeasuredMaterial {
  scene::MaterialEntry entry;  // named "measured"; titled as its file
  scene::SharedMeasuredCurve curve;
  physics::CurveFeatures features;  // as printed by `touchafm analyse`
};

// Reads any format of curves/curve_file.h. Lever and tip are those of `like` but for the spring constant, which the
// file gives if it knows it; so is the look. Fails as load_curve() does, and with BadInputFile for a curve without
// contact.
core::Result<MeasuredMaterial> load_measured_material(const std::string& path, const scene::MaterialEntry& like);

}  // namespace afm::curves
