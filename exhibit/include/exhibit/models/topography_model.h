// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "core/result.h"
#include "curves/measured_topography.h"
#include "curves/sample_model.h"
#include "scene/graph/scene.h"
#include "scene/shared/felt_heights.h"

namespace afm::exhibit {

// An instrument's topography as a sample: the surface to feel, and the same as a mesh.
struct TopographyModel {
  scene::Topography topography;
  scene::Scene sample;  // node "surface" with a mesh in metres as measured: a slab in false colours
  double lowest_m = 0;  // lower end of the colour scale, in the topography's heights
  double highest_m = 0;
  double exaggeration = 1;  // vertical exaggeration, the same everywhere on the wall
  std::string summary;      // file, channel, size and levelling, as text for the log
};

// BadInputFile as from curves::load_topography() and felt_topography().
core::Result<TopographyModel> load_topography_model(const std::string& file, const curves::TopographyReading& reading);

// Same for known heights, without a summary.
TopographyModel topography_model(scene::Topography topography);

// Mesh of the heights, with the felt height at every vertex, coloured by exhibit/height_colours.h from `lowest_m` to
// `highest_m`, with the walls of a slab down to `bottom_m`. The first primitive is the grid, row by row from -y.
scene::Scene topography_scene(const scene::Topography& topography, double lowest_m, double highest_m, double bottom_m);

// Scale at which the sample is drawn and felt on a material with this stroke: as wide as the assets' samples.
scene::TopographyScale topography_scale(const TopographyModel& model, double stroke_m);

// Text for the log on how much the topography is smoothed to be felt on this material. Takes some tenths of a second
// for the largest topography.
std::string smoothing_note(const curves::SampleModel& material, const scene::Topography& topography);

// Exaggeration of the heights, 1, 2 or 5 times a power of ten, for a relief that is high enough to be felt but not
// higher than the stroke allows.
double exaggeration_of(double relief_m, double side_m);

}  // namespace afm::exhibit
