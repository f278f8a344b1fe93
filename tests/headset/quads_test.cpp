// SPDX-License-Identifier: Apache-2.0
// Invariant: a fully visible panel is shown from its texture, any other in the eyes' pictures, and none in both
// Invariant: the depth that a headset gets is the drawn distance
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "headset_fixture.h"

// Panels that the runtime shows itself, and those that stay in the eyes' pictures.
namespace afm::test {
namespace quads_test {

using ::testing::SizeIs;

class HeadsetQuads : public HeadsetTest {
 protected:
  // Quads beside the objects in front of the wall, so that nothing hides them.
  HeadsetQuads() {
    frame_.panels.force.placement.right_m.x = 0.70;
    frame_.panels.data.placement.lower_left_m.x = 0.80;
    frame_.panels.data.placement.right_m.x = 0.68;
  }

  const std::vector<stand_in::SubmittedQuad>& quads() { return log().frames.back().quads; }

  // Expects the runtime to show the quad at this place and size in the room.
  void expect_at(const stand_in::SubmittedQuad& quad, const render::PanelPlacement& placement) {
    const auto& [x, y, z] = quad.pose.position;
    const auto& q = quad.pose.orientation;
    const glm::dquat turn =
        room_from_floor_.room_from_head * glm::dquat(static_cast<double>(q.w), static_cast<double>(q.x),
                                                     static_cast<double>(q.y), static_cast<double>(q.z));
    const glm::dvec3 middle =
        room_from_floor_.position_m + room_from_floor_.room_from_head * glm::dvec3(glm::vec3(x, y, z));
    const glm::dvec3 right = turn * glm::dvec3(static_cast<double>(quad.size.width), 0.0, 0.0);
    const glm::dvec3 up = turn * glm::dvec3(0.0, static_cast<double>(quad.size.height), 0.0);
    EXPECT_LT(glm::distance(right, placement.right_m), 1e-6);
    EXPECT_LT(glm::distance(up, placement.up_m), 1e-6);
    EXPECT_LT(glm::distance(middle - 0.5 * (right + up), placement.lower_left_m), 1e-6);
    EXPECT_EQ(quad.flags, XrCompositionLayerFlags{XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT});
  }

  // Expects a panel's texture to hold its picture on a wall that it fills, where the plate is opaque.
  void expect_texture_of(const stand_in::SubmittedQuad& quad, const render::PanelPlacement& placement,
                         double opaque_share = 0.9) {
    render::Renderer wall = must(render::Renderer::create(*context_, scene_.scene,
                                                          {.eye_width = quad.width,
                                                           .eye_height = quad.height,
                                                           .samples = 1,
                                                           .panel_texels_per_m = kTexelsPerM,
                                                           .panel_contrast = kContrast}));
    const scene::Screen screen{.name = "panel",
                               .lower_left = placement.lower_left_m,
                               .lower_right = placement.lower_left_m + placement.right_m,
                               .upper_left = placement.lower_left_m + placement.up_m};
    const auto eye = scene::off_axis_view(screen, screen.center() + 2.0 * screen.normal(),
                                          scene::DepthConvention::VulkanReversedInfinite, 0.05, 1.0);
    render::FrameState frame = frame_;
    frame.eyes = {*eye, *eye};
    frame.panels_apart = 0;
    frame.visible.assign(frame.room_from_node.size(), 0);
    wall.render(frame);
    const render::Image picture = wall.read_eye(scene::Eye::Left);
    ASSERT_EQ(picture.rgba.size(), quad.bytes.size());
    std::size_t opaque = 0, wrong = 0;
    for (std::size_t i = 0; i < quad.bytes.size(); i += 4) {
      if (quad.bytes[i + 3] != 255) continue;
      ++opaque;
      for (std::size_t c = 0; c < 3; ++c) wrong += std::abs(quad.bytes[i + c] - picture.rgba[i + c]) > 1 ? 1U : 0U;
    }
    EXPECT_EQ(wrong, 0U) << "of " << opaque << " opaque texels";
    EXPECT_GT(static_cast<double>(opaque), opaque_share * static_cast<double>(quad.bytes.size() / 4));
  }

