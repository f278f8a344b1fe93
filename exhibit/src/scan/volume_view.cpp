// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/volume_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "core/check.h"
#include "curves/fitting/felt_map.h"
#include "curves/live_parameters.h"
#include "exhibit/models/volume_shapes.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_scene.h"
#include "models/linear_colour.h"
#include "physics/quantity_text.h"
#include "scene/shared/felt_heights.h"

namespace afm::exhibit {

using curves::ForceVolume;
using glm::dmat4;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double kVolumeWithinRim = 0.998;  // share of the map's width, as of exhibit/scan/map_relief.h
constexpr double kSliceBehind = 0.012;      // distance of the slice behind the tip's axis, clear of the tip
constexpr double kLeastTop = 1e-12;         // height of the curves of a map without any force
constexpr float kFaintestCoverage = 0.30F, kStrongestCoverage = 0.92F;  // coverage without force, and of the strongest
constexpr int kForceDigits = 3;
constexpr Srgb kEqualForce{0, 158, 115};
constexpr float kSurfaceCoverage = 0.55F;
constexpr double kForceTextGap = 0.015, kForceTextWidth = 0.18, kForceTextHeight = 0.05;

scene::NodeIndex volume_node(const WallScene& wall_scene, const char* name) {
  const auto node = wall_scene.scene().find_node(name);
  AFM_CHECK(node.has_value());
  return *node;
}

std::string force_words(double force_n, const Phrases& phrases) {
  return phrases.number(
      curves::typographic(physics::format_quantity(physics::Force(force_n), physics::kForceUnits, kForceDigits)));
}

// Fraction of the range, from -1 to 1; NaN stays.
double share_of_range(double force_n, const ForceVolume& volume) {
  return force_n < 0.0 ? -force_n / volume.strongest_pull_n() : force_n / volume.strongest_push_n();
}

glm::vec4 coverage_colour(double force_n, const ForceVolume& volume) {
  if (std::isnan(force_n)) return glm::vec4(0.0F);
  const double share = share_of_range(force_n, volume);
  glm::vec4 colour = linear_colour(force_colour(share));
  colour.a = kFaintestCoverage +
             (kStrongestCoverage - kFaintestCoverage) * static_cast<float>(std::sqrt(std::fmin(std::abs(share), 1.0)));
  return colour;
}

// Unit normal of a surface with these rises for a step of the grid along x and y.
glm::vec3 steps_normal(double along_x, double along_y) {
  constexpr double kSteps = kSurfaceSide - 1.0;
  return glm::vec3(glm::normalize(dvec3(-along_x * kSteps, -along_y * kSteps, 1.0)));
}

double within_width(double place, double width) { return std::clamp(place, -0.5 * width, 0.5 * width); }

}  // namespace

VolumeView::VolumeView(const WallScene& wall_scene)
    : wall_scene_(wall_scene),
      slice_(volume_node(wall_scene, "slice/slice")),
      bar_(volume_node(wall_scene, "force-bar/bar")),
      equal_force_(volume_node(wall_scene, "equal-force/surface")) {}

const VolumeView::Scales& VolumeView::scales_of(const curves::SampleModel& model, const WallState& state) {
  if (scales_ && scales_->release_z_m == state.release_z_m) return *scales_;
  cut_.reset();
  raised_.reset();
  const curves::FeltMap& map = *model.felt_map;
  const ScanSubject subject = scan_subject(wall_scene_, *state.material, model);
  Scales scales{.release_z_m = state.release_z_m, .drawn_m = subject.drawn_m, .shown = subject.shown};
  const double drawn_m = wall_scene_.drawn_scale(*state.material, state.release_z_m).sample_m_per_m;
  scales.per_m = 1.0 / (drawn_m * wall_scene_.unit_m());
  const double top_m = std::max(map.volume->top_m(), kLeastTop);
  scales.per_height_m = std::clamp(scales.per_m, kLeastVolumeHeight / top_m, kVolumeHeight / top_m);
  scales.top = scales.per_height_m * top_m;
  scales.lateral =
      model.parameters.topography.lateral * scene::surface_scale(model.parameters, model.scaling.release_z_m());
  scales.map_m = {map.grid.width_m, map.grid.height_m};
  scales.size_m = kVolumeWithinRim * map.laws.spacing_m * dvec2(map.laws.columns - 1.0, map.laws.rows - 1.0);
  double lowest = surface(scales, 0.0, 0.0), highest = lowest;
  constexpr int kPlaces = 64;
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j < kPlaces; ++j) {
      const dvec2 share = dvec2(i, j) / (kPlaces - 1.0) - 0.5;
      const double height = surface(scales, share.x * scales.size_m.x, share.y * scales.size_m.y);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
  }
  scales.floor = lowest;
  scales.lid = highest + scales.top;
  scales_ = std::move(scales);
  return *scales_;
}

