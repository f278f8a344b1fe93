// SPDX-License-Identifier: Apache-2.0
// Invariant: an image, and the false colours of a sample, lie on its surface with their scale beside it
#include "exhibit/scan/scan_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/scan/scan_subject.h"
#include "scanned_sample.h"

// Relief that the keys I and E lay on the sample.
namespace afm::exhibit {
namespace scan_relief_test {

constexpr std::size_t kGold = 1;

std::vector<double> ramp() {
  std::vector<double> heights(kReliefSide * kReliefSide);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = 1e-9 * static_cast<double>(i % kReliefSide);
  return heights;
}

double height_m(const HeightRelief& relief, std::size_t vertex) {
  return relief.floor_m + static_cast<double>(relief.vertices[vertex].position.z) * (relief.lid_m - relief.floor_m);
}

TEST(Relief, HasHeightsColoursAndNormalsOfTheMeasurement) {
  const HeightRelief relief =
      relief_of(ramp(), 640e-9, {.low_m = 0.0, .high_m = 127e-9, .lateral = 2.0, .vertical = 0.5});
  EXPECT_DOUBLE_EQ(relief.side_m, 1280e-9);
  EXPECT_DOUBLE_EQ(relief.range_m, 127e-9);
  for (const std::size_t column : {0U, 40U, 127U}) {
    EXPECT_NEAR(height_m(relief, 5 * kReliefSide + column), 0.5e-9 * static_cast<double>(column), 1e-13);
  }
  EXPECT_LT(relief.vertices[0].color.r, 0.05F) << "plum";
  EXPECT_GT(relief.vertices[kReliefSide - 1].color.r, 0.9F) << "cream";
  // 0.5 nm a cell of 10 nm, in the units of the box
  const double slope = 0.05 * relief.side_m / (relief.lid_m - relief.floor_m);
  const glm::vec3 normal = relief.vertices[40].normal;
  EXPECT_NEAR(static_cast<double>(-normal.x / normal.z), slope, 1e-4);
  EXPECT_NEAR(static_cast<double>(normal.y), 0.0, 1e-6);
}

TEST(Relief, IsInsideTheSampleWhereNothingHasBeenMeasuredAndInsideItsBoxWhateverTheSpikes) {
  std::vector<double> heights = ramp();
  heights[7] = std::nan("");
  heights[9] = 1.0;
  heights[11] = -1.0;
  const HeightRelief relief = relief_of(heights, 640e-9, {.low_m = 0.0, .high_m = 127e-9});
  EXPECT_LT(height_m(relief, 7), -100e-9);
  EXPECT_EQ(relief.vertices[9].position.z, 1.0F);
  EXPECT_EQ(relief.vertices[11].position.z, 0.0F);
  for (const scene::Vertex& vertex : relief.vertices) ASSERT_TRUE(std::isfinite(vertex.normal.x));
}

TEST(ScanRelief, GrowsLineByLineOnTheSurfaceThatTheTipTraces) {
  LiveScan scan = scan_of(kGold);
  const auto measured = [&] {
    const HeightRelief relief = relief_of(scan);
    return std::count_if(relief.vertices.begin(), relief.vertices.end(),
                         [](const scene::Vertex& vertex) { return vertex.position.z > 0.0F; });
  };
  EXPECT_EQ(measured(), 0);
  for (double t = 0; t < 20.0 / scan.choice().line_rate_hz; t += 1.0 / 60.0) scan.advance(1.0 / 60.0);
  EXPECT_NEAR(static_cast<double>(measured()) / static_cast<double>(kReliefSide), 20.0, 1.5);
  const HeightRelief relief = relief_of(scan);
  double error_m = 0.0;
  for (std::size_t column = 0; column < kReliefSide; ++column) {
    const std::size_t vertex = 10 * kReliefSide + column;
    const glm::dvec2 place_m = relief.side_m * glm::dvec2(glm::vec2(relief.vertices[vertex].position));
    error_m += std::abs(height_m(relief, vertex) - scan.surface_m(place_m.x, place_m.y)) / kReliefSide;
  }
  EXPECT_LT(error_m, 0.1 * relief.range_m) << "of the row, on average";

  Moment moment;
  moment.wall.material = kGold;
  render::FrameState frame;
  stage().wall_scene.update(moment.wall, frame);
  const std::size_t labels = frame.labels.size();
  EXPECT_TRUE(frame.shapes.empty());
  stage().wall_scene.lay_on_sample(relief, moment.wall, frame);
  ASSERT_EQ(frame.shapes.size(), 1U);
  EXPECT_EQ(stage().wall_scene.scene().nodes[frame.shapes[0].node].name, "image/relief");
  ASSERT_EQ(frame.labels.size(), labels + 2) << "of the colour scale";
  EXPECT_EQ(frame.labels.back().text, "0");
  moment.wall.centerpiece = Centerpiece::Journey;
  stage().wall_scene.update(moment.wall, frame);
  stage().wall_scene.lay_on_sample(relief, moment.wall, frame);
  EXPECT_TRUE(frame.shapes.empty()) << "no sample there";
}

TEST(SampleInFalseColours, HasTheHeightsThatAreDrawnAndItsScaleAtAnySize) {
  std::vector<curves::SampleModel> models;
  for (const scene::MaterialEntry& entry : stage().materials.materials) {
    models.push_back(curves::make_sample_model(curves::ContactSetup{entry, {}, {}}).value());
  }
  const FrameBuilder frames(stage().wall_scene, models, stage().eyes);
  Moment moment;
  for (std::size_t material = 0; material < models.size(); ++material) {
    moment.wall.material = material;
    moment.wall.false_colours = false;
    EXPECT_TRUE(frames.build(moment).shapes.empty());
    moment.wall.false_colours = true;
    const render::FrameState frame = frames.build(moment);
    ASSERT_EQ(frame.shapes.size(), 1U);

    const ScanSubject subject = scan_subject(stage().wall_scene, material, models[material]);
    const HeightRelief relief = relief_of(subject);
    ASSERT_EQ(frame.shapes[0].vertices.size(), relief.vertices.size());
    for (const std::size_t vertex : {0U, 64U * 128U + 31U, 100U * 128U + 99U}) {
      EXPECT_EQ(frame.shapes[0].vertices[vertex].position, relief.vertices[vertex].position);
      const glm::dvec2 place_m = relief.side_m * glm::dvec2(glm::vec2(relief.vertices[vertex].position));
      EXPECT_NEAR(height_m(relief, vertex), subject.drawn_m(place_m.x, place_m.y), 1e-3 * relief.range_m);
    }
  }
  moment.wall.centerpiece = Centerpiece::Analogy;
  EXPECT_TRUE(frames.build(moment).shapes.empty()) << "no sample there";
}

}  // namespace scan_relief_test
}  // namespace afm::exhibit
