// SPDX-License-Identifier: Apache-2.0
// A force map that is felt whole, in false colours on its sample.
#include "exhibit/scan/map_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

#include "curves/fitting/felt_map.h"
#include "exhibit/models/height_colours.h"
#include "exhibit/scan/scan_subject.h"
#include "models/linear_colour.h"
#include "scanned_sample.h"

namespace afm::exhibit {
namespace map_relief_test {

constexpr std::size_t kGold = 1;
constexpr double kPixelM = 50e-9;

// A map of 4 x 2 pixels, felt at twice its size.
curves::SampleModel sample() {
  auto model = curves::make_sample_model(curves::ContactSetup{stage().materials.materials[kGold], {}, {}}).value();
  curves::FeltMap map;
  map.grid = {.columns = 4, .rows = 2, .width_m = 4 * kPixelM, .height_m = 2 * kPixelM};
  map.laws.columns = 4;
  map.laws.rows = 2;
  map.laws.spacing_m = kPixelM;
  model.felt_map = std::make_shared<const curves::FeltMap>(std::move(map));
  model.parameters.topography = {.lateral = 2.0, .vertical = 0.5};
  model.parameters.surface_release_m = 0.0;
  return model;
}

ScanSubject slope() {
  ScanSubject subject;
  subject.drawn_m = [](double x_m, double) { return 0.1 * x_m; };
  subject.shown = {.lateral = 2.0, .vertical = 0.5};
  return subject;
}

// Pixels from the darkest at the top left to the brightest at the bottom right.
render::MapPicture picture() {
  render::MapPicture shown;
  shown.columns = shown.grid.columns = 4;
  shown.rows = shown.grid.rows = 2;
  for (int cell = 0; cell < 8; ++cell) {
    const auto [r, g, b] = height_colour(cell / 7.0);
    shown.grid.colors.push_back({r, g, b, 255});
  }
  shown.lowest = "1 MPa";
  shown.highest = "8 MPa";
  return shown;
}

const scene::Vertex& at(const HeightRelief& relief, double column_share, double row_share) {
  const auto place = [](double share) { return static_cast<std::size_t>(share * kReliefSide); };
  return relief.vertices[place(row_share) * kReliefSide + place(column_share)];
}

TEST(MapRelief, HasTheColoursOfItsPictureAtThePlacesOfItsPixels) {
  const HeightRelief relief = map_relief(picture(), sample(), slope());
  // from the middle of the first pixel to the middle of the last
  EXPECT_NEAR(relief.side_m, 2.0 * 3.0 * kPixelM, 3e-3 * relief.side_m) << "within its rim";
  EXPECT_EQ(at(relief, 0.0, 0.0).color, linear_colour(height_colour(0.0)));
  EXPECT_EQ(at(relief, 0.99, 0.99).color, linear_colour(height_colour(1.0)));
  EXPECT_EQ(at(relief, 0.3, 0.0).color, linear_colour(height_colour(1.0 / 7.0)));
  EXPECT_EQ(at(relief, 0.3, 0.99).color, linear_colour(height_colour(5.0 / 7.0)));
  // a third as deep as wide, and on the drawn surface
  EXPECT_NEAR(static_cast<double>(at(relief, 0.0, 0.0).position.y), 0.5 / 3.0, 2e-3);
  const auto height_m = [&](const scene::Vertex& vertex) {
    return relief.floor_m + static_cast<double>(vertex.position.z) * (relief.lid_m - relief.floor_m);
  };
  const scene::Vertex& left = at(relief, 0.0, 0.5);
  EXPECT_NEAR(height_m(left), 0.5 * 0.1 * static_cast<double>(left.position.x) * relief.side_m / 2.0, 1e-12);
  for (const scene::Vertex& vertex : relief.vertices) {
    ASSERT_NEAR(static_cast<double>(glm::length(vertex.normal)), 1.0, 1e-5);
    ASSERT_LE(std::abs(vertex.position.x), 0.5F);
    ASSERT_LE(std::abs(vertex.position.y), 0.5F);
  }
}

TEST(MapRelief, LiesOnTheSampleWithItsRangeInItsUnit) {
  const curves::SampleModel model = sample();
  WallState state;
  state.material = kGold;
  render::FrameState frame;
  const WallScene& wall = stage().wall_scene;
  wall.update(state, frame);
  const std::size_t labels = frame.labels.size();
  lay_map(map_relief(picture(), model, slope()), picture(), wall, state, frame);
  ASSERT_EQ(frame.shapes.size(), 1U);
  ASSERT_EQ(frame.labels.size(), labels + 2);
  const auto has = [&](const std::string& text) {
    return std::any_of(frame.labels.begin(), frame.labels.end(),
                       [&](const render::Label& label) { return label.text == text; });
  };
  EXPECT_TRUE(has("1 MPa"));
  EXPECT_TRUE(has("8 MPa"));
  EXPECT_FALSE(has("0")) << "the modulus does not begin there";
  state.centerpiece = Centerpiece::Journey;
  wall.update(state, frame);
  lay_map(map_relief(picture(), model, slope()), picture(), wall, state, frame);
  EXPECT_TRUE(frame.shapes.empty()) << "no sample there";
}

}  // namespace map_relief_test
}  // namespace afm::exhibit
