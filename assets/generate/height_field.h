// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "surface.h"

namespace afm::generate {

// Heights (metres) on a square grid centred on the origin, row by row, x fastest.
class HeightField {
 public:
  HeightField(std::size_t quads, double spacing, const std::function<double(double x, double y)>& height);

  std::size_t vertices_a_side() const { return quads_ + 1; }
  double spacing() const { return spacing_; }
  double side() const { return spacing_ * static_cast<double>(quads_); }
  double coordinate(std::size_t index) const;
  double at(std::size_t column, std::size_t row) const { return heights_[row * vertices_a_side() + column]; }
  double roughness() const;  // root mean square about the mean

  void scale(double factor);
  // Blends into a plateau of `level` around the origin, whole within a third of `radius`.
  void flatten_center(double radius, double level);
  // Shifts all heights so that the middle is at height 0.
  void level_at_center();

  V3 position(std::size_t column, std::size_t row) const;
  V3 normal(std::size_t column, std::size_t row) const;

 private:
  std::size_t quads_;
  double spacing_;
  std::vector<double> heights_;
};

// The upper side: exactly the grid's vertices in the grid's order.
Surface top_of(const HeightField& field, const std::function<V3(const V3& position)>& color);

// A stripe on the four cut faces, from `top` (or the surface, if that is lower) down to `bottom`; given from the top
// down.
struct WallBand {
  double top = 0;
  double bottom = 0;
  V3 color{1, 1, 1};
};
Surface walls_of(const HeightField& field, const std::vector<WallBand>& bands);

// Inward strips along the upper edges of the cut faces and down their corners to `bottom`, `width` off the faces: seen
// from above they are a rim around the slab.
Surface outline_of(const HeightField& field, double bottom, double width);

}  // namespace afm::generate
