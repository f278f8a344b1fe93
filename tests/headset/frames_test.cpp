// SPDX-License-Identifier: Apache-2.0
// Invariant: a headset gets the renderer's eyes byte for byte, with the poses they were drawn for
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "headset_fixture.h"

// Pictures received by a headset, byte for byte, because the stand-in's images are on the same device.
namespace afm::test {
namespace frames_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kBgraSrgb = 50, kRgbaSrgb = 43;

// Contents of the eye's image in the order of the runtime's format.
std::vector<std::uint8_t> in_order_of(std::int64_t format, const render::Image& image) {
  std::vector<std::uint8_t> bytes = image.rgba;
  for (std::size_t i = 0; format == kBgraSrgb && i < bytes.size(); i += 4) std::swap(bytes[i], bytes[i + 2]);
  return bytes;
}

class HeadsetFrames : public HeadsetTest {
 protected:
  // The newest frame is the renderer's, left eye first; every way to lend images must come to this.
  void expect_the_renderers_eyes(std::int64_t format) {
    const auto& frame = log().frames.back();
    ASSERT_THAT(frame.eyes, SizeIs(2));
    for (const scene::Eye eye : scene::kEyes) {
      const auto& shown = frame.eyes[eye == scene::Eye::Left ? 0 : 1];
      const render::Image drawn = renderer_->read_eye(eye);
      EXPECT_EQ(shown.format, format);
      ASSERT_EQ(shown.width, drawn.width);
      ASSERT_EQ(shown.height, drawn.height);
      EXPECT_TRUE(shown.bytes == in_order_of(format, drawn)) << "eye " << static_cast<int>(eye);
    }
    EXPECT_TRUE(frame.eyes[0].bytes != frame.eyes[1].bytes) << "both eyes see the same";
  }
};

TEST_F(HeadsetFrames, AreTheRenderersEyesWithThePosesTheyWereDrawnFor) {
  connect();
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(draw_next());
    expect_the_renderers_eyes(kBgraSrgb);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const auto& shown = log().frames.back().eyes[eye];
      EXPECT_EQ(shown.layer, eye);
      EXPECT_EQ(shown.fov.angleLeft, script().fovs[eye].angleLeft);
      EXPECT_EQ(shown.fov.angleUp, script().fovs[eye].angleUp);
      EXPECT_EQ(shown.pose.position.x, script().eyes[eye].position.x);
      EXPECT_EQ(shown.pose.position.y, script().eyes[eye].position.y);
      EXPECT_NEAR(frame_.eyes[eye].eye_position_m.x, static_cast<double>(shown.pose.position.x), 1e-6);
    }
    for (XrPosef& eye : script().eyes) eye.position.x += 0.01F;
  }
}

TEST_F(HeadsetFrames, AreSwappedWhenTheEyesAre) {
  connect();
  ASSERT_TRUE(draw_next());
  const auto straight = log().frames.back();
  std::swap(script().eyes[0], script().eyes[1]);
  std::swap(script().fovs[0], script().fovs[1]);
  ASSERT_TRUE(draw_next());
  const auto swapped = log().frames.back();
  EXPECT_TRUE(swapped.eyes[0].bytes == straight.eyes[1].bytes);
  EXPECT_TRUE(swapped.eyes[1].bytes == straight.eyes[0].bytes);
}

TEST_F(HeadsetFrames, HoldTheSameBytesInTheOtherOrder) {
  script().formats = {91, kRgbaSrgb};
  connect();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(draw_next());
  expect_the_renderers_eyes(kRgbaSrgb);
}

TEST_F(HeadsetFrames, HoldTheSameBytesInOneImageAndInFour) {
  for (const std::uint32_t images : {1U, 4U}) {
    script().images = images;
    connect();
    for (int i = 0; i < 6; ++i) {
      ASSERT_TRUE(draw_next());
      expect_the_renderers_eyes(kBgraSrgb);
    }
    disconnect();
  }
}

TEST_F(HeadsetFrames, HoldTheSameBytesWhereArraysAreRefused) {
  script().two_layers = false;
  connect();
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(draw_next());
  expect_the_renderers_eyes(kBgraSrgb);
  for (const auto& eye : log().frames.back().eyes) EXPECT_EQ(eye.layer, 0U);
}

TEST_F(HeadsetFrames, AreCalledForInTheOrderOfTheSpecification) {
  connect();
  ASSERT_TRUE(draw_next());
  log().calls.clear();
  ASSERT_TRUE(draw_next());
  std::erase(log().calls, "xrLocateSpace");
  EXPECT_THAT(log().calls,
              ElementsAre("xrWaitFrame", "xrBeginFrame", "xrSyncActions", "xrAcquireSwapchainImage",
                          "xrWaitSwapchainImage", "xrAcquireSwapchainImage", "xrWaitSwapchainImage", "xrLocateViews",
                          "xrReleaseSwapchainImage", "xrReleaseSwapchainImage", "xrEndFrame"))
      << "colours and depth; nothing is waited for between the place of the eyes and their picture";
}

