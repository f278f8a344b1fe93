// SPDX-License-Identifier: Apache-2.0
// Invariant: the live window keeps moved scenes within the disparity limit
#include "exhibit/frame/wall_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exhibit/frame/calibration.h"
#include "exhibit/frame/comfort_clamp.h"
#include "exhibit/panels/depth_report.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace wall_pictures_test {

using scene::EyeOrder;
using scene::StereoMode;
using ::testing::HasSubstr;

scene::Wall preset(const std::string& name) {
  return scene::load_wall(support::source("assets/walls/") + name + ".toml").value();
}

TEST(WallPictures, ThePatternHasALetterForEachEyeOnlyWhereTheirPicturesDiffer) {
  const scene::Screen screen = preset("two-projectors").screens.front();
  for (const scene::StereoModeTraits& row : scene::kStereoModes) {
    render::FrameState frame;
    show_calibration(screen, row.mode, 0.063, test::english(), frame);
    EXPECT_EQ(frame.panels.calibration.content.eye_marks, row.mode != StereoMode::Mono) << row.name;
  }
}

// Between which lines the pictures fade out, and one grid for both.
TEST(WallPictures, ThePatternMarksWhereScreensAreBlended) {
  const scene::Wall wall = preset("blended");
  std::array<render::CalibrationPanel, 2> panels;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    render::FrameState frame;
    show_calibration(wall.screens.at(i), StereoMode::SideBySide, 0.063, test::english(), frame);
    panels.at(i) = frame.panels.calibration.content;
  }
  const auto right = static_cast<std::size_t>(scene::ScreenEdge::Right);
  EXPECT_NEAR(panels[0].ramps.at(right).width_m, 0.4, 1e-9);
  EXPECT_EQ(panels[0].ramp_widths, (std::array<std::string, 4>{"", "", "400 mm", ""}));
  EXPECT_EQ(panels[1].ramp_widths, (std::array<std::string, 4>{"400 mm", "", "", ""}));
  EXPECT_EQ(panels[0].grid_from_m, glm::dvec2(0.0));
  EXPECT_NEAR(panels[1].grid_from_m.x, -2.8, 1e-9);
  render::FrameState frame;
  show_calibration(preset("tiled-2x2").screens.front(), StereoMode::SideBySide, 0.063, test::english(), frame);
  EXPECT_EQ(frame.panels.calibration.content.ramp_widths, (std::array<std::string, 4>{}));
}

TEST(WallPictures, CorrectEachProjector) {
  const auto blended = plan_wall(preset("blended"), {}).value();
  const auto curved = plan_wall(preset("curved"), {.mesh_lines = true}).value();
  EXPECT_TRUE(blended.outputs[0].composition.blend && blended.outputs[1].composition.blend);
  EXPECT_NE(blended.outputs[0].composition.blend, blended.outputs[1].composition.blend);
  EXPECT_FALSE(blended.outputs[0].composition.warp || blended.outputs[0].composition.mesh_lines);
  EXPECT_TRUE(curved.outputs[0].composition.warp && curved.outputs[0].composition.mesh_lines);

  // without projectors, screens are blended according to their corners
  scene::Wall screens = preset("blended");
  screens.outputs.clear();
  const auto plan = plan_wall(screens, {}).value();
  ASSERT_TRUE(plan.outputs[1].composition.blend);
  EXPECT_FALSE(plan.outputs[1].composition.blend->gamma);
}

TEST(WallPictures, EveryPresetIsAWallThatCanBeDrawn) {
  for (const char* name : {"powerwall", "two-projectors", "3d-tv", "desk-red-cyan", "tiled-2x2", "blended", "curved"}) {
    const auto plan = plan_wall(preset(name), {});
    ASSERT_TRUE(plan.has_value()) << name;
    EXPECT_FALSE(plan->outputs.empty());
    for (const OutputPicture& output : plan->outputs) {
      EXPECT_TRUE(eyes_before(output.screen, preset(name).viewers[0].sweet_spot, 0.063)) << name;
      const glm::ivec2 end = output.rect.offset_px + glm::ivec2(output.rect.size_px);
      EXPECT_LE(end.x, static_cast<int>(plan->size_px.x)) << name;
      EXPECT_LE(end.y, static_cast<int>(plan->size_px.y)) << name;
    }
  }
}

