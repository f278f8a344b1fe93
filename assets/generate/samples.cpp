// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "grains.h"
#include "height_field.h"
#include "models.h"

namespace afm::generate {
namespace {

constexpr double kNm = 1e-9;

NodeSpec surface_node(const HeightField& field, std::vector<Part> parts) {
  return {
      .name = "surface",
      .parent = 0,
      .parts = std::move(parts),
      .extras = {{"patch_side_m", field.side()},
                 {"grid_vertices_a_side", field.vertices_a_side()},
                 {"grid_spacing_m", field.spacing()},
                 {"roughness_rms_m", field.roughness()},
                 {"height_grid",
                  "z of the first primitive's vertices: row by row from -y to +y, x fastest, centred on the origin"}}};
}

// `bottom`: height of the cut faces' lower edge.
Model sample(std::string name, NodeSpec node, const HeightField& field, double bottom) {
  constexpr double kOutline = 0.0028;  // width relative to the side
  Model model{std::move(name), {}};
  model.nodes.push_back({.name = "sample",
                         .placement = kYUpFromZUp,
                         .parts = {{outline_of(field, bottom, kOutline * field.side()), outline_material()}}});
  model.nodes.push_back(std::move(node));
  return model;
}

// Terraces that fall towards -y, the viewer; every step is one layer, 1.0 nm.
class MicaSteps {
 public:
  static constexpr std::uint32_t kCount = 4;
  static constexpr double kLayer = 1.0 * kNm;
  static constexpr double kHalfSide = 20 * kNm;

  double height(double x, double y) const {
    double count = -kLayersBelowCenter;
    for (std::uint32_t k = 0; k < kCount; ++k) {
      count += smooth_step(-kHalfRiser, kHalfRiser, 0.96 * y + 0.28 * x - line(0.96 * x - 0.28 * y, k));
    }
    return count * kLayer;
  }

  // Terraces above a step are lighter, and their hues alternate as the interference colours of thin flakes do, which
  // makes mica pearly.
  static V3 hue(double height) {
    const double layer = std::clamp(height / kLayer + kLayersBelowCenter, 0.0, double{kCount});
    return kHues[static_cast<std::size_t>(std::lround(layer))];
  }

  // A step's face along its line, over the squares of the grid, which would fray it: the edge of the upper sheet
  // catches the light, its foot is in its shade.
  Surface face(std::uint32_t k) const {
    struct Row {
      double offset;  // distance from the line, in half widths of the riser
      double upper;   // fraction of the upper terrace's hue
      double lit;
    };
    constexpr Row kRows[] = {{-1.05, 0, 1},  {-0.92, 0, 0.66}, {-0.8, 0, 0.45}, {0.4, 0.5, 0.55},
                             {0.5, 1, 1.25}, {0.8, 1, 1.12},   {1.05, 1, 1}};
    constexpr std::size_t kColumns = 121;
    constexpr double kLift = 0.05 * kNm, kStep = 0.05 * kNm;
    Surface surface;
    surface.add_grid(std::size(kRows), kColumns, [&](std::size_t row, std::size_t column) {
      const double x = mix(-kHalfSide, kHalfSide, static_cast<double>(column) / (kColumns - 1));
      double along = kSteps[k] * kNm, across = 0;
      for (int i = 0; i < 20; ++i) {
        across = (x - 0.28 * along) / 0.96;
        along = line(across, k) + kRows[row].offset * kHalfRiser;
      }
      const double y = std::clamp(0.96 * along - 0.28 * across, -kHalfSide, kHalfSide);
      const V3 slope{(height(x + kStep, y) - height(x - kStep, y)) / (2 * kStep),
                     (height(x, y + kStep) - height(x, y - kStep)) / (2 * kStep), 0};
      return SurfaceVertex{{x, y, height(x, y) + kLift},
                           unit(V3{-slope.x, -slope.y, 1}),
                           mix(kHues[k], kHues[k + 1], kRows[row].upper) * kRows[row].lit};
    });
    return surface;
  }

 private:
  static constexpr double kHalfRiser = 1.0 * kNm;
  // places along the ascent in nm; the upper two are clear of a ball of 50 nm on the middle
  static constexpr double kSteps[] = {-15.5, -7.5, 11.5, 16.5};
  static constexpr int kLayersBelowCenter = 2;
  static constexpr V3 kHues[] = {
      {0.52, 0.62, 0.72}, {0.66, 0.72, 0.80}, {0.78, 0.80, 0.86}, {0.90, 0.89, 0.92}, {1.0, 0.99, 0.97}};

