// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/shared/shared_blocks.h"

namespace afm::scene {

// A topography that an instrument measured: heights on a square grid, as SharedHeightField has them, but of up to
// kMaxTopographySide points a side; 0 at the origin. Metres as they were measured: SharedContact::topography says
// how large a material shows them. Without columns there is none.
struct Topography {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double spacing_m = 0;
  std::vector<float> height_m;

  SharedTopography size() const { return {columns, rows, spacing_m}; }
};

// What a surface's heights are of.
enum class Heights {
  Drawn,  // of the sample, which a tip has still to trace
  Traced  // of an apex that traced the sample: the image of a microscope
};

// A surface under the tip, as it is felt: a grid of heights that somebody else holds.
struct FeltHeights {
  std::uint32_t columns = 0;  // 0: the plane z = 0
  std::uint32_t rows = 0;
  double spacing_m = 0;
  double height_factor = 1;  // of the numbers below
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
};

// The surface of a material that is valid beside these; a plane where it has none.
FeltHeights surface_of(const SharedContact& material, std::span<const SharedHeightField> fields,
                       const Topography& topography);

// Whether a topography is of this size, with a height for each point, all of them finite.
bool is_valid(const Topography& topography, const SharedTopography& size);

}  // namespace afm::scene