TEST(WallPictures, TwoProjectorsStandBesideEachOtherEachWithItsEye) {
  const auto plan = plan_wall(preset("two-projectors"), {}).value();
  EXPECT_EQ(plan.size_px, glm::uvec2(2800, 1050));
  ASSERT_EQ(plan.outputs.size(), 2U);
  EXPECT_EQ(plan.outputs[0].composition.mode, StereoMode::Left);
  EXPECT_EQ(plan.outputs[1].composition.mode, StereoMode::Right);
  EXPECT_EQ(plan.outputs[1].rect.offset_px, glm::ivec2(1400, 0));
}

TEST(WallPictures, AModeOfTheUsersDrawsAPairOfProjectorsOnce) {
  const auto plan = plan_wall(preset("two-projectors"), {.mode = StereoMode::AnaglyphRedCyan}).value();
  ASSERT_EQ(plan.outputs.size(), 1U);
  EXPECT_EQ(plan.size_px, glm::uvec2(1400, 1050));
}

TEST(WallPictures, SwappingIsTheOtherWayRoundInEveryOutput) {
  scene::Wall wall = preset("two-projectors");
  wall.outputs[1].order = EyeOrder::Swapped;
  const auto plan = plan_wall(wall, {.mode = {}, .order = EyeOrder::Swapped}).value();
  EXPECT_EQ(plan.outputs[0].composition.order, EyeOrder::Swapped);
  EXPECT_EQ(plan.outputs[1].composition.order, EyeOrder::Straight);
}

TEST(WallPictures, TilesStillTouchWhenTheyAreScaled) {
  for (const glm::uvec2 size : {glm::uvec2(101, 77), glm::uvec2(2, 2), glm::uvec2(5000, 3000)}) {
    const auto plan = plan_wall(preset("tiled-2x2"), {.mode = {}, .size_px = size}).value();
    EXPECT_EQ(plan.size_px, size);
    const auto& o = plan.outputs;
    EXPECT_EQ(o[0].rect.size_px.x + o[1].rect.size_px.x, size.x);
    EXPECT_EQ(o[0].rect.size_px.y + o[2].rect.size_px.y, size.y);
    EXPECT_EQ(o[1].rect.offset_px.x, static_cast<int>(o[0].rect.size_px.x));
    EXPECT_EQ(o[2].rect.offset_px.y, static_cast<int>(o[0].rect.size_px.y));
  }
}

TEST(WallPictures, ASizeIsTheWholePicturesInEveryMode) {
  const scene::Wall wall = preset("powerwall");
  for (const auto& entry : scene::kStereoModes) {
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(640, 480), glm::uvec2(31, 17)}) {
      const auto plan = plan_wall(wall, {.mode = entry.mode, .size_px = size});
      if (scene::frame_packing(entry.mode)) {
        ASSERT_FALSE(plan.has_value()) << entry.name;
        EXPECT_THAT(plan.error().message, HasSubstr("exactly"));
        continue;
      }
      ASSERT_TRUE(plan.has_value()) << entry.name;
      EXPECT_EQ(plan->size_px, size) << entry.name;
      EXPECT_EQ(plan->outputs[0].rect.size_px, size) << entry.name;
    }
  }
  EXPECT_EQ(plan_wall(wall, {.mode = StereoMode::FramePacked1080p}).value().size_px, glm::uvec2(1920, 2205));
}

TEST(PictureSize, IsWithinTheDevice) {
  EXPECT_TRUE(check_picture_size({1920, 1080}, 16384).has_value());
  EXPECT_TRUE(check_picture_size({1, 16384}, 16384).has_value());
  for (const glm::uvec2 wrong : {glm::uvec2(0, 5), glm::uvec2(5, 0), glm::uvec2(16385, 1)}) {
    const auto size = check_picture_size(wrong, 16384);
    ASSERT_FALSE(size.has_value());
    EXPECT_EQ(size.error().category, core::ErrorCategory::WrongUsage);
    EXPECT_THAT(size.error().message, HasSubstr("--size"));
  }
}