// A place of the eyes that is as old as a wait is another picture than the one before them.
TEST_F(HeadsetFrames, AreDrawnForThePlaceOfTheEyesAfterEveryWait) {
  connect();
  script().lends = false;
  beats_ = 0;
  lends_after_beats_ = 20;
  ASSERT_TRUE(draw_next());
  EXPECT_TRUE(shown_);
  EXPECT_GE(beats_, 20);
  EXPECT_EQ(headset_->pose_age_ns(), 0) << "on a clock that only a wait moves";
}

TEST_F(HeadsetFrames, HaveNoLayerWhereNobodySeesThem) {
  connect();
  ASSERT_TRUE(draw_next());
  script().should_render = false;
  EXPECT_EQ(turn(), render::Headset::Turn::Hidden);
  EXPECT_THAT(log().frames.back().eyes, IsEmpty());
  script().should_render = true;
  EXPECT_TRUE(draw_next());
}

TEST_F(HeadsetFrames, HaveNoLayerWhileTheHeadIsNotTracked) {
  connect();
  ASSERT_TRUE(draw_next());
  script().tracked = false;
  EXPECT_FALSE(draw_next());
  EXPECT_THAT(log().frames.back().eyes, IsEmpty());
}

TEST_F(HeadsetFrames, HaveNoLayerForAPoseThatNoHeadHas) {
  connect();
  script().eyes[1].orientation = {0, 0, 0, 0};
  EXPECT_FALSE(draw_next());
  EXPECT_THAT(log().frames.back().eyes, IsEmpty());
}

TEST_F(HeadsetFrames, AFrameThatNobodyDrawsIsEndedWithoutALayer) {
  connect();
  ASSERT_TRUE(draw_next());
  ASSERT_EQ(turn(), render::Headset::Turn::Frame);
  ASSERT_EQ(turn(), render::Headset::Turn::Frame);
  EXPECT_THAT(log().frames.back().eyes, IsEmpty());
  EXPECT_TRUE(draw_next());
}

// The room's floor is the runtime's, in any reference space: with eyes 1.6 m above it, the room is 1.6 m lower.
TEST_F(HeadsetFrames, TakeTheFloorFromTheRuntime) {
  struct Case {
    bool local_floor, stage;
    double eye_m;
    const char* said;
  };
  for (const Case& c : {Case{true, true, 1.6, "as the runtime has it"}, Case{false, true, 1.6, "the play area"},
                        Case{false, false, 1.6 - 1.5 + 1.65, "1.65 m below"}}) {
    script().local_floor = c.local_floor;
    script().stage = c.stage;
    connect();
    const auto eyes = draw_next();
    ASSERT_TRUE(eyes);
    EXPECT_NEAR((*eyes)[0].pose.position_m.y, room_from_floor_.position_m.y + c.eye_m, 1e-3);
    EXPECT_THAT(messages(), HasSubstr(c.said));
    disconnect();
  }
}

TEST_F(HeadsetFrames, FollowARecentring) {
  script().local_floor = false;
  connect();
  ASSERT_TRUE(draw_next());
  script().local_height_m = 1.1F;
  stand_in::stand_in().recentered = true;
  const auto eyes = draw_next();
  ASSERT_TRUE(eyes);
  EXPECT_NEAR((*eyes)[0].pose.position_m.y, room_from_floor_.position_m.y + 1.6, 1e-3);
}

TEST_F(HeadsetFrames, ComeWithTheControllerThatWasUsedLast) {
  room_from_floor_ = {.position_m = {1.0, 0.0, 2.0},
                      .room_from_head = glm::angleAxis(glm::radians(90.0), glm::dvec3(0.0, 1.0, 0.0))};
  connect();
  while (!headset_->controller().connected) ASSERT_TRUE(draw_next());
  const auto right = headset_->controller();
  EXPECT_TRUE(right.place_valid);
  // 0.2 m to the right and 0.3 m ahead, in a room that is turned to the left by a right angle
  EXPECT_LT(glm::distance(right.position_m, glm::dvec3(1.0 - 0.3, 1.2, 2.0 - 0.2)), 1e-6);
  EXPECT_LT(glm::distance(right.room_from_controller * glm::dvec3(0, 0, -1), glm::dvec3(-1, 0, 0)), 1e-6);
  EXPECT_FALSE(right.select || right.grab || right.scale || right.home);
  script().pressed[0] = {"select", "home"};
  script().stick = {0.5F, -1.0F};
  ASSERT_TRUE(draw_next());
  const auto left = headset_->controller();
  EXPECT_TRUE(left.select && left.home);
  EXPECT_LT(glm::distance(left.position_m, glm::dvec3(1.0 - 0.3, 1.2, 2.0 + 0.2)), 1e-6);
  EXPECT_EQ(left.fly, glm::dvec2(0.5, -1.0));
  script().controllers = false;
  ASSERT_TRUE(draw_next());
  EXPECT_FALSE(headset_->controller().connected);
  headset_->pulse();
  EXPECT_EQ(log().pulses, 1);
}

}  // namespace frames_test
}  // namespace afm::test
