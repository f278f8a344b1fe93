// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/topography_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/log.h"
#include "exhibit/models/height_colours.h"
#include "haptics/contact_model.h"
#include "haptics/sample_surface.h"
#include "haptics/simulated_device.h"
#include "models/linear_colour.h"
#include "physics/quantity_text.h"
#include "scene/gltf/loading_notice.h"

namespace afm::exhibit {

namespace {

// Side of a sample in units of the material's stroke, as in the assets, and the relief that is easy to feel.
constexpr double kSideOfStroke = 1.65;
constexpr double kLeastRelief = 0.05, kMostRelief = 0.25;
constexpr double kSlabOfSide = 0.12;  // thickness below the lowest place, relative to the side
constexpr double kOutlineOfSide = 0.0028, kCornerWidths = 2.5;  // same outlines as those of the assets' samples
constexpr double kOutlierShare = 0.002;                         // fraction of points beyond either end of the scale
constexpr double kFlat_m = 1e-15;                               // relief below which a sample is flat

constexpr glm::vec4 kWallColour(0.055F, 0.05F, 0.06F, 1.0F);
constexpr glm::vec4 kOutlineColour(0.004F, 0.004F, 0.005F, 1.0F);

struct Grid {
  const scene::Topography& topography;

  double x(std::size_t column) const { return coordinate(column, topography.columns); }
  double y(std::size_t row) const { return coordinate(row, topography.rows); }
  float z(std::size_t column, std::size_t row) const { return topography.height_m[row * topography.columns + column]; }
  glm::vec3 place(std::size_t column, std::size_t row) const {
    return {static_cast<float>(x(column)), static_cast<float>(y(row)), z(column, row)};
  }

  // Normal from central differences; one-sided at the rim.
  glm::vec3 normal(std::size_t column, std::size_t row) const {
    const std::size_t left = column > 0 ? column - 1 : 0,
                      right = std::min<std::size_t>(column + 1, topography.columns - 1);
    const std::size_t front = row > 0 ? row - 1 : 0, back = std::min<std::size_t>(row + 1, topography.rows - 1);
    const double across = topography.spacing_m * static_cast<double>(right - left),
                 along = topography.spacing_m * static_cast<double>(back - front);
    return glm::vec3(glm::normalize(glm::dvec3(static_cast<double>(z(left, row) - z(right, row)) / across,
                                               static_cast<double>(z(column, front) - z(column, back)) / along, 1.0)));
  }

 private:
  double coordinate(std::size_t index, std::uint32_t count) const {
    return (static_cast<double>(index) - 0.5 * (count - 1)) * topography.spacing_m;
  }
};

scene::Primitive top_of(const Grid& grid, double lowest_m, double highest_m) {
  scene::Primitive top;
  const std::size_t columns = grid.topography.columns, rows = grid.topography.rows;
  top.vertices.reserve(columns * rows);
  const double range_m = std::max(highest_m - lowest_m, kFlat_m);
  // steps between 1024 colours are invisible
  std::vector<glm::vec4> colours(1024);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    colours[i] = linear_colour(height_colour(static_cast<double>(i) / static_cast<double>(colours.size() - 1)));
  }
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double share = (static_cast<double>(grid.z(column, row)) - lowest_m) / range_m;
      const auto colour = static_cast<std::size_t>(std::lround(1023.0 * std::clamp(share, 0.0, 1.0)));
      top.vertices.push_back({grid.place(column, row), grid.normal(column, row), colours[colour]});
    }
  }
  top.indices.reserve(6 * (columns - 1) * (rows - 1));
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto a = static_cast<std::uint32_t>(row * columns + column), b = a + 1;
      const auto c = static_cast<std::uint32_t>(a + columns), d = c + 1;
      // splits along the more level diagonal, so that an edge of the sample is smooth across the grid
      const auto drop = [&](std::uint32_t from, std::uint32_t to) {
        return std::abs(top.vertices[from].position.z - top.vertices[to].position.z);
      };
      const std::array<std::uint32_t, 6> cut =
          drop(a, d) <= drop(b, c) ? std::array{a, b, d, a, d, c} : std::array{a, b, c, b, d, c};
      top.indices.insert(top.indices.end(), cut.begin(), cut.end());
    }
  }
  return top;
}

