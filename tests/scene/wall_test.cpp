// SPDX-License-Identifier: Apache-2.0
// Invariant: points on the wall have no parallax; nearer is crossed
// Invariant: an impossible head position does not move the picture
#include "scene/display/wall.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "support/stereo_cases.h"

namespace afm::scene {
namespace wall_test {

using test::StereoCase;
using ::testing::HasSubstr;

// ---- the research's test vectors, rows frustum, probe, eyes and parallax of stereo_cases.csv ----

DepthConvention convention_of(const std::string& name) {
  static const std::map<std::string, DepthConvention> conventions{
      {"vk01", DepthConvention::Vulkan},
      {"vk_revz", DepthConvention::VulkanReversed},
      {"vk_revz_inf", DepthConvention::VulkanReversedInfinite},
      {"vk01_yup", DepthConvention::VulkanYUp},
      {"gl", DepthConvention::OpenGl}};
  return conventions.at(name);
}

glm::dvec3 vec3(const std::vector<double>& v, std::size_t at) { return {v[at], v[at + 1], v[at + 2]}; }

Screen screen_of(const std::vector<double>& v) {
  return {.name = "case", .lower_left = vec3(v, 0), .lower_right = vec3(v, 3), .upper_left = vec3(v, 6)};
}

void expect_row_major_near(const glm::dmat4& m, const std::vector<double>& expected, std::size_t at, const char* what) {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double e = expected[at + static_cast<std::size_t>(4 * row + column)];
      EXPECT_NEAR(m[column][row], e, std::max(1e-12, 1e-9 * std::abs(e)))
          << what << " row " << row << " column " << column;
    }
  }
}

std::string case_name(const ::testing::TestParamInfo<StereoCase>& info) { return info.param.id; }

class FrustumRow : public ::testing::TestWithParam<StereoCase> {};

TEST_P(FrustumRow, MatchesProjectionViewAndProduct) {
  const StereoCase& c = GetParam();
  const auto view =
      off_axis_view(screen_of(c.inputs), vec3(c.inputs, 9), convention_of(c.convention), c.inputs[12], c.inputs[13]);
  ASSERT_TRUE(view.has_value()) << view.error().message;
  expect_row_major_near(view->projection, c.expected, 0, "projection");
  expect_row_major_near(view->view, c.expected, 16, "view");
  expect_row_major_near(view->projection * view->view, c.expected, 32, "product");
}

INSTANTIATE_TEST_SUITE_P(Stereo, FrustumRow, ::testing::ValuesIn(test::stereo_cases("frustum")), case_name);

class ProbeRow : public ::testing::TestWithParam<StereoCase> {};

