// SPDX-License-Identifier: Apache-2.0
#include "app/display/mouse_wand.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>

#include "exhibit/panels/panel_hit.h"

namespace afm::app {
namespace mouse_wand_test {

constexpr double kExact = 1e-12;

class MouseWandTest : public ::testing::Test {
 protected:
  WallPicture picture(scene::StereoMode layout) const {
    return {.place = {.offset_px = {100, 50}, .size_px = {800, 600}},
            .composition = {.mode = layout},
            .eyes = eyes_,
            .screen = screen_};
  }
  glm::dvec3 on_wall(scene::StereoMode layout, const glm::dvec2& cursor_px) const {
    return wand_.wall_point(wand_.ray(picture(layout), cursor_px));
  }

  const scene::Screen screen_{"wall", {-2.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {-2.0, 3.0, 0.0}};
  const std::array<scene::EyeView, 2> eyes_{scene::EyeView{.eye_position_m = {-0.03, 1.6, 2.5}},
                                            scene::EyeView{.eye_position_m = {0.03, 1.6, 2.5}}};
  const MouseWand wand_{screen_, {0.5, 1.2, 1.0}};
};

TEST_F(MouseWandTest, TheCornersOfThePictureAreTheCornersOfTheWall) {
  for (const auto layout : {scene::StereoMode::Left, scene::StereoMode::Right}) {
    EXPECT_LT(glm::distance(on_wall(layout, {100.0, 50.0}), screen_.upper_left), kExact);
    EXPECT_LT(glm::distance(on_wall(layout, {900.0, 650.0}), screen_.lower_right), kExact);
    EXPECT_LT(glm::distance(on_wall(layout, {500.0, 350.0}), screen_.center()), kExact);
  }
}

TEST_F(MouseWandTest, EachHalfOfSideBySideIsAWallSeenByItsOwnEye) {
  const WallPicture both = picture(scene::StereoMode::SideBySide);
  EXPECT_LT(glm::distance(on_wall(scene::StereoMode::SideBySide, {300.0, 350.0}), screen_.center()), kExact);
  EXPECT_LT(glm::distance(on_wall(scene::StereoMode::SideBySide, {700.0, 350.0}), screen_.center()), kExact);
  EXPECT_EQ(wand_.ray(both, {300.0, 350.0}).origin_m, eyes_[0].eye_position_m);
  EXPECT_EQ(wand_.ray(both, {700.0, 350.0}).origin_m, eyes_[1].eye_position_m);
}

// A point in front of the wall, pointed at where each eye's image shows it: the ray meets the point itself, in every
// mode with a separate region for each eye.
TEST_F(MouseWandTest, WhatTheCursorIsOnIsPointedAtInEveryModeThatSplitsThePicture) {
  const glm::dvec3 point(0.4, 1.2, 0.9);
  const auto uv_of = [&](std::size_t eye) {  // place in the eye's image
    const glm::dvec3 from = eyes_[eye].eye_position_m;
    const glm::dvec3 on_wall = from + (point - from) * (-from.z / (point.z - from.z));
    return glm::dvec2((on_wall.x + 2.0) / 4.0, (3.0 - on_wall.y) / 3.0);
  };
  struct Region {
    scene::StereoMode mode;
    std::array<glm::dvec2, 2> first;  // shares of the picture, by eye
    glm::dvec2 size;
  };
  const double lines = 1470.0;
  const std::array regions{
      Region{scene::StereoMode::SideBySide, {glm::dvec2(0, 0), glm::dvec2(0.5, 0)}, {0.5, 1}},
      Region{scene::StereoMode::SideBySideHalf, {glm::dvec2(0, 0), glm::dvec2(0.5, 0)}, {0.5, 1}},
      Region{scene::StereoMode::TopBottom, {glm::dvec2(0, 0), glm::dvec2(0, 0.5)}, {1, 0.5}},
      Region{scene::StereoMode::TopBottomHalf, {glm::dvec2(0, 0), glm::dvec2(0, 0.5)}, {1, 0.5}},
      Region{scene::StereoMode::FramePacked720p, {glm::dvec2(0, 0), glm::dvec2(0, 750.0 / lines)}, {1, 720.0 / lines}}};
  for (const Region& region : regions) {
    for (const auto order : {scene::EyeOrder::Straight, scene::EyeOrder::Swapped}) {
      WallPicture shown = picture(region.mode);
      shown.composition.order = order;
      for (std::size_t place = 0; place < 2; ++place) {
        const std::size_t eye = order == scene::EyeOrder::Swapped ? 1 - place : place;
        const glm::dvec2 share = region.first[place] + region.size * uv_of(eye);
        const glm::dvec2 cursor = glm::dvec2(shown.place.offset_px) + share * glm::dvec2(shown.place.size_px);
        const input::Ray ray = wand_.ray(shown, cursor);
        EXPECT_EQ(ray.origin_m, eyes_[eye].eye_position_m) << scene::name_of(region.mode);
        const glm::dvec3 to = point - ray.origin_m;
        // a window's pixel of a packed picture shows the nearest of its lines
        EXPECT_LT(glm::length(to - glm::dot(to, ray.direction) * ray.direction), 5e-3) << scene::name_of(region.mode);
      }
    }
  }
}

TEST_F(MouseWandTest, WhereBothEyesShareThePictureItPointsFromTheirMiddle) {
  const glm::dvec3 middle = 0.5 * (eyes_[0].eye_position_m + eyes_[1].eye_position_m);
  for (const auto mode : {scene::StereoMode::Row, scene::StereoMode::Column, scene::StereoMode::Checkerboard,
                          scene::StereoMode::AnaglyphRedCyan}) {
    for (const double x : {300.0, 301.0}) {
      const input::Ray ray = wand_.ray(picture(mode), {x, 350.0});
      EXPECT_EQ(ray.origin_m, middle) << scene::name_of(mode);
    }
    EXPECT_LT(glm::distance(on_wall(mode, {500.0, 350.0}), screen_.center()), kExact);
  }
}

TEST_F(MouseWandTest, AProjectorsKeystoneIsPointedThrough) {
  WallPicture shown = picture(scene::StereoMode::Left);
  shown.composition.picture_from_output = glm::inverse(glm::dmat3(0.8, 0.1, 0.05, 0.0, 0.7, 0.0, 0.1, 0.15, 1.0));
  for (const glm::dvec2 share : {glm::dvec2(0.0, 0.0), glm::dvec2(0.3, 0.9), glm::dvec2(1.0, 1.0)}) {
    const glm::dvec3 on_output = glm::inverse(shown.composition.picture_from_output) * glm::dvec3(share, 1.0);
    const glm::dvec2 cursor = glm::dvec2(100.0, 50.0) + glm::dvec2(on_output) / on_output.z * glm::dvec2(800.0, 600.0);
    const glm::dvec3 expected(-2.0 + 4.0 * share.x, 3.0 - 3.0 * share.y, 0.0);
    EXPECT_LT(glm::distance(wand_.wall_point(wand_.ray(shown, cursor)), expected), 1e-9);
  }
}

TEST_F(MouseWandTest, AWarpMeshIsPointedThrough) {
  WallPicture shown = picture(scene::StereoMode::Left);
  shown.composition.warp = std::make_shared<const scene::WarpMesh>(
      scene::WarpMesh{2, 2, {{{0, 0}, {0.2, 0.1}}, {{1, 0}, {0.8, 0.1}}, {{0, 1}, {0.2, 0.9}}, {{1, 1}, {0.8, 0.9}}}});
  for (const glm::dvec2 output : {glm::dvec2(0.0, 0.0), glm::dvec2(0.3, 0.9), glm::dvec2(1.0, 1.0)}) {
    const glm::dvec2 cursor = glm::dvec2(100.0, 50.0) + output * glm::dvec2(800.0, 600.0);
    const glm::dvec3 expected(-2.0 + 4.0 * (0.2 + 0.6 * output.x), 3.0 - 3.0 * (0.1 + 0.8 * output.y), 0.0);
    EXPECT_LT(glm::distance(wand_.wall_point(wand_.ray(shown, cursor)), expected), 1e-9);
  }
}

TEST_F(MouseWandTest, EachWindowPointsOntoItsOwnScreen) {
  WallPicture shown = picture(scene::StereoMode::Right);
  shown.screen = {"side", {2.0, 0.0, 0.0}, {2.0, 0.0, 4.0}, {2.0, 3.0, 0.0}};
  const input::Ray ray = wand_.ray(shown, {500.0, 350.0});
  EXPECT_LT(glm::distance(ray.origin_m + glm::distance(shown.screen.center(), ray.origin_m) * ray.direction,
                          shown.screen.center()),
            kExact);
}

TEST_F(MouseWandTest, TheDrawnWandPointsFromItsGripAtTheTarget) {
  const glm::dvec3 target(-1.0, 2.0, 0.0);
  const input::Ray ray = input::ray_of(wand_.towards(target, 7));
  EXPECT_LT(glm::distance(ray.origin_m + glm::distance(target, ray.origin_m) * ray.direction, target), 1e-9);
}

TEST_F(MouseWandTest, ARayHitsAPanelWhereItIsAndNothingBesideIt) {
  const render::PanelPlacement panel{
      .lower_left_m = {0.0, 1.0, 0.0}, .right_m = {0.5, 0.0, 0.0}, .up_m = {0.0, 0.4, 0.0}};
  const auto towards = [](const glm::dvec3& point) {
    const glm::dvec3 eye(0.0, 1.6, 2.5);
    return input::Ray{.origin_m = eye, .direction = glm::normalize(point - eye)};
  };
  const auto hit = exhibit::hit_of(towards({0.1, 1.3, 0.0}), panel, 1e-3);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->place_mm.x, 100.0, 1e-9);
  EXPECT_NEAR(hit->place_mm.y, 100.0, 1e-9);
  EXPECT_NEAR(exhibit::hit_of(towards({0.1, 1.3, 0.0}), panel, 0.5e-3)->place_mm.x, 200.0, 1e-9) << "on a smaller wall";
  EXPECT_FALSE(exhibit::hit_of(towards({-0.01, 1.3, 0.0}), panel, 1e-3));
  EXPECT_FALSE(exhibit::hit_of(towards({0.1, 1.41, 0.0}), panel, 1e-3));
  EXPECT_FALSE(exhibit::hit_of(towards({0.1, 1.3, 5.0}), panel, 1e-3)) << "behind the eye";
  EXPECT_FALSE(exhibit::hit_of(towards({0.1, 1.3, 0.0}), render::kNoPlacement, 1e-3));
}

}  // namespace mouse_wand_test
}  // namespace afm::app