// Calls face(number of points, outward normal, place of a point on the rim) for each of the four, counter-clockwise as
// seen from above.
template <class Face>
void for_each_face(const Grid& grid, const Face& face) {
  const std::size_t columns = grid.topography.columns, rows = grid.topography.rows;
  face(columns, glm::vec3(0, -1, 0), [&](std::size_t i) { return grid.place(i, 0); });
  face(rows, glm::vec3(1, 0, 0), [&](std::size_t i) { return grid.place(columns - 1, i); });
  face(columns, glm::vec3(0, 1, 0), [&](std::size_t i) { return grid.place(columns - 1 - i, rows - 1); });
  face(rows, glm::vec3(-1, 0, 0), [&](std::size_t i) { return grid.place(0, rows - 1 - i); });
}

// The four faces below the rim.
scene::Primitive walls_of(const Grid& grid, double bottom_m) {
  scene::Primitive walls;
  walls.material = 1;
  const auto face = [&](std::size_t count, const glm::vec3& outward, const auto& place) {
    for (std::size_t i = 0; i < count; ++i) {
      glm::vec3 above = place(i), below = above;
      below.z = static_cast<float>(bottom_m);
      const auto first = static_cast<std::uint32_t>(walls.vertices.size());
      walls.vertices.push_back({above, outward, kWallColour});
      walls.vertices.push_back({below, outward, kWallColour});
      if (i + 1 == count) break;
      walls.indices.insert(walls.indices.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
    }
  };
  for_each_face(grid, face);
  return walls;
}

// Strips along the rim and down its corners, `width_m` off the faces, seen only from inside: from above, a dark line
// around the sample. `rise_m` is the height over the rim.
scene::Primitive outline_of(const Grid& grid, double bottom_m, double width_m, double rise_m) {
  scene::Primitive outline;
  outline.material = 2;
  const auto width = static_cast<float>(width_m), rise = static_cast<float>(rise_m);
  const auto add_strip = [&](std::span<const glm::vec3> rim, const glm::vec3& inward, const auto& low_of) {
    const auto begin = static_cast<std::uint32_t>(outline.vertices.size());
    for (const glm::vec3& point : rim) {
      outline.vertices.push_back({point + glm::vec3(0, 0, rise), inward, kOutlineColour});
      outline.vertices.push_back({glm::vec3(point.x, point.y, low_of(point)), inward, kOutlineColour});
    }
    for (std::uint32_t i = begin; i + 2 < outline.vertices.size(); i += 2) {
      outline.indices.insert(outline.indices.end(), {i, i + 2, i + 1, i + 1, i + 2, i + 3});
    }
  };
  const auto face = [&](std::size_t count, const glm::vec3& outward, const auto& place) {
    std::vector<glm::vec3> rim;
    rim.reserve(count);
    for (std::size_t i = 0; i < count; ++i) rim.push_back(place(i) + width * outward);
    const glm::vec3 along = width * glm::vec3(-outward.y, outward.x, 0);
    rim.front() -= along;
    rim.back() += along;
    add_strip(rim, -outward, [&](const glm::vec3& point) { return point.z - rise; });
    const auto corner = static_cast<float>(kCornerWidths) * along;
    const auto to_bottom = [&](const glm::vec3&) { return static_cast<float>(bottom_m); };
    add_strip(std::array{rim.front(), rim.front() + corner}, -outward, to_bottom);
    add_strip(std::array{rim.back() - corner, rim.back()}, -outward, to_bottom);
  };
  for_each_face(grid, face);
  return outline;
}

double longest_side_m(const scene::Topography& topography) {
  return topography.spacing_m * (std::max(topography.columns, topography.rows) - 1);
}

// Range of the heights without outliers.
std::pair<double, double> range_of(const scene::Topography& topography) {
  std::vector<float> heights = topography.height_m;
  const auto at = [&](double share) {
    const auto place = heights.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), place, heights.end());
    return static_cast<double>(*place);
  };
  return {at(kOutlierShare), at(1.0 - kOutlierShare)};
}

std::string length_of(double length_m) {
  return physics::format_quantity(physics::Length(length_m), physics::kLengthUnits, 4);
}

}  // namespace

scene::Scene topography_scene(const scene::Topography& topography, double lowest_m, double highest_m, double bottom_m) {
  scene::Scene sample;
  sample.materials.push_back({.name = "false colours", .metallic = 0.0F, .roughness = 0.55F});
  sample.materials.push_back({.name = "slab", .metallic = 0.0F, .roughness = 0.7F});
  sample.materials.push_back({.name = "outline", .metallic = 0.0F, .unlit = true});
  const Grid grid{topography};
  // the slab's thickness in proportion gives the outline's height in heights that are drawn exaggerated
  const double rim_m = static_cast<double>(*std::min_element(topography.height_m.begin(), topography.height_m.end()));
  sample.meshes.push_back({"topography",
                           {top_of(grid, lowest_m, highest_m), walls_of(grid, bottom_m),
                            outline_of(grid, bottom_m, kOutlineOfSide * longest_side_m(topography),
                                       kOutlineOfSide / kSlabOfSide * (rim_m - bottom_m))}});
  sample.nodes.push_back({"surface", std::nullopt, 0U, glm::dmat4(1.0)});
  return sample;
}

