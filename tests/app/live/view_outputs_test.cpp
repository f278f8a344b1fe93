// SPDX-License-Identifier: Apache-2.0
#include "app/display/view_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace afm::app {
namespace view_outputs_test {

using scene::Eye;
using scene::EyeOrder;
using scene::StereoMode;
using ::testing::AllOf;
using ::testing::HasSubstr;

scene::Output output_on(const std::string& name, const std::string& monitor, std::size_t screen = 0) {
  scene::Output output;
  output.name = name;
  output.screen = screen;
  output.monitor = monitor;
  return output;
}

class ViewOutputsTest : public ::testing::Test {
 protected:
  ViewOutputsTest() {
    wall_.screens = {stage_};
    wall_.viewers = {{}};
    wall_.outputs = {output_on("left projector", "DP-1"), output_on("right projector", "")};
    scene::Output &left = wall_.outputs[0], &right = wall_.outputs[1];
    left.mode = right.mode = StereoMode::Dual;
    left.eye = Eye::Left;
    right.eye = Eye::Right;
    right.order = EyeOrder::Swapped;
    right.rect = {{800, 0}, {800, 600}};
    right.picture_from_output = glm::dmat3(2.0);
    left.warp = std::make_shared<const scene::WarpMesh>();
    left.blend = std::make_shared<const scene::Blend>();
  }
  auto plan(const exhibit::PictureOptions& options = {}, const WindowOptions& window = {}) const {
    return plan_view(wall_, stage_, options, window, monitors_);
  }

