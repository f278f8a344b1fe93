// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/graph/scene.h"

namespace afm::exhibit {

// A square of measured heights in false colours, which grows during the measurement.
struct HeightRelief {
  double side_m = 0;                    // length of a side in metres of the sample's frame, as are floor and lid
  double floor_m = 0, lid_m = 0;        // lower and upper end of the mesh's box
  double range_m = 0;                   // range of heights from the darkest to the brightest colour, metres as measured
  std::vector<scene::Vertex> vertices;  // vertices in the order of relief_mesh()
};

inline constexpr std::size_t kReliefSide = 128;  // number of vertices on a side

// A mesh of kReliefSide by kReliefSide vertices, row by row from +y, at the middles of square cells: x and y from -0.5
// to 0.5, z from 0 to 1. Node "relief", whose vertices a frame gives.
scene::Scene relief_mesh();

// Range of the colours, and scale of the sample's frame.
struct ReliefScale {
  double low_m = 0, high_m = 1;          // heights of the darkest and the brightest colour, as measured
  double lateral = 1.0, vertical = 1.0;  // metres of the sample's frame per metre as measured
};

// Vertices for heights in metres as measured, on a square of that side; NaN where nothing has been measured: the mesh
// is inside the sample there.
HeightRelief relief_of(std::span<const double> height_m, double side_m, const ReliefScale& scale);

}  // namespace afm::exhibit