double exaggeration_of(double relief_m, double side_m) {
  // both limits in true proportions, relative to the stroke
  const double relief = kSideOfStroke * relief_m / side_m;
  if (!(relief_m > kFlat_m) || (relief >= kLeastRelief && relief <= kMostRelief)) return 1.0;
  const double wanted = (relief < kLeastRelief ? kLeastRelief : kMostRelief) / relief;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  if (relief < kLeastRelief) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor * decade >= wanted) return factor * decade;
    }
    return 10.0 * decade;
  }
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= wanted) return factor * decade;
  }
  return decade;
}

TopographyModel topography_model(scene::Topography topography) {
  TopographyModel model;
  model.topography = std::move(topography);
  std::tie(model.lowest_m, model.highest_m) = range_of(model.topography);
  const double side_m = longest_side_m(model.topography);
  model.exaggeration = exaggeration_of(model.highest_m - model.lowest_m, side_m);
  const double lowest_m =
      static_cast<double>(*std::min_element(model.topography.height_m.begin(), model.topography.height_m.end()));
  model.sample = topography_scene(model.topography, model.lowest_m, model.highest_m,
                                  lowest_m - kSlabOfSide * side_m / model.exaggeration);
  return model;
}

core::Result<TopographyModel> load_topography_model(const std::string& file, const curves::TopographyReading& reading) {
  const scene::LoadingNotice notice(file);
  const auto measured = curves::load_topography(file, reading);
  if (!measured) return tl::unexpected(measured.error());
  auto felt = curves::felt_topography(*measured);
  if (!felt) return tl::unexpected(felt.error());
  TopographyModel model = topography_model(std::move(*felt));
  const physics::ScanImage& scan = measured->file.image;
  std::string filled;
  if (measured->level.filled > 0)
    filled = fmt::format("; {} points that were not measured are filled from around them", measured->level.filled);
  std::string resampled;
  if (scan.columns != model.topography.columns || scan.rows != model.topography.rows) {
    resampled = fmt::format(" felt as {} x {}", model.topography.columns, model.topography.rows);
  }
  model.summary = fmt::format(
      "sample {}: channel {}, {} x {} points{}, {} x {}, mean {}, Sq {}; levelling: {}; Sq then {}{}; heights are "
      "drawn and "
      "felt {:g} times as high as in proportion",
      file, measured->channel().name, scan.columns, scan.rows, resampled, length_of(scan.width_m),
      length_of(scan.height_m), length_of(measured->raw.mean), length_of(measured->raw.sq),
      physics::text_of(measured->levelling).meaning, length_of(measured->levelled.sq), filled, model.exaggeration);
  core::log_line(model.summary);
  for (const curves::UnreadChannel& each : measured->file.unread)
    core::log_line(fmt::format("sample {}: its channel {} is left out: {}", file, each.name, each.reason));
  for (const std::string& remark : measured->file.remarks) core::log_line(fmt::format("sample {}: {}", file, remark));
  return model;
}

std::string smoothing_note(const curves::SampleModel& material, const scene::Topography& topography) {
  const scene::SharedContact& parameters = material.parameters;
  const double scale = scene::surface_scale(parameters, material.scaling.release_z_m());
  const auto shown = scene::FeltHeights(topography, parameters.topography).scaled(scale);
  const haptics::SampleSurface felt(
      shown, parameters.contact.tip_radius.si,
      haptics::largest_curvature_per_m(material.scaling, haptics::SimulatedDevice().spec()));
  const haptics::SampleSurface::Change change = felt.change_of(shown);
  const double measured_per_m = 1.0 / (scale * parameters.topography.vertical);
  return fmt::format(
      "the sample is felt on {} smoothed by {} at most and {} rms of its measured heights, so that it is nowhere "
      "too steep or too sharp for a hand",
      material.setup.material.name, length_of(change.largest_m * measured_per_m),
      length_of(change.rms_m * measured_per_m));
}

scene::TopographyScale topography_scale(const TopographyModel& model, double stroke_m) {
  const double lateral = kSideOfStroke * stroke_m / longest_side_m(model.topography);
  return {.lateral = lateral, .vertical = model.exaggeration * lateral};
}

}  // namespace afm::exhibit