  const scene::Screen stage_{"wall", {-2.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {-2.0, 3.0, 0.0}};
  std::vector<render::Monitor> monitors_{{"DP-1", {{0, 0}, {800, 600}}, 60.0}, {"DP-2", {{800, 0}, {800, 600}}, 60.0}};
  scene::Wall wall_;
};

TEST_F(ViewOutputsTest, EachOutputOpensInItsPlaceWithItsEyeItsOrderAndItsKeystone) {
  const auto outputs = plan().value();
  ASSERT_EQ(outputs.size(), 2U);
  EXPECT_EQ(outputs[0].window.monitor, "DP-1");
  EXPECT_FALSE(outputs[0].window.rect.has_value());
  EXPECT_EQ(outputs[1].window.rect.value().offset_px, glm::ivec2(800, 0));
  EXPECT_EQ(outputs[1].fit, render::PictureFit::Fill);
  const auto left = outputs[0].composition({}, EyeOrder::Straight),
             right = outputs[1].composition({}, EyeOrder::Straight);
  EXPECT_EQ(left.mode, StereoMode::Left);
  EXPECT_EQ(left.order, EyeOrder::Straight);
  EXPECT_EQ(left.picture_from_output, glm::dmat3(1.0));
  EXPECT_EQ(right.mode, StereoMode::Right);
  EXPECT_EQ(right.order, EyeOrder::Swapped);
  EXPECT_EQ(right.picture_from_output, glm::dmat3(2.0));
  EXPECT_EQ(left.warp, wall_.outputs[0].warp);
  EXPECT_EQ(left.blend, wall_.outputs[0].blend);
  EXPECT_FALSE(right.warp || right.blend);
}

TEST_F(ViewOutputsTest, EyesThatAreSwappedTwiceAreStraightAndAnotherModeIsForAllOutputs) {
  const auto outputs = plan({.mode = {}, .order = EyeOrder::Swapped}).value();
  EXPECT_EQ(outputs[0].composition({}, EyeOrder::Straight).order, EyeOrder::Swapped);
  EXPECT_EQ(outputs[1].composition({}, EyeOrder::Straight).order, EyeOrder::Straight);
  EXPECT_EQ(outputs[1].composition({}, EyeOrder::Swapped).order, EyeOrder::Swapped);
  for (const ViewOutput& output : outputs) {
    EXPECT_EQ(output.composition(StereoMode::Row, EyeOrder::Straight).mode, StereoMode::Row);
  }
}

TEST_F(ViewOutputsTest, EachTileKeepsItsOwnScreen) {
  wall_.screens.push_back({"side", {2.0, 0.0, 0.0}, {2.0, 0.0, 4.0}, {2.0, 3.0, 0.0}});
  wall_.outputs = {output_on("a", "1"), output_on("b", "2", 1)};
  const auto outputs = plan().value();
  EXPECT_EQ(outputs[0].screen.name, "wall");
  EXPECT_EQ(outputs[1].screen.name, "side");
  EXPECT_EQ(outputs[1].window.monitor, "DP-2");  // monitor with that number
}

// Wayland names a monitor by its make.
TEST_F(ViewOutputsTest, TwoMonitorsOfOneNameDifferByTheirNumbers) {
  for (render::Monitor& monitor : monitors_) monitor.name = "ACME projector";
  wall_.outputs = {output_on("a", "1"), output_on("b", "2")};
  const auto outputs = plan().value();
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    EXPECT_EQ(outputs[i].window.monitor, "ACME projector");
    EXPECT_EQ(outputs[i].window.monitor_corner, monitors_.at(i).rect.offset_px);
  }
}

TEST_F(ViewOutputsTest, AMonitorThatIsNotThereIsNamedWithThoseThatAre) {
  wall_.outputs[0].monitor = "HDMI-7";
  const auto missing = plan();
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_THAT(missing.error().message, AllOf(HasSubstr("output \"left projector\""), HasSubstr("no monitor \"HDMI-7\""),
                                             HasSubstr("1 DP-1 (800 x 600 at 0, 0), 2 DP-2 (800 x 600 at 800, 0)")));
  for (const char* const number : {"0", "3", "-1", "1 ", ""}) {
    wall_.outputs[0].monitor = number;
    wall_.outputs[0].rect = {{5000, 0}, {10, 10}};  // used if no monitor is named
    EXPECT_FALSE(plan().has_value()) << number;
  }
}

TEST_F(ViewOutputsTest, ARectangleThatNoMonitorShowsIsRefusedAndOneAcrossTwoIsNot) {
  wall_.outputs[1].rect = {{400, 0}, {800, 600}};
  EXPECT_TRUE(plan().has_value());
  for (const scene::PixelRect& rect : {scene::PixelRect{{801, 0}, {800, 600}}, scene::PixelRect{{-1, 0}, {800, 600}},
                                       scene::PixelRect{{800, 1}, {800, 600}}}) {
    wall_.outputs[1].rect = rect;
    const auto beyond = plan();
    ASSERT_FALSE(beyond.has_value());
    EXPECT_EQ(beyond.error().category, core::ErrorCategory::DeviceMissing);
    EXPECT_THAT(beyond.error().message, AllOf(HasSubstr("right projector"), HasSubstr("use --size to show")));
  }
}

TEST_F(ViewOutputsTest, ASizeAMonitorOrFullScreenIsOneWindowOfTheStage) {
  for (const WindowOptions& options :
       {WindowOptions{.size_px = glm::uvec2(640, 480), .monitor = {}}, WindowOptions{.size_px = {}, .monitor = "DP-2"},
        WindowOptions{.size_px = {}, .monitor = {}, .full_screen = true}}) {
    const auto outputs = plan({}, options).value();
    ASSERT_EQ(outputs.size(), 1U);
    EXPECT_EQ(outputs[0].composition({}, EyeOrder::Straight).mode, StereoMode::SideBySide);  // pair of projectors
    EXPECT_EQ(outputs[0].picture_from_output, glm::dmat3(1.0));
    EXPECT_EQ(outputs[0].window.monitor, options.monitor);
    EXPECT_EQ(outputs[0].window.full_screen, options.full_screen);
  }
  wall_.outputs.clear();
  EXPECT_EQ(plan().value().size(), 1U);
  const auto pair = plan({.mode = StereoMode::Dual}).value();
  ASSERT_EQ(pair.size(), 2U);
  EXPECT_EQ(pair[1].composition({}, EyeOrder::Straight).mode, StereoMode::Right);
  const auto missing = plan({}, {.size_px = {}, .monitor = "TV"});
  EXPECT_THAT(missing.error().message, HasSubstr("--monitor: there is no monitor \"TV\""));
}

TEST_F(ViewOutputsTest, DualNeedsAnEyeForEachOutput) {
  wall_.outputs = {output_on("tile", "DP-1")};
  const auto dual = plan({.mode = StereoMode::Dual});
  ASSERT_FALSE(dual.has_value());
  EXPECT_EQ(dual.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(dual.error().message, HasSubstr("\"tile\""));
}

}  // namespace view_outputs_test
}  // namespace afm::app