TEST_P(ProbeRow, ProjectsThePointToItsPlaceOnTheWall) {
  const StereoCase& c = GetParam();
  const auto view =
      off_axis_view(screen_of(c.inputs), vec3(c.inputs, 9), convention_of(c.convention), c.inputs[12], c.inputs[13]);
  ASSERT_TRUE(view.has_value()) << view.error().message;
  const glm::dvec4 clip = view->projection * view->view * glm::dvec4(vec3(c.inputs, 14), 1.0);
  const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(ndc[i], c.expected[static_cast<std::size_t>(i)], 1e-9);
  EXPECT_NEAR(0.5 * (ndc.x + 1.0), c.expected[3], 1e-9);
  const bool y_up = c.convention == "gl" || c.convention == "vk01_yup";
  EXPECT_NEAR(0.5 * ((y_up ? -ndc.y : ndc.y) + 1.0), c.expected[4], 1e-9);
  EXPECT_NEAR(clip.w, c.expected[5], 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Stereo, ProbeRow, ::testing::ValuesIn(test::stereo_cases("probe")), case_name);

class EyesRow : public ::testing::TestWithParam<StereoCase> {};

TEST_P(EyesRow, FollowTheHeadsPositionAndOrientation) {
  const std::vector<double>& in = GetParam().inputs;
  const HeadPose head{.position_m = vec3(in, 0), .room_from_head = glm::dquat(in[6], in[3], in[4], in[5])};
  const glm::dvec3 left = eye_position(head, Eye::Left, in[7], vec3(in, 8));
  const glm::dvec3 right = eye_position(head, Eye::Right, in[7], vec3(in, 8));
  EXPECT_LT(glm::distance(left, vec3(GetParam().expected, 0)), 1e-12);
  EXPECT_LT(glm::distance(right, vec3(GetParam().expected, 3)), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Stereo, EyesRow, ::testing::ValuesIn(test::stereo_cases("eyes")), case_name);

// Place of a point on the wall, in pixels from its upper left corner.
glm::dvec2 pixel(const Screen& screen, const glm::dvec3& eye, const glm::dvec3& point, double width, double height) {
  const auto view = off_axis_view(screen, eye, DepthConvention::VulkanReversedInfinite, 0.1, 0.0);
  const glm::dvec4 clip = view.value().projection * view.value().view * glm::dvec4(point, 1.0);
  return {0.5 * (clip.x / clip.w + 1.0) * width, 0.5 * (clip.y / clip.w + 1.0) * height};
}

class ParallaxRow : public ::testing::TestWithParam<StereoCase> {};

TEST_P(ParallaxRow, PutsBothEyesImagesWhereTheyBelong) {
  const std::vector<double>& in = GetParam().inputs;
  const std::vector<double>& expected = GetParam().expected;
  const Screen screen = screen_of(in);
  const glm::dvec2 left = pixel(screen, vec3(in, 9), vec3(in, 15), in[18], in[19]);
  const glm::dvec2 right = pixel(screen, vec3(in, 12), vec3(in, 15), in[18], in[19]);
  EXPECT_NEAR(left.x, expected[0], 1e-6);
  EXPECT_NEAR(left.y, expected[1], 1e-6);
  EXPECT_NEAR(right.x, expected[2], 1e-6);
  EXPECT_NEAR(right.y, expected[3], 1e-6);
  EXPECT_NEAR((right.x - left.x) * screen.width_m() / in[18] * 1e3, expected[6], 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Stereo, ParallaxRow, ::testing::ValuesIn(test::stereo_cases("parallax")), case_name);

TEST(ResearchCases, WereAllRead) {
  EXPECT_EQ(test::stereo_cases("frustum").size(), 54U);
  EXPECT_EQ(test::stereo_cases("probe").size(), 36U);
  EXPECT_EQ(test::stereo_cases("eyes").size(), 4U);
  EXPECT_EQ(test::stereo_cases("parallax").size(), 6U);
}

// ---- properties that hold for every correct implementation, over random walls and viewers ----

struct RandomWall {
  Screen screen;
  glm::dvec3 left, right;
};

class Properties : public ::testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 point(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  glm::dquat rotation() {
    return glm::normalize(glm::dquat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
  }

  // Any orientation and place; the head in front of the wall, facing it squarely.
  RandomWall wall() {
    const glm::dquat turn = rotation();
    const glm::dvec3 origin = point(5.0);
    const double width = uniform(0.3, 8.0), height = uniform(0.3, 4.0);
    const glm::dvec3 head(uniform(-2, 2), uniform(-2, 2), uniform(0.3, 6.0));
    const glm::dvec3 half_ipd(0.5 * uniform(0.04, 0.08), 0.0, 0.0);
    return {{"random", origin, origin + turn * glm::dvec3(width, 0, 0), origin + turn * glm::dvec3(0, height, 0)},
            origin + turn * (head - half_ipd),
            origin + turn * (head + half_ipd)};
  }

  std::mt19937 random_{20251121};
};

constexpr int kWalls = 2000;

TEST_F(Properties, TheWallsCornersFillBothEyesImages) {
  for (int i = 0; i < kWalls; ++i) {
    const RandomWall w = wall();
    for (const glm::dvec3& eye : {w.left, w.right}) {
      const glm::dvec2 lower_left = pixel(w.screen, eye, w.screen.lower_left, 1, 1);
      const glm::dvec2 lower_right = pixel(w.screen, eye, w.screen.lower_right, 1, 1);
      const glm::dvec2 upper_left = pixel(w.screen, eye, w.screen.upper_left, 1, 1);
      EXPECT_LT(glm::distance(lower_left, glm::dvec2(0, 1)), 1e-9);
      EXPECT_LT(glm::distance(lower_right, glm::dvec2(1, 1)), 1e-9);
      EXPECT_LT(glm::distance(upper_left, glm::dvec2(0, 0)), 1e-9);
    }
  }
}

TEST_F(Properties, APointOnTheWallHasZeroParallaxAndNearerIsCrossed) {
  for (int i = 0; i < kWalls; ++i) {
    const RandomWall w = wall();
    const glm::dvec3 on_wall = w.screen.lower_left + uniform(0, 1) * (w.screen.lower_right - w.screen.lower_left) +
                               uniform(0, 1) * (w.screen.upper_left - w.screen.lower_left);
    const auto parallax = [&](const glm::dvec3& p) {
      return pixel(w.screen, w.right, p, 1, 1) - pixel(w.screen, w.left, p, 1, 1);
    };
    EXPECT_LT(glm::length(parallax(on_wall)), 1e-9);
    EXPECT_LT(parallax(on_wall + 0.1 * w.screen.normal()).x, 0.0);
    EXPECT_GT(parallax(on_wall - 0.1 * w.screen.normal()).x, 0.0);
    EXPECT_NEAR(parallax(on_wall + 0.1 * w.screen.normal()).y, 0.0, 1e-9);
  }
}

TEST_F(Properties, ParallaxAtInfinityIsTheEyesDistanceOnTheWall) {
  for (int i = 0; i < kWalls; ++i) {
    const RandomWall w = wall();
    const glm::dvec3 far = w.screen.center() - 1e9 * w.screen.normal();
    const double parallax_m =
        (pixel(w.screen, w.right, far, 1, 1) - pixel(w.screen, w.left, far, 1, 1)).x * w.screen.width_m();
    EXPECT_NEAR(parallax_m, glm::distance(w.left, w.right), 1e-6);
  }
}

TEST_F(Properties, MovingWallAndHeadTogetherChangesNothing) {
  for (int i = 0; i < kWalls; ++i) {
    const RandomWall w = wall();
    const glm::dquat turn = rotation();
    const glm::dvec3 shift = point(10.0);
    const auto moved = [&](const glm::dvec3& p) { return turn * p + shift; };
    const Screen screen{"moved", moved(w.screen.lower_left), moved(w.screen.lower_right), moved(w.screen.upper_left)};
    const glm::dvec3 p = w.screen.center() - 0.7 * w.screen.normal();
    EXPECT_LT(glm::distance(pixel(screen, moved(w.left), moved(p), 1, 1), pixel(w.screen, w.left, p, 1, 1)), 1e-9);
  }
}

TEST_F(Properties, TilesThatShareAnEdgeAgreeOnIt) {
  for (int i = 0; i < kWalls; ++i) {
    const RandomWall w = wall();
    const glm::dvec3 middle = 0.5 * (w.screen.lower_right - w.screen.lower_left);
    const Screen left_tile{"l", w.screen.lower_left, w.screen.lower_left + middle, w.screen.upper_left};
    const Screen right_tile{"r", w.screen.lower_left + middle, w.screen.lower_right, w.screen.upper_left + middle};
    const glm::dvec3 edge = w.screen.lower_left + middle + uniform(0, 1) * (w.screen.upper_left - w.screen.lower_left);
    const glm::dvec2 in_left = pixel(left_tile, w.left, edge, 1, 1), in_right = pixel(right_tile, w.left, edge, 1, 1);
    EXPECT_NEAR(in_left.x, 1.0, 1e-9);
    EXPECT_NEAR(in_right.x, 0.0, 1e-9);
    EXPECT_NEAR(in_left.y, in_right.y, 1e-9);
  }
}

// ---- refusals ----

std::string refusal(const Screen& screen, const glm::dvec3& eye) {
  const auto view = off_axis_view(screen, eye, DepthConvention::VulkanReversedInfinite, 0.1, 0.0);
  return view ? "accepted" : view.error().message;
}

TEST(OffAxisView, RefusesCollinearCorners) {
  const Screen screen{"wall", {0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_THAT(refusal(screen, {0, 0, 2}), HasSubstr("collinear"));
}

TEST(OffAxisView, RefusesCoincidingCorners) {
  const Screen screen{"wall", {0, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  EXPECT_THAT(refusal(screen, {0, 0, 2}), HasSubstr("coincide"));
}

TEST(OffAxisView, RefusesCornersThatAreNotSquare) {
  const Screen screen{"wall", {0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}};
  EXPECT_THAT(refusal(screen, {0, 0, 2}), HasSubstr("right angle"));
}

// A tape's error is let pass; a degree off square is a mistyped corner.
TEST(OffAxisView, BearsNineTenthsOfADegreeOffSquareAndNotElevenTenths) {
  const auto leaning = [](double degrees) {
    const double angle = degrees * 3.14159265358979323846 / 180.0;
    return Screen{"wall", {0, 0, 0}, {1, 0, 0}, {std::sin(angle), std::cos(angle), 0}};
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(check_screen(leaning(0.9 * side)));
    EXPECT_FALSE(check_screen(leaning(1.1 * side)));
  }
}

TEST(OffAxisView, RefusesAnEyeBehindTheWall) {
  const Screen screen{"wall", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THAT(refusal(screen, {0.5, 0.5, -1}), HasSubstr("behind"));
  EXPECT_THAT(refusal(screen, {0.5, 0.5, 0}), HasSubstr("behind"));
  EXPECT_THAT(refusal(screen, {0.5, 0.5, std::nan("")}), HasSubstr("behind"));
}

TEST(OffAxisView, RefusesCornersThatAreNotNumbers) {
  for (glm::dvec3 Screen::* corner : {&Screen::lower_left, &Screen::lower_right, &Screen::upper_left}) {
    for (int axis = 0; axis < 3; ++axis) {
      Screen screen{"wall", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
      (screen.*corner)[axis] = std::nan("");
      EXPECT_THAT(refusal(screen, {0, 0, 2}), HasSubstr("finite"));
    }
  }
}

// ---- places where no head can be ----

TEST(DoubtOfHead, BelievesAHeadBeforeTheWallAndNoneBelowTheFloorOrBehindAScreen) {
  const Screen front{"front", {-1.5, 0.4, 0.0}, {1.5, 0.4, 0.0}, {-1.5, 2.6, 0.0}};
  const Screen left{"left", {-1.5, 0.4, 3.0}, {-1.5, 0.4, 0.0}, {-1.5, 2.6, 3.0}};
  const Wall wall{.screens = {front, left}, .outputs = {}, .viewers = {{.sweet_spot = {.position_m = {0, 1.6, 2}}}}};
  EXPECT_EQ(doubt_of_head(wall, {0.0, 1.65, 2.5}), "");
  EXPECT_EQ(doubt_of_head(wall, {0.0, 0.3, 2.5}), "") << "on the knees, below the screen's edge";
  EXPECT_EQ(doubt_of_head(wall, {0.0, -1.32, 2.5}), "1.32 m below the floor");
  EXPECT_EQ(doubt_of_head(wall, {0.0, 1.65, -0.5}), "0.50 m behind the screen \"front\"");
  EXPECT_EQ(doubt_of_head(wall, {-1.75, 1.65, 1.0}), "0.25 m behind the screen \"left\"");
}

TEST(DoubtOfHead, KnowsRoomsWhoseOriginIsNotOnTheFloor) {
  const Screen desk{"desk", {-0.3, 0.12, 0.0}, {0.3, 0.12, 0.0}, {-0.3, 0.45, 0.0}};
  const Wall on_desk{.screens = {desk}, .outputs = {}, .viewers = {{.sweet_spot = {.position_m = {0, 0.34, 0.65}}}}};
  EXPECT_EQ(doubt_of_head(on_desk, {0.0, -0.1, 0.6}), "");
  EXPECT_EQ(doubt_of_head(on_desk, {0.0, -1.66, 0.6}), "1.00 m below the floor");
  const Screen about_eyes{"wall", {-1.5, -1.4, -2.0}, {1.5, -1.4, -2.0}, {-1.5, 0.9, -2.0}};
  const Wall of_paraview{.screens = {about_eyes}, .outputs = {}, .viewers = {Viewer{}}};
  EXPECT_EQ(doubt_of_head(of_paraview, {0.0, -0.2, 0.0}), "");
}

}  // namespace wall_test
}  // namespace afm::scene
