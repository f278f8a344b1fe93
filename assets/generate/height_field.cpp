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
  const auto vertex = [&](std::size_t row, std::size_t column) {
    const V3 position = field.position(column, row);
    return SurfaceVertex{position, field.normal(column, row), color(position)};
  };
  surface.add_grid(side, side, vertex, Cut::Level);
  return surface;
}

namespace {

// The upper edge of one of the four cut faces, counter-clockwise as seen from above.
std::vector<V3> rim_of(const HeightField& field, int face) {
  const std::size_t side = field.vertices_a_side(), last = side - 1;
  std::vector<V3> rim;
  for (std::size_t i = 0; i < side; ++i) {
    const V3 corners[] = {field.position(i, 0), field.position(last, i), field.position(last - i, last),
                          field.position(0, last - i)};
    rim.push_back(corners[face]);
  }
  return rim;
}

constexpr V3 kOutward[] = {{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};

constexpr double kCornerWidths = 2.5;  // length of an outline's strips at the corners, the only visible part of them

// Leaves out points whose heights are within `tolerance` of the line between those that are kept.
std::vector<V3> simplified(const std::vector<V3>& rim, double tolerance) {
  std::vector<V3> kept{rim.front()};
  std::size_t from = 0;
  for (std::size_t to = 2; to < rim.size(); ++to) {
    for (std::size_t i = from + 1; i < to; ++i) {
      const double share = static_cast<double>(i - from) / static_cast<double>(to - from);
      if (std::abs(mix(rim[from].z, rim[to].z, share) - rim[i].z) <= tolerance) continue;
      from = to - 1;
      kept.push_back(rim[from]);
      break;
    }
  }
  kept.push_back(rim.back());
  return kept;
}

// A whole rectangle of one cut face, below which no fine edge is needed: a fan joins the many points above to two.
void add_level_band(Surface& surface, const std::vector<V3>& above, double bottom, V3 outward, V3 color) {
  const V3 left{above.front().x, above.front().y, bottom}, right{above.back().x, above.back().y, bottom};
  const std::uint32_t low_left = surface.add({left, outward, color}), low_right = surface.add({right, outward, color});
  std::uint32_t last = surface.add({above.front(), outward, color});
  for (std::size_t i = 1; i < above.size(); ++i) {
    const std::uint32_t next = surface.add({above[i], outward, color});
    surface.add_triangle(low_left, next, last);
    last = next;
  }
  surface.add_triangle(low_left, low_right, last);
}

// Darkens the foot of a cut face, where the ground below hides a part of the light.
void shade_towards_foot(Surface& surface) {
  double low = 0, high = 0;
  for (const SurfaceVertex& vertex : surface.vertices) {
    low = std::min(low, vertex.position.z);
    high = std::max(high, vertex.position.z);
  }
  for (SurfaceVertex& vertex : surface.vertices) {
    vertex.color = vertex.color * mix(0.48, 1, smooth_step(0, 0.85, (vertex.position.z - low) / (high - low)));
  }
}

}  // namespace

Surface walls_of(const HeightField& field, const std::vector<WallBand>& bands) {
  Surface surface;
  const std::size_t side = field.vertices_a_side();
  for (int face = 0; face < 4; ++face) {
    std::vector<V3> rim = rim_of(field, face);
    for (const WallBand& band : bands) {
      const auto cut = [&](double height) {
        std::vector<V3> line = rim;
        for (V3& point : line) point.z = std::min(point.z, height);
        return line;
      };
      const std::vector<V3> above = cut(band.top), below = cut(band.bottom);
      const bool level = std::all_of(rim.begin(), rim.end(), [&](const V3& point) { return point.z >= band.top; });
      if (level) {
        add_level_band(surface, above, band.bottom, kOutward[face], band.color);
        rim = {below.front(), below.back()};
      } else {
        surface.add_grid(2, side, [&](std::size_t row, std::size_t column) {
          return SurfaceVertex{row == 0 ? below[column] : above[column], kOutward[face], band.color};
        });
      }
    }
  }
  shade_towards_foot(surface);
  return surface;
}

Surface outline_of(const HeightField& field, double bottom, double width) {
  Surface strips;
  for (int face = 0; face < 4; ++face) {
    const V3 out = kOutward[face];
    std::vector<V3> rim = simplified(rim_of(field, face), 0.3 * width);
    const V3 along = unit(V3{rim.back().x - rim.front().x, rim.back().y - rim.front().y, 0}) * width;
    for (V3& point : rim) point = point + out * width;
    rim.front() = rim.front() - along;
    rim.back() = rim.back() + along;
    const auto add_strip = [&](const std::vector<V3>& above, const auto& low_of) {
      strips.add_grid(2, above.size(), [&](std::size_t row, std::size_t column) {
        const V3 point = above[column];
        return SurfaceVertex{{point.x, point.y, row == 0 ? point.z + width : low_of(point)}, out * -1.0};
      });
    };
    add_strip(rim, [&](const V3& point) { return point.z - width; });
    const auto to_bottom = [&](const V3&) { return bottom; };
    add_strip({rim.front(), rim.front() + along * kCornerWidths}, to_bottom);
    add_strip({rim.back() - along * kCornerWidths, rim.back()}, to_bottom);
  }
  return strips;
}

}  // namespace afm::generate