TEST(DepthReport, WarnsBeyondADegreeAndNamesTheEyesThatWouldDiverge) {
  const DepthReport easy = report_depth({.nearest_m = 2.3, .farthest_m = 2.8}, 2.5, 0.063, Relief::BringToWall);
  EXPECT_FALSE(easy.hard);
  EXPECT_THAT(depth_text(easy, test::english()), HasSubstr("2.30 m to 2.80 m"));
  EXPECT_THAT(depth_text(easy, test::english()), HasSubstr("(-5 mm)"));
  const DepthReport near = report_depth({.nearest_m = 1.0, .farthest_m = 2.5}, 2.5, 0.063, Relief::BringToWall);
  EXPECT_TRUE(near.hard);
  EXPECT_THAT(depth_text(near, test::english()), HasSubstr("beyond 1\u00b0: press B or step back"));
  EXPECT_THAT(
      depth_text(report_depth({.nearest_m = 1.0, .farthest_m = 2.5}, 2.5, 0.063, Relief::NarrowEyes), test::english()),
      HasSubstr("press F7 or step back"))
      << "B changes nothing where the contact is in the wall's plane";
  const DepthReport far = report_depth({.nearest_m = 2.5, .farthest_m = 10.0}, 2.5, 0.063, Relief::BringToWall);
  EXPECT_THAT(depth_text(far, test::english()), HasSubstr("too deep for eyes less than 48 mm apart"));
}

// ---- the comfort clamp ----

constexpr std::int64_t kFrameNs = 16'666'667;
constexpr double kDegree = scene::kComfortableDisparityRad;

TEST(ComfortClamp, KeepsEveryDepthWithinItsLimit) {
  for (const render::DepthRange& range : {render::DepthRange{0.6, 2.5}, {1.0, 30.0}, {0.4, 0.5}}) {
    ComfortClamp clamp(kDegree);
    clamp.measured(range, 2.5, 0.063);
    double ipd_m = 0;
    for (int frame = 1; frame < 60; ++frame) ipd_m = clamp.ipd_m(0.063, frame * kFrameNs);
    EXPECT_LT(ipd_m, 0.063);
    for (const double depth_m : {range.nearest_m, range.farthest_m}) {
      EXPECT_LT(std::abs(scene::disparity_at(2.5, ipd_m, depth_m).crossed_rad), kDegree) << depth_m;
    }
  }
}

TEST(ComfortClamp, LeavesAnEasyPictureAsItIs) {
  ComfortClamp clamp(kDegree);
  clamp.measured({2.2, 3.0}, 2.5, 0.063);
  for (int frame = 1; frame < 60; ++frame) EXPECT_EQ(clamp.ipd_m(0.063, frame * kFrameNs), 0.063);
}

TEST(ComfortClamp, NarrowsSoonWidensSlowlyAndNeverJumps) {
  ComfortClamp clamp(kDegree);
  std::int64_t now = kFrameNs;
  double before = clamp.ipd_m(0.063, now);
  const auto frames_until_still = [&] {
    int frames = 0;
    for (double next = 0;; ++frames, before = next) {
      next = clamp.ipd_m(0.063, now += kFrameNs);
      EXPECT_LT(std::abs(next - before), 0.07 * 0.063);
      if (next == before) return frames;
    }
  };
  clamp.measured({0.5, 2.5}, 2.5, 0.063);
  const int narrowed = frames_until_still();
  clamp.measured({2.4, 2.5}, 2.5, 0.063);
  const int widened = frames_until_still();
  EXPECT_GT(narrowed, 5);
  EXPECT_GT(widened, 4 * narrowed);
  EXPECT_NEAR(before, 0.063, 1e-12);
}

}  // namespace wall_pictures_test
}  // namespace afm::exhibit
