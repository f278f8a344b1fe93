// SPDX-License-Identifier: Apache-2.0
#include "height_field.h"

#include <algorithm>

namespace afm::generate {

HeightField::HeightField(std::size_t quads, double spacing, const std::function<double(double, double)>& height)
    : quads_(quads), spacing_(spacing) {
  for (std::size_t row = 0; row <= quads; ++row) {
    for (std::size_t column = 0; column <= quads; ++column) {
      heights_.push_back(height(coordinate(column), coordinate(row)));
    }
  }
}

double HeightField::coordinate(std::size_t index) const {
  return (static_cast<double>(index) - static_cast<double>(quads_) / 2) * spacing_;
}

double HeightField::roughness() const {
  const auto count = static_cast<double>(heights_.size());
  double mean = 0, squares = 0;
  for (const double height : heights_) mean += height / count;
  for (const double height : heights_) squares += (height - mean) * (height - mean) / count;
  return std::sqrt(squares);
}

void HeightField::scale(double factor) {
  for (double& height : heights_) height *= factor;
}

void HeightField::flatten_center(double radius, double level) {
  for (std::size_t row = 0; row <= quads_; ++row) {
    for (std::size_t column = 0; column <= quads_; ++column) {
      const double x = coordinate(column), y = coordinate(row);
      double& height = heights_[row * vertices_a_side() + column];
      height = mix(level, height, smooth_step(radius / 3, radius, std::sqrt(x * x + y * y)));
    }
  }
}

void HeightField::level_at_center() {
  const double center = at(quads_ / 2, quads_ / 2);
  for (double& height : heights_) height -= center;
}

V3 HeightField::position(std::size_t column, std::size_t row) const {
  return {coordinate(column), coordinate(row), at(column, row)};
}

V3 HeightField::normal(std::size_t column, std::size_t row) const {
  // central differences; one-sided at the rim
  const std::size_t left = column > 0 ? column - 1 : 0, right = std::min(column + 1, quads_);
  const std::size_t below = row > 0 ? row - 1 : 0, above = std::min(row + 1, quads_);
  const double slope_x = (at(right, row) - at(left, row)) / (spacing_ * static_cast<double>(right - left));
  const double slope_y = (at(column, above) - at(column, below)) / (spacing_ * static_cast<double>(above - below));
  return unit(V3{-slope_x, -slope_y, 1});
}

Surface top_of(const HeightField& field, const std::function<V3(const V3&)>& color) {
  Surface surface;
  const std::size_t side = field.vertices_a_side();
  surface.add_grid(side, side, [&](std::size_t row, std::size_t column) {
    const V3 position = field.position(column, row);
    return SurfaceVertex{position, field.normal(column, row), color(position)};
  });
  return surface;
}

Surface walls_of(const HeightField& field, const std::vector<WallBand>& bands) {
  Surface surface;
  const std::size_t side = field.vertices_a_side(), last = side - 1;
  const V3 outward[] = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  for (int face = 0; face < 4; ++face) {
    // the rim counter-clockwise as seen from above
    const auto rim = [&](std::size_t i) {
      switch (face) {
        case 0:
          return field.position(i, 0);
        case 1:
          return field.position(last, i);
        case 2:
          return field.position(last - i, last);
        default:
          return field.position(0, last - i);
      }
    };
    for (const WallBand& band : bands) {
      surface.add_grid(2, side, [&](std::size_t row, std::size_t column) {
        V3 position = rim(column);
        position.z = std::min(position.z, row == 0 ? band.bottom : band.top);
        return SurfaceVertex{position, outward[face], band.color};
      });
    }
  }
  return surface;
}

}  // namespace afm::generate