// Height of the drawn surface at a measured place.
double VolumeView::surface(const Scales& scales, double x_m, double y_m) const {
  const double drawn = scales.lateral / scales.shown.lateral;
  return scales.per_m * scales.shown.vertical * scales.drawn_m(drawn * x_m, drawn * y_m);
}

VolumeView::Slice VolumeView::cut(const ForceVolume& volume, const Scales& scales, double y_m,
                                  ForceVolume::Way way) const {
  Slice slice;
  slice.way = way;
  slice.vertices = slice_mesh().meshes.front().primitives.front().vertices;
  const double height = scales.lid - scales.floor;
  for (std::size_t column = 0; column < kSliceColumns; ++column) {
    const double x_m = scales.size_m.x * static_cast<double>(slice.vertices[column].position.x);
    const double foot = std::max(surface(scales, x_m, y_m), scales.floor);
    for (std::size_t row = 0; row < kSliceRows; ++row) {
      const double above = static_cast<double>(row) / (kSliceRows - 1) * scales.top;
      scene::Vertex& vertex = slice.vertices[row * kSliceColumns + column];
      vertex.position.z = static_cast<float>(std::clamp((foot + above - scales.floor) / height, 0.0, 1.0));
      vertex.color = coverage_colour(
          volume.force_n(way, 0.5 + x_m / scales.map_m.x, 0.5 + y_m / scales.map_m.y, above / scales.per_height_m),
          volume);
    }
    (column == 0 ? slice.left : slice.right) = foot;
  }
  return slice;
}

VolumeView::Surface VolumeView::raise(const ForceVolume& volume, const Scales& scales, double force_n) const {
  Surface surface_of_force{.force_n = force_n,
                           .vertices = equal_force_mesh().meshes.front().primitives.front().vertices};
  std::vector<scene::Vertex>& vertices = surface_of_force.vertices;
  glm::vec4 colour = linear_colour(kEqualForce);
  const double height = scales.lid - scales.floor;
  for (scene::Vertex& vertex : vertices) {
    const double x_m = scales.size_m.x * static_cast<double>(vertex.position.x),
                 y_m = scales.size_m.y * static_cast<double>(vertex.position.y);
    const double above_m = volume.height_of_m(force_n, 0.5 + x_m / scales.map_m.x, 0.5 + y_m / scales.map_m.y);
    const bool reached = std::isfinite(above_m);
    const double foot = std::max(surface(scales, x_m, y_m), scales.floor);
    const double there = foot + (reached ? scales.per_height_m * above_m : 0.0);
    vertex.position.z = static_cast<float>(std::clamp((there - scales.floor) / height, 0.0, 1.0));
    colour.a = reached ? kSurfaceCoverage : 0.0F;
    vertex.color = colour;
  }
  const auto z = [&](std::size_t column, std::size_t row) {
    return static_cast<double>(vertices[row * kSurfaceSide + column].position.z);
  };
  for (std::size_t row = 0; row < kSurfaceSide; ++row) {
    for (std::size_t column = 0; column < kSurfaceSide; ++column) {
      const std::size_t left = column > 0 ? column - 1 : 0, right = std::min(column + 1, kSurfaceSide - 1);
      const std::size_t front = row > 0 ? row - 1 : 0, back = std::min(row + 1, kSurfaceSide - 1);
      vertices[row * kSurfaceSide + column].normal =
          steps_normal((z(right, row) - z(left, row)) / static_cast<double>(right - left),
                       (z(column, back) - z(column, front)) / static_cast<double>(back - front));
    }
  }
  surface_of_force.left = scales.floor + z(0, 0) * height;
  return surface_of_force;
}

// Upright text in the plane of the slice; `place` is the middle of its left edge, in the sample's frame.
void VolumeView::write(const std::string& text, const dvec3& place, render::FrameState& frame) const {
  const dmat4& room_from_sample = frame.room_from_node[wall_scene_.sample_node()];
  const auto vector = [&](const dvec3& v) { return dvec3(room_from_sample * glm::dvec4(v, 0.0)); };
  const dvec3 corner = place - dvec3(0.0, 0.0, 0.5 * kForceTextHeight);
  frame.labels.push_back({.text = text,
                          .highlighted = false,
                          .placement = {.lower_left_m = dvec3(room_from_sample * glm::dvec4(corner, 1.0)),
                                        .right_m = vector({kForceTextWidth, 0.0, 0.0}),
                                        .up_m = vector({0.0, 0.0, kForceTextHeight})}});
}

