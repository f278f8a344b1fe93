// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/map_relief.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "curves/fitting/felt_map.h"
#include "exhibit/scan/scan_subject.h"
#include "exhibit/scenery/wall_scene.h"
#include "models/linear_colour.h"
#include "scan/image_maps.h"
#include "scene/shared/felt_heights.h"

namespace afm::exhibit {

namespace {

constexpr double kColouredShare = 0.998;  // coloured fraction of the map's width, within the edge of the sample

// Place of a vertex along a side, -0.5 to 0.5.
double vertex_middle(std::size_t cell) { return (static_cast<double>(cell) + 0.5) / kReliefSide - 0.5; }

// Cell of a grid at a place, 0 to 1.
std::size_t grid_cell_at(double place, std::uint32_t cells) {
  return static_cast<std::size_t>(std::clamp(std::floor(place * cells), 0.0, cells - 1.0));
}

}  // namespace

HeightRelief map_relief(const render::MapPicture& picture, const curves::SampleModel& model,
                        const ScanSubject& subject) {
  const curves::FeltMap& map = *model.felt_map;
  const scene::TopographyScale& scale = model.parameters.topography;
  const double lateral = scale.lateral * scene::surface_scale(model.parameters, model.scaling.release_z_m());
  // between the middles of its outermost pixels, metres as measured
  const glm::dvec2 size_m =
      kColouredShare * map.laws.spacing_m * glm::dvec2(map.laws.columns - 1.0, map.laws.rows - 1.0);
  const double side_m = std::max(size_m.x, size_m.y);
  const glm::dvec2 share = size_m / side_m;
  const double drawn_per_m = lateral / subject.shown.lateral;

  std::vector<double> height_m;
  std::vector<glm::vec4> colours;
  height_m.reserve(kReliefSide * kReliefSide);
  colours.reserve(kReliefSide * kReliefSide);
  for (std::size_t row = 0; row < kReliefSide; ++row) {
    const double y_m = -vertex_middle(row) * size_m.y;
    const std::size_t line = grid_cell_at(0.5 - y_m / map.grid.height_m, picture.grid.rows);
    for (std::size_t column = 0; column < kReliefSide; ++column) {
      const double x_m = vertex_middle(column) * size_m.x;
      height_m.push_back(subject.drawn_m(drawn_per_m * x_m, drawn_per_m * y_m));
      const std::size_t cell = grid_cell_at(0.5 + x_m / map.grid.width_m, picture.grid.columns);
      const auto& [r, g, b, coverage] = picture.grid.colors[line * picture.grid.columns + cell];
      colours.push_back(linear_colour({r, g, b}));
    }
  }
  const Range heights = at_least(range_of(height_m), kLeastRangeM);
  HeightRelief relief =
      relief_of(height_m, side_m,
                {.low_m = heights.low, .high_m = heights.high, .lateral = lateral, .vertical = subject.shown.vertical});
  for (std::size_t i = 0; i < relief.vertices.size(); ++i) {
    scene::Vertex& vertex = relief.vertices[i];
    vertex.color = colours[i];
    vertex.position.x *= static_cast<float>(share.x);
    vertex.position.y *= static_cast<float>(share.y);
    vertex.normal.x /= static_cast<float>(share.x);
    vertex.normal.y /= static_cast<float>(share.y);
    vertex.normal = glm::normalize(vertex.normal);
  }
  return relief;
}

void lay_map(const HeightRelief& relief, const render::MapPicture& picture, const WallScene& wall_scene,
             const WallState& state, render::FrameState& frame) {
  if (state.centerpiece != Centerpiece::Instrument || !state.material) return;
  wall_scene.lay_on_sample(relief, state, frame);
  const auto write = [&](double share, const std::string& text) {
    const render::PanelPlacement place = wall_scene.places().height_bar_text(share);
    const auto label = std::find_if(frame.labels.begin(), frame.labels.end(),
                                    [&](const render::Label& each) { return each.placement == place; });
    if (label != frame.labels.end()) label->text = text;
  };
  write(0.0, picture.lowest);
  write(1.0, picture.highest);
}

}  // namespace afm::exhibit