  // The eyes' pictures are those of the frame without these panels.
  void expect_eyes_without(std::initializer_list<render::PanelPlacement*> apart) {
    const render::FrameState kept = frame_;
    const auto bytes = log().frames.back().eyes[0].bytes;
    frame_.panels_apart = 0;
    for (render::PanelPlacement* placement : apart) *placement = render::kNoPlacement;
    renderer_->render(frame_);
    render::Image eye = renderer_->read_eye(scene::Eye::Left);
    for (std::size_t i = 0; i < eye.rgba.size(); i += 4) std::swap(eye.rgba[i], eye.rgba[i + 2]);
    EXPECT_TRUE(eye.rgba == bytes);
    frame_ = kept;
  }

  int count(const char* call) { return static_cast<int>(std::count(log().calls.begin(), log().calls.end(), call)); }
  int acquired_in_a_frame() {
    log().calls.clear();
    EXPECT_TRUE(draw_next());
    return count("xrAcquireSwapchainImage") - 2;  // acquisitions without those for colours and depth of the eyes
  }
};

TEST_F(HeadsetQuads, AreThePanelsThatNothingHidesAtTheirPlaces) {
  connect();
  ASSERT_TRUE(draw_next());
  ASSERT_THAT(quads(), SizeIs(3));
  expect_at(quads()[0], frame_.panels.force.placement);
  expect_at(quads()[1], frame_.panels.data.placement);
  expect_at(quads()[2], frame_.panels.banner.placement);
  expect_eyes_without({&frame_.panels.force.placement, &frame_.panels.data.placement, &frame_.panels.banner.placement});
}

TEST_F(HeadsetQuads, HoldTheTexturesOfThePanels) {
  connect();
  ASSERT_TRUE(draw_next());
  ASSERT_THAT(quads(), SizeIs(3));
  expect_texture_of(quads()[0], frame_.panels.force.placement);
  expect_texture_of(quads()[1], frame_.panels.data.placement);
  expect_texture_of(quads()[2], frame_.panels.banner.placement);
  frame_.panels.banner.content.guidance = "Press Turn-On";
  ASSERT_TRUE(draw_next());
  expect_texture_of(quads()[2], frame_.panels.banner.placement);
}

TEST_F(HeadsetQuads, HoldTheTextureOfEachLabel) {
  frame_.labels.clear();
  for (const auto& [text, x] : {std::pair{"first", -1.2}, {"second", 0.9}}) {
    frame_.labels.push_back(
        {.text = text,
         .highlighted = false,
         .placement = {.lower_left_m = {x, 0.55, 0.0}, .right_m = {0.2, 0.0, 0.0}, .up_m = {0.0, 0.08, 0.0}}});
  }
  connect();
  ASSERT_TRUE(draw_next());
  ASSERT_THAT(quads(), SizeIs(5));
  // the corners of the labels are round
  for (const std::size_t i : {0U, 1U}) expect_texture_of(quads()[2 + i], frame_.labels[i].placement, 0.7);
  expect_texture_of(quads()[4], frame_.panels.banner.placement);
}

TEST_F(HeadsetQuads, StayInTheRoomHoweverTheWearerMoves) {
  room_from_floor_ = {.position_m = {0.3, -1.6, 2.0},
                      .room_from_head = glm::angleAxis(glm::radians(20.0), glm::dvec3(0.0, 1.0, 0.0))};
  script().local_floor = false;
  connect();
  ASSERT_TRUE(draw_next());
  ASSERT_FALSE(quads().empty());
  expect_at(quads().back(), frame_.panels.banner.placement);
}

TEST_F(HeadsetQuads, AreFilledAgainOnlyWhenThePanelIsPaintedAgain) {
  connect();
  ASSERT_TRUE(draw_next());
  EXPECT_EQ(acquired_in_a_frame(), 0);
  const auto before = quads();
  frame_.panels.banner.content.state_word = "no force";
  EXPECT_EQ(acquired_in_a_frame(), 1);
  EXPECT_TRUE(quads()[0].bytes == before[0].bytes);
  EXPECT_TRUE(quads()[2].bytes != before[2].bytes);
  frame_.panels.force.placement.lower_left_m.y += 0.05;
  EXPECT_EQ(acquired_in_a_frame(), 0);
  expect_at(quads()[0], frame_.panels.force.placement);
}

TEST_F(HeadsetQuads, GoAndComeWithTheirPanels) {
  connect();
  ASSERT_TRUE(draw_next());
  const render::PanelPlacement place = std::exchange(frame_.panels.force.placement, render::kNoPlacement);
  ASSERT_TRUE(draw_next());
  ASSERT_THAT(quads(), SizeIs(2));
  frame_.panels.force.placement = place;
  frame_.panels.force.placement.up_m.y = 0.5;
  ASSERT_TRUE(draw_next());
  ASSERT_THAT(quads(), SizeIs(3));
  expect_texture_of(quads()[0], frame_.panels.force.placement);
  log().calls.clear();
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(draw_next());
  EXPECT_EQ(count("xrDestroySwapchain"), 1) << "of the size before";
}

// A panel behind another object must be drawn with the scene to be hidden by it. Covering only a corner does not count.
TEST_F(HeadsetQuads, AreNoneOfThePanelsThatSomethingMayHide) {
  connect();
  const auto ball = [&](const glm::dvec3& place, double size_m) {
    frame_.room_from_node[scene_.gold] =
        glm::translate(glm::dmat4(1.0), place) * glm::scale(glm::dmat4(1.0), glm::dvec3(size_m));
  };
  ball({-0.65, 0.0, 1.0}, 0.05);
  ASSERT_TRUE(draw_next());
  EXPECT_THAT(quads(), SizeIs(3));
  ball({-0.65, 0.0, 1.0}, 0.2);
  ASSERT_TRUE(draw_next());
  ASSERT_THAT(quads(), SizeIs(2));
  expect_at(quads()[0], frame_.panels.data.placement);
  expect_eyes_without({&frame_.panels.data.placement, &frame_.panels.banner.placement});
  frame_.room_from_node[scene_.gold][3].z = -1.0;  // place behind it
  ASSERT_TRUE(draw_next());
  EXPECT_THAT(quads(), SizeIs(3));
  frame_.labels.push_back(
      {.text = "before it",
       .highlighted = false,
       .placement = {.lower_left_m = {1.0, 0.0, 0.0}, .right_m = {0.1, 0.02, 0.0}, .up_m = {0, 0.1, 0}}});
  ASSERT_TRUE(draw_next());
  EXPECT_THAT(quads(), SizeIs(2)) << "a crooked label, which is drawn with the scene, lies before the data";
}

TEST_F(HeadsetQuads, AreSeenFromBeforeThePanelsAlone) {
  connect();
  for (XrPosef& eye : script().eyes) {
    eye.position.z = -5.0F;
    eye.orientation = {0, 1, 0, 0};
  }
  ASSERT_TRUE(draw_next());
  EXPECT_THAT(quads(), SizeIs(0));
}

TEST_F(HeadsetQuads, AreAsManyAsTheRuntimeHasLayersFor) {
  for (const std::uint32_t layers : {0U, 1U, 3U}) {
    script().most_layers = layers;
    connect();
    if (layers == 0) script().most_layers = 1;  // a runtime that says nothing
    ASSERT_TRUE(draw_next());
    ASSERT_THAT(quads(), SizeIs(layers == 3 ? 2 : 0));
    if (layers == 3) {
      expect_at(quads()[0], frame_.panels.force.placement);
      expect_at(quads()[1], frame_.panels.banner.placement);
      expect_eyes_without({&frame_.panels.force.placement, &frame_.panels.banner.placement});
    } else {
      expect_eyes_without({});
    }
    disconnect();
  }
}

TEST_F(HeadsetQuads, AreNoneWhereTheRuntimeTakesNoTextureOfThem) {
  script().formats = {50, 126};
  connect();
  EXPECT_EQ(headset_->most_panels(), 0U);
  ASSERT_TRUE(draw_next());
  expect_eyes_without({});
  disconnect();
  script().formats = {50, 43};
  connect();
  script().failing["xrCreateSwapchain"] = XR_ERROR_LIMIT_REACHED;
  ASSERT_TRUE(draw_next());
  EXPECT_EQ(headset_->most_panels(), 0U);
  ASSERT_TRUE(draw_next());
  EXPECT_THAT(quads(), SizeIs(0));
  expect_eyes_without({});
}

TEST_F(HeadsetQuads, AreLostWithTheSession) {
  connect();
  script().failing["xrCreateSwapchain"] = XR_ERROR_SESSION_LOST;
  ASSERT_TRUE(draw_next());
  EXPECT_FALSE(shown_);
  clock_.go_on(render::Headset::kLookAgainNs);
  EXPECT_EQ(turn(), render::Headset::Turn::Off);
  clock_.go_on(render::Headset::kLookAgainNs);
  ASSERT_TRUE(draw_next());
  EXPECT_THAT(quads(), SizeIs(3));
}

// Reversed infinite depth: of a ball before each eye, through the pixel nearest to its middle.
class HeadsetDepth : public HeadsetTest {
 protected:
  void expect_ball(std::size_t eye) {
    const stand_in::SubmittedEye& shown = log().frames.back().eyes[eye];
    ASSERT_EQ(shown.depths.size(), std::size_t{shown.width} * shown.height);
    EXPECT_TRUE(std::isinf(shown.near_m));
    const glm::dvec3 ball = glm::dvec3(0.0, -0.42, 0.05) - frame_.eyes[eye].eye_position_m;
    const auto tangent = [](float angle) { return std::tan(static_cast<double>(angle)); };
    const double left = tangent(shown.fov.angleLeft), right = tangent(shown.fov.angleRight);
    const double up = tangent(shown.fov.angleUp), down = tangent(shown.fov.angleDown);
    const double x = std::floor((ball.x / -ball.z - left) / (right - left) * shown.width);
    const double y = std::floor((up - ball.y / -ball.z) / (up - down) * shown.height);
    // the first of four samples lies there in its pixel
    const glm::dvec3 ray(left + (x + 0.375) / shown.width * (right - left),
                         up - (y + 0.125) / shown.height * (up - down), -1.0);
    const double a = glm::dot(ray, ray), b = glm::dot(ray, ball);
    const double away_m = (b - std::sqrt(b * b - a * (glm::dot(ball, ball) - 0.13 * 0.13))) / a;
    const float depth = shown.depths[static_cast<std::size_t>(y) * shown.width + static_cast<std::size_t>(x)];
    EXPECT_NEAR(static_cast<double>(shown.far_m) / static_cast<double>(depth) / away_m, 1.0, 1e-3) << away_m;
  }
};

TEST_F(HeadsetDepth, IsTheDrawnDistance) {
  connect();
  for (const float before_wall_m : {0.35F, 1.0F, 2.5F, 6.0F}) {
    for (XrPosef& eye : script().eyes) {
      eye.position.y = 1.18F;
      eye.position.z = before_wall_m - 2.5F;
    }
    ASSERT_TRUE(draw_next());
    for (const std::size_t eye : {0U, 1U}) expect_ball(eye);
  }
}

TEST_F(HeadsetDepth, IsLeftOutWhereTheRuntimeHasNoUseForIt) {
  for (const bool extension : {false, true}) {
    script().depth = extension;
    script().formats = {50, 43};
    if (!extension) script().formats.push_back(126);
    connect();
    ASSERT_TRUE(draw_next());
    for (const auto& eye : log().frames.back().eyes) EXPECT_THAT(eye.depths, SizeIs(0));
    disconnect();
  }
}

TEST_F(HeadsetDepth, ComesInTwoImagesWhereArraysAreRefused) {
  script().two_layers = false;
  connect();
  ASSERT_TRUE(draw_next());
  for (const std::size_t eye : {0U, 1U}) expect_ball(eye);
}

}  // namespace quads_test
}  // namespace afm::test
