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

// A topography that an instrument measured, as a sample: what is felt, and the same as a mesh.
struct TopographyModel {
  scene::Topography topography;
  scene::Scene sample;  // a node "surface" with a mesh in metres as measured: slab and false colours
  double lowest_m = 0;  // of the colours' scale, in the topography's heights
  double highest_m = 0;
  double exaggeration = 1;  // of the heights against the sides, wherever it is shown
  std::string summary;      // for the log: file, channel, size, levelling
};

// BadInputFile as curves::load_topography() and felt_topography().
core::Result<TopographyModel> load_topography_model(const std::string& file, const curves::TopographyReading& reading);

// The mesh of the heights, vertex by vertex as they are felt, coloured by exhibit/height_colours.h from `lowest_m` to
// `highest_m`, with the walls of a slab below it that ends at `bottom_m`. The first primitive is the grid, row by row
// from -y.
scene::Scene topography_scene(const scene::Topography& topography, double lowest_m, double highest_m, double bottom_m);

// How large the sample of a material with this stroke is drawn and felt: as wide as the assets' samples are beside it.
scene::TopographyScale topography_scale(const TopographyModel& model, double stroke_m);

// How far it is smoothed where it is felt on this material, whose parameters are felt with it: for the log. Takes some
// tenths of a second for the largest one.
std::string smoothing_note(const curves::SampleModel& material, const scene::Topography& topography);

// 1, 2 or 5 times a power of ten by which the heights are multiplied, beyond true proportions, so that the relief is
// neither too low to be felt nor higher than the stroke has room for.
double exaggeration_of(double relief_m, double side_m);

}  // namespace afm::exhibit