// Adds the colour scale within the right end of the slice, at `foot`; its numbers are beside it.
void VolumeView::add_bar(const ForceVolume& volume, const Scales& scales, const dvec3& foot,
                         render::FrameState& frame) const {
  const double height = std::max(scales.top, 2.0 * kForceTextHeight);
  const double left = foot.x - height * kForceBarWidth;
  frame.room_from_node[bar_] =
      frame.room_from_node[wall_scene_.sample_node()] *
      glm::scale(glm::translate(dmat4(1.0), dvec3(left, foot.y - kReliefLift, foot.z)), dvec3(height));
  frame.shapes.push_back({.node = bar_, .vertices = force_bar_vertices(kForceBarWidth)});

  const auto beside = [&](double share) { return foot + dvec3(kForceTextGap, 0.0, share * height); };
  write(force_words(volume.strongest_pull_n(), wall_scene_.phrases()), beside(0.0), frame);
  write("0", beside(0.5), frame);
  write(force_words(volume.strongest_push_n(), wall_scene_.phrases()), beside(1.0), frame);
}

void VolumeView::add_slice(const curves::SampleModel& model, const WallState& state, ForceVolume::Way way,
                           render::FrameState& frame) {
  if (state.centerpiece != Centerpiece::Instrument || !state.material) return;
  const ForceVolume& volume = *model.felt_map->volume;
  const Scales& scales = scales_of(model, state);
  const double y_m = within_width(state.surface.xy_m[1] / scales.lateral, scales.size_m.y);
  // the middle of the line of pixels, so that the slice is drawn anew on another line alone
  const auto lines = static_cast<double>(model.felt_map->grid.rows);
  const auto row =
      static_cast<std::size_t>(std::clamp(std::floor((0.5 + y_m / scales.map_m.y) * lines), 0.0, lines - 1.0));
  if (!cut_ || cut_->row != row || cut_->way != way) {
    const double middle_m = ((static_cast<double>(row) + 0.5) / lines - 0.5) * scales.map_m.y;
    cut_ = cut(volume, scales, within_width(middle_m, scales.size_m.y), way);
    cut_->row = row;
  }
  const double per_measured_m = scales.per_m * scales.lateral, width = per_measured_m * scales.size_m.x;
  const double y = per_measured_m * y_m + kSliceBehind;
  frame.room_from_node[slice_] = frame.room_from_node[wall_scene_.sample_node()] *
                                 glm::scale(glm::translate(dmat4(1.0), dvec3(0.0, y, scales.floor + kReliefLift)),
                                            dvec3(width, 1.0, scales.lid - scales.floor));
  frame.shapes.push_back({.node = slice_, .vertices = cut_->vertices});
  add_bar(volume, scales, {0.5 * width, y, cut_->right + kReliefLift}, frame);
  wall_scene_.clear_right_of_ruler(state, frame);
  const std::string height = curves::typographic(
      physics::format_quantity(physics::Length(scales.top / scales.per_height_m), physics::kLengthUnits, kForceDigits));
  write(wall_scene_.phrases().text<Phrase::SliceHeight>(wall_scene_.phrases().number(height)),
        {-0.5 * width, y, cut_->left + scales.top + kForceTextHeight}, frame);
}

void VolumeView::add_surface(const curves::SampleModel& model, const WallState& state, double force_n,
                             render::FrameState& frame) {
  if (state.centerpiece != Centerpiece::Instrument || !state.material) return;
  const Scales& scales = scales_of(model, state);
  if (!raised_ || raised_->force_n != force_n) raised_ = raise(*model.felt_map->volume, scales, force_n);
  const dvec2 size = scales.per_m * scales.lateral * scales.size_m;
  frame.room_from_node[equal_force_] =
      frame.room_from_node[wall_scene_.sample_node()] *
      glm::scale(glm::translate(dmat4(1.0), dvec3(0.0, 0.0, scales.floor + 2.0 * kReliefLift)),
                 dvec3(size, scales.lid - scales.floor));
  frame.shapes.push_back({.node = equal_force_, .vertices = raised_->vertices});
  write(force_words(force_n, wall_scene_.phrases()), {-0.5 * size.x, -0.5 * size.y, raised_->left + kForceTextHeight},
        frame);
}

}  // namespace afm::exhibit
