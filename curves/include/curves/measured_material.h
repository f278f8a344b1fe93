// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "curves/recorded_curve.h"
#include "physics/curve_analysis.h"
#include "scene/samples/material_library.h"
#include "scene/shared/shared_blocks.h"

namespace afm::curves {

inline constexpr const char* kMeasuredName = "measured";

// The file's name without folder and ending, for the wall, where an underscore would begin a subscript.
std::string title_of(const std::string& path);

// An instrument's curve as a material for the exhibit.
struct MeasuredMaterial {
  scene::MaterialEntry entry;  // entry named kMeasuredName, with the file's name as title
  scene::SharedMeasuredCurve curve;
  physics::CurveFeatures features;  // features as printed by `touchafm analyse`
};

// Reads any format of curves/curve_file.h. Lever, tip and look are those of `like`, except for a spring constant given
// in the file. Fails as load_curve() does, and with BadInputFile for a curve without contact.
core::Result<MeasuredMaterial> load_measured_material(const std::string& path, const scene::MaterialEntry& like);

// Converts a curve that was read from the file `path`, and logs its remarks.
core::Result<MeasuredMaterial> measured_material(const RecordedCurve& recorded, const std::string& path,
                                                 const scene::MaterialEntry& like);

}  // namespace afm::curves