  // Place of a step along the ascent, which wanders across it.
  static double line(double across, std::uint32_t k) {
    return (kSteps[k] + (1.6 * noise(across / (11 * kNm), k, 11) + 0.5 * noise(across / (4.5 * kNm), k, 12))) * kNm;
  }
};

Model mica() {
  constexpr double kLayer = MicaSteps::kLayer;
  const MicaSteps steps;
  const HeightField field(90, 40 * kNm / 90, [&](double x, double y) { return steps.height(x, y); });

  // the cut face of clear sheets: each as the one above, with a fine dark gap below it
  constexpr double kGap = 0.14;  // height relative to a layer
  const V3 sheet{0.80, 0.86, 0.88}, gap{0.34, 0.40, 0.44};
  std::vector<WallBand> bands;
  for (int layer = 2; layer > -9; --layer) {
    bands.push_back({layer * kLayer, (layer - 1 + kGap) * kLayer, sheet});
    bands.push_back({(layer - 1 + kGap) * kLayer, (layer - 1) * kLayer, gap});
  }
  const MaterialSpec material{
      .name = "mica", .base_color = {0.60, 0.63, 0.66}, .roughness = 0.11, .vertex_colors = true};
  MaterialSpec edge = material;
  edge.name = "mica steps";
  edge.roughness = 0.5;
  Surface faces;
  for (std::uint32_t k = 0; k < MicaSteps::kCount; ++k) add_placed(faces, steps.face(k), {});
  NodeSpec node =
      surface_node(field, {{top_of(field, [](const V3& place) { return MicaSteps::hue(place.z); }), material},
                           {walls_of(field, bands), material},
                           {std::move(faces), edge}});
  node.extras["step_m"] = kLayer;
  return sample("sample-mica", std::move(node), field, bands.back().bottom);
}

// An evaporated film: rounded grains, the middle one with a flat top.
Model gold() {
  constexpr double kHeight = 8 * kNm;
  const Grains grains{.cell = 42 * kNm, .smallest = 0.62, .radius_low = 0.62, .radius_high = 0.86, .seed = 21};
  HeightField field(90, 288 * kNm / 90, [&](double x, double y) {
    return kHeight * grains.height(x, y) + 0.25 * kNm * noise(x / (11 * kNm), y / (11 * kNm), 31);
  });
  field.level_at_center();

  const auto tint = [&](const V3& position) {
    const double lit = mix(0.42, 1, smooth_step(-6.5 * kNm, 0.5 * kNm, position.z));
    return V3{lit, lit * mix(0.62, 1, lit), lit * mix(0.3, 1, lit)};  // gold seen in gold is redder
  };
  const MaterialSpec film{
      .name = "gold", .base_color = {1.0, 0.66, 0.23}, .metallic = 1, .roughness = 0.26, .vertex_colors = true};
  const MaterialSpec substrate{.name = "substrate", .base_color = {0.085, 0.095, 0.115}, .roughness = 0.3};
  const MaterialSpec cut{
      .name = "cut gold", .base_color = {0.85, 0.62, 0.24}, .metallic = 0.4, .roughness = 0.5, .vertex_colors = true};
  const std::vector<WallBand> film_bands{{kHeight, -9 * kNm, {0.85, 0.82, 0.78}},
                                         {-9 * kNm, -18 * kNm, {0.78, 0.75, 0.70}}};
  const std::vector<WallBand> substrate_bands{{-18 * kNm, -46 * kNm}};
  return sample("sample-gold",
                surface_node(field, {{top_of(field, tint), film},
                                     {walls_of(field, film_bands), cut},
                                     {walls_of(field, substrate_bands), substrate}}),
                field, substrate_bands.back().bottom);
}

// A deposited film: isotropic, fine, without a direction or a step.
Model silicon_nitride() {
  constexpr double kRoughness = 0.4 * kNm;
  const Grains grains{.cell = 3.4 * kNm, .smallest = 0.35, .radius_low = 0.7, .radius_high = 1.05, .seed = 41};
  HeightField field(90, 48 * kNm / 90, [&](double x, double y) {
    return grains.height(x, y) + 0.22 * noise(x / (13 * kNm), y / (13 * kNm), 51);
  });
  field.scale(kRoughness / field.roughness());
  const double plateau = field.at(45, 45);
  field.flatten_center(10 * kNm, plateau);
  field.level_at_center();

  const auto tint = [&](const V3& position) {
    const double lit = mix(0.55, 1, smooth_step(-4 * kRoughness, 0.5 * kRoughness, position.z));
    return V3{lit, lit, lit};
  };
  const MaterialSpec material{
      .name = "silicon nitride", .base_color = {0.085, 0.110, 0.155}, .roughness = 0.15, .vertex_colors = true};
  const std::vector<WallBand> bands{{3 * kNm, -2 * kNm, {0.85, 0.85, 0.85}}, {-2 * kNm, -9.5 * kNm, {0.7, 0.7, 0.7}}};
  return sample("sample-si3n4",
                surface_node(field, {{top_of(field, tint), material}, {walls_of(field, bands), material}}), field,
                bands.back().bottom);
}

}  // namespace

std::vector<Model> samples() { return {mica(), gold(), silicon_nitride()}; }

}  // namespace afm::generate
