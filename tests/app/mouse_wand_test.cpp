// SPDX-License-Identifier: Apache-2.0
#include "app/mouse_wand.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/panel_hit.h"

namespace afm::app {
namespace {

constexpr double kExact = 1e-12;

class MouseWandTest : public ::testing::Test {
 protected:
  WallPicture picture(scene::StereoMode layout) const {
    return {.place = {.offset_px = {100, 50}, .size_px = {800, 600}}, .composition = {.mode = layout}, .eyes = eyes_};
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
  const auto hit = hit_of(towards({0.1, 1.3, 0.0}), panel);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->place_mm.x, 100.0, 1e-9);
  EXPECT_NEAR(hit->place_mm.y, 100.0, 1e-9);
  EXPECT_FALSE(hit_of(towards({-0.01, 1.3, 0.0}), panel));
  EXPECT_FALSE(hit_of(towards({0.1, 1.41, 0.0}), panel));
  EXPECT_FALSE(hit_of(towards({0.1, 1.3, 5.0}), panel)) << "behind the eye";
  EXPECT_FALSE(hit_of(towards({0.1, 1.3, 0.0}), render::kNoPlacement));
}

}  // namespace
}  // namespace afm::app
