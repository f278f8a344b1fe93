// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/shared/shared_blocks.h"

namespace afm::scene {

// Topography measured by an instrument: heights on a square grid as in SharedHeightField, but with up to
// kMaxTopographySide points per side; 0 at the origin. Metres as measured; SharedContact::topography has the scale at
// which a material shows them. No columns: no topography.
struct Topography {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double spacing_m = 0;
  std::vector<float> height_m;

  SharedTopography size() const { return {columns, rows, spacing_m}; }
};

// Meaning of a surface's heights.
enum class Heights {
  Drawn,   // heights of the sample, not yet traced by a tip
  Traced,  // heights of an apex that traced the sample: a microscope's image
  Scaled   // another quantity of each place, as a length
};

// Surface under the tip, as felt: a view of a grid of heights owned elsewhere.
struct FeltHeights {
  std::uint32_t columns = 0;  // 0: no grid, the plane z = 0
  std::uint32_t rows = 0;
  double spacing_m = 0;
  double height_factor = 1;  // factor applied to height_m
  std::span<const float> height_m;
  Heights heights = Heights::Drawn;

  FeltHeights() = default;
  FeltHeights(const SharedHeightField& field)  // NOLINT(google-explicit-constructor): the same thing
      : columns(field.columns),
        rows(field.rows),
        spacing_m(field.spacing_m),
        height_m(std::span(field.height_m).first(std::size_t{field.columns} * field.rows)) {}
  FeltHeights(const SharedHeightField* field)  // NOLINT(google-explicit-constructor): null is a plane
      : FeltHeights(field != nullptr ? FeltHeights(*field) : FeltHeights()) {}
  FeltHeights(const Topography& topography, const TopographyScale& scale)
      : columns(topography.columns),
        rows(topography.rows),
        spacing_m(scale.lateral * topography.spacing_m),
        height_factor(scale.vertical),
        height_m(topography.height_m),
        heights(Heights::Traced) {}

  // The same surface at another size, in the same proportions.
  FeltHeights scaled(double scale) const {
    FeltHeights larger = *this;
    larger.spacing_m *= scale;
    larger.height_factor *= scale;
    return larger;
  }
};

// Size of a contact's surface relative to its original size, if its tip is released at this Z. The picture fits the
// stroke, so a surface that grows with the stroke keeps its size in the picture and in the hand.
double surface_scale(const SharedContact& material, double release_z_m);

// Surface of a material that is valid together with these; a plane if it has none.
FeltHeights surface_of(const SharedContact& material, std::span<const SharedHeightField> fields,
                       const Topography& topography);

// True if a topography has this size, and a finite height for each point.
bool is_valid(const Topography& topography, const SharedTopography& size);

}  // namespace afm::scene
