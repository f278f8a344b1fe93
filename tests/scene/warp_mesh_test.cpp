// SPDX-License-Identifier: Apache-2.0
#include "scene/display/warp_mesh.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "scene/display/wall.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace warp_mesh_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kFloat = 1e-6;  // rounding of a unit coordinate in 32 bits

// A mesh file with x and y in a regular grid; `texture` gives u, v and the intensity there.
std::string regular(int columns, int rows, double aspect,
                    const std::function<std::array<double, 3>(double x, double y)>& texture) {
  std::string text = fmt::format("2\n{} {}\n", columns, rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = 2.0 * column / (columns - 1) - 1.0, y = 2.0 * row / (rows - 1) - 1.0;
      const auto [u, v, intensity] = texture(x, y);
      text += fmt::format("{:.9f} {:.9f} {:.9f} {:.9f} {:g}\n", aspect * x, y, u, v, intensity);
    }
  }
  return text;
}

std::array<double, 3> straight(double x, double y) { return {0.5 * (x + 1.0), 0.5 * (y + 1.0), 1.0}; }

core::Result<WarpMesh> read(const std::string& text, std::optional<double> aspect = {}) {
  const support::ScratchFolder folder;
  return load_warp_mesh(folder.write("mesh.data", text), aspect);
}

std::string error_of(const std::string& text) {
  const auto mesh = read(text);
  if (mesh) return "accepted";
  EXPECT_EQ(mesh.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(mesh.error().message, HasSubstr("mesh.data"));
  return mesh.error().message;
}

TEST(WarpMesh, OfAnUnbentPictureShowsEachPixelItself) {
  for (const glm::uvec2 size : {glm::uvec2(64, 48), glm::uvec2(61, 37), glm::uvec2(1, 1)}) {
    const auto map = warp_map(read(regular(9, 7, 1.6, straight)).value(), size);
    ASSERT_EQ(map.size(), std::size_t{size.x} * size.y);
    for (std::uint32_t y = 0; y < size.y; ++y) {
      for (std::uint32_t x = 0; x < size.x; ++x) {
        const glm::vec4& at = map[y * size.x + x];
        EXPECT_NEAR(at.x, (x + 0.5) / size.x, kFloat);
        EXPECT_NEAR(at.y, (y + 0.5) / size.y, kFloat);
        EXPECT_NEAR(at.z, 1.0, kFloat);
        EXPECT_GE(at.w, 1.0F);
      }
    }
  }
}

// The format's rows begin at the bottom: y = -1 and v = 0 in a file are the picture's lower edge.
TEST(WarpMesh, HasItsOriginBelowAsTheFormatHas) {
  const WarpMesh mesh = read("2\n2 2\n-1.5 -1 0.25 0 1\n1.5 -1 1 0 1\n-1.5 1 0 0.5 1\n1.5 1 1 1 1\n").value();
  EXPECT_EQ(mesh.node(0, 0).output, glm::dvec2(0.0, 1.0));
  EXPECT_EQ(mesh.node(0, 0).picture, glm::dvec2(0.25, 1.0));
  EXPECT_EQ(mesh.node(0, 1).output, glm::dvec2(0.0, 0.0));
  EXPECT_EQ(mesh.node(0, 1).picture, glm::dvec2(0.0, 0.5));
}

// The width is the output's; a mesh that does not say more than its own nodes fills it.
TEST(WarpMesh, TakesTheOutputsAspectOrItsOwnLargestX) {
  const std::string text = regular(3, 3, 1.0, straight);
  EXPECT_EQ(read(text).value().node(0, 0).output, glm::dvec2(0.0, 1.0));
  EXPECT_EQ(read(text, 2.0).value().node(0, 0).output, glm::dvec2(0.25, 1.0));
}

// In x, y as in u, v: both ways to write a mesh move the picture in the same way.
TEST(WarpMesh, MayBendTheNodesOrTheTexture) {
  const auto by_texture = read(regular(5, 5, 1.0, [](double x, double y) -> std::array<double, 3> {
                            return {0.5 * (0.5 * x + 1.0), 0.5 * (y + 1.0), 1.0};
                          })).value();
  std::string text = "2\n2 2\n";
  for (const double y : {-1.0, 1.0}) {
    for (const double x : {-1.0, 1.0}) text += fmt::format("{} {} {} {} 1\n", 2.0 * x, y, 0.5 * (x + 1), 0.5 * (y + 1));
  }
  const auto by_nodes = read(text, 1.0).value();
  for (const glm::dvec2 place : {glm::dvec2(0.1, 0.2), glm::dvec2(0.5, 0.5), glm::dvec2(0.93, 0.71)}) {
    const auto a = warped_place(by_texture, place), b = warped_place(by_nodes, place);
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->picture.x, 0.25 + 0.5 * place.x, 1e-9);
    EXPECT_NEAR(a->picture.x, b->picture.x, 1e-9);
    EXPECT_NEAR(a->picture.y, b->picture.y, 1e-9);
  }
}

TEST(WarpMesh, MapAndPlaceAgreeInABarrel) {
  const auto barrel = [](double x, double y) -> std::array<double, 3> {
    const double k = 1.0 + 0.1 * (x * x + y * y);
    return {0.5 * (k * x + 1.0), 0.5 * (k * y + 1.0), 1.0 - 0.2 * x * x};
  };
  const WarpMesh mesh = read(regular(33, 33, 1.25, barrel)).value();
  const glm::uvec2 size(50, 40);
  const auto map = warp_map(mesh, size);
  for (std::uint32_t y = 0; y < size.y; ++y) {
    for (std::uint32_t x = 0; x < size.x; ++x) {
      const glm::dvec2 output = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size);
      const auto place = warped_place(mesh, output);
      ASSERT_TRUE(place);
      const glm::vec4& at = map[y * size.x + x];
      EXPECT_NEAR(at.x, place->picture.x, kFloat);
      EXPECT_NEAR(at.y, place->picture.y, kFloat);
      EXPECT_NEAR(at.z, place->intensity, kFloat);
      // cells of 1/16 bend by less than the square of that
      const auto [u, v, intensity] = barrel(2.0 * output.x - 1.0, 1.0 - 2.0 * output.y);
      EXPECT_NEAR(at.x, u, 1e-3);
      EXPECT_NEAR(at.y, 1.0 - v, 1e-3);
      EXPECT_NEAR(at.z, intensity, 1e-3);
    }
  }
}

TEST(WarpMesh, DrawsNothingAroundANodeOfNegativeIntensity) {
  const auto hole = [](double x, double y) -> std::array<double, 3> {
    auto node = straight(x, y);
    if (x == 0.0 && y == 0.0) node[2] = -1.0;
    return node;
  };
  const WarpMesh mesh = read(regular(5, 5, 1.0, hole)).value();
  const auto map = warp_map(mesh, {80, 80});
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) {
      const bool around = x >= 20 && x < 60 && y >= 20 && y < 60;
      EXPECT_EQ(map[static_cast<std::size_t>(80 * y + x)].w == 0.0F, around) << x << ", " << y;
    }
  }
  EXPECT_FALSE(warped_place(mesh, {0.5, 0.4}));
  EXPECT_TRUE(warped_place(mesh, {0.5, 0.2}));
}

TEST(WarpMesh, KnowsHowFarItsLinesAre) {
  const auto map = warp_map(read(regular(3, 2, 1.0, straight)).value(), {40, 40});
  const auto distance_px = [&](int x, int y) { return map[static_cast<std::size_t>(40 * y + x)].w - 1.0F; };
  EXPECT_NEAR(distance_px(19, 10), 0.5, 1e-5);
  EXPECT_NEAR(distance_px(20, 30), 0.5, 1e-5);
  EXPECT_NEAR(distance_px(14, 15), 5.5, 1e-5);
  EXPECT_NEAR(distance_px(10, 39), 0.5, 1e-5);
}

TEST(WarpMesh, NamesTheLineOfEveryMistake) {
  const std::string good = "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return error_of(text);
  };
  EXPECT_EQ(error_of(good), "accepted");
  EXPECT_EQ(error_of(good + "\r\n \n"), "accepted");
  EXPECT_THAT(error_of(""), AllOf(HasSubstr("line 1"), HasSubstr("ends here")));
  EXPECT_THAT(error_of("1" + good.substr(1)), AllOf(HasSubstr("line 1"), HasSubstr("fisheye")));
  EXPECT_THAT(error_of("3" + good.substr(1)), AllOf(HasSubstr("line 1"), HasSubstr("3 is no type")));
  EXPECT_THAT(with("2 2", "2"), AllOf(HasSubstr("line 2"), HasSubstr("columns and rows")));
  EXPECT_THAT(with("2 2", "1 4"), AllOf(HasSubstr("line 2"), HasSubstr("1 x 4"), HasSubstr("2 to 512")));
  EXPECT_THAT(with("2 2", "2.5 2"), AllOf(HasSubstr("line 2"), HasSubstr("2.5 x 2")));
  EXPECT_THAT(with("2 2", "2000000000 2000000000"), AllOf(HasSubstr("line 2"), HasSubstr("512")));
  EXPECT_THAT(with("2 2", "2 3"), AllOf(HasSubstr("line 7"), HasSubstr("ends here")));
  EXPECT_THAT(error_of(good + "1 1 1 1 1\n"), AllOf(HasSubstr("line 7"), HasSubstr("more lines than nodes")));
  EXPECT_THAT(with("1 -1 1 0 1", "1 -1 1 0"), AllOf(HasSubstr("line 4"), HasSubstr("x y u v intensity")));
  EXPECT_THAT(with("1 -1 1 0 1", "1 -1 1 0 1 1"), AllOf(HasSubstr("line 4"), HasSubstr("nothing more")));
  EXPECT_THAT(with("1 -1 1 0 1", "1 -1 one 0 1"), AllOf(HasSubstr("line 4"), HasSubstr("x y u v intensity")));
  EXPECT_THAT(with("1 -1 1 0 1", "1,-1,1,0,1"), HasSubstr("line 4"));
  EXPECT_THAT(with("1 -1 1 0 1", "nan -1 1 0 1"), HasSubstr("line 4"));
  EXPECT_THAT(with("1 -1 1 0 1", "1e999 -1 1 0 1"), HasSubstr("line 4"));
  EXPECT_THAT(with("1 -1 1 0 1", "100 -1 1 0 1"), AllOf(HasSubstr("line 4"), HasSubstr("too far from the output")));
  EXPECT_THAT(with("1 -1 1 0 1", "1 -1 9 0 1"), AllOf(HasSubstr("line 4"), HasSubstr("too far from the picture")));
  EXPECT_THAT(with("1 -1 1 0 1", "1 -1 1 0 1.5"), AllOf(HasSubstr("line 4"), HasSubstr("intensity 1.5")));
  EXPECT_THAT(with("1 -1 1 0 1", "-1 -1 1 0 1"), AllOf(HasSubstr("line 3"), HasSubstr("no area")));
  EXPECT_THAT(with("1 1 1 1 1", "-3 1 1 1 1"), AllOf(HasSubstr("line 3"), HasSubstr("folds")));
  EXPECT_THAT(error_of("2\n2 2\n-1 -1 1 0 1\n1 -1 0 0 1\n-1 1 1 1 1\n1 1 0 1 1\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("mirrors")));
  EXPECT_THAT(with("1 1 1 1 1", "1 1 1 1 -1"), HasSubstr("no cell"));
  EXPECT_THAT(error_of("2\n2 2\n-0.01 -1 0 0 1\n0.01 -1 1 0 1\n-0.01 1 0 1 1\n0.01 1 1 1 1\n"),
              HasSubstr("largest x is 0.01"));
}

TEST(WarpMesh, MayHaveCommentsEmptyLinesAndAByteOrderMark) {
  const std::string good = "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n";
  const std::string said =
      "\xEF\xBB\xBF# made by hand\r\n\n2 # flat\n2 2\n-1 -1 0 0 1\n\n# upper\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n# end";
  const auto plain = read(good), commented = read(said);
  ASSERT_TRUE(commented.has_value()) << commented.error().message;
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(commented->nodes[i].output, plain->nodes[i].output) << i;
  std::string wrong = said;
  wrong.replace(wrong.find("1 -1 1 0 1\n-1"), 10, "-1 -1 1 0 1");
  EXPECT_THAT(error_of(wrong), AllOf(HasSubstr("line 5"), HasSubstr("no area"))) << "comments count as lines";
}

// Wound about the output's middle a hundred times: no cell folds, and each is as large as the output.
TEST(WarpMesh, RefusesToDrawTheOutputAgainAndAgain) {
  constexpr int kColumns = 400;
  std::string text = fmt::format("2\n{} 2\n", kColumns);
  for (const double radius : {0.01, 1.5}) {
    for (int column = 0; column < kColumns; ++column) {
      const double angle = -1.6 * column;
      text += fmt::format("{} {} {} {} 1\n", radius * std::cos(angle), radius * std::sin(angle),
                          column / (kColumns - 1.0), radius / 1.5);
    }
  }
  EXPECT_THAT(error_of(text), HasSubstr("over itself many times"));
}

// The preset's mesh: where the ray from the eye to a place on the cylinder, which the projector lights, meets the flat
// screen between its edges.
TEST(WarpMesh, OfTheCurvedPresetIsThatOfItsCylinder) {
  const Wall wall = load_wall(support::source("assets/walls/curved.toml")).value();
  const Screen& screen = wall.screens.front();
  ASSERT_TRUE(wall.outputs.front().warp);
  const WarpMesh& mesh = *wall.outputs.front().warp;
  constexpr double kRadiusM = 4.0;
  const double half_m = 0.5 * screen.width_m(), axis_z_m = std::sqrt(kRadiusM * kRadiusM - half_m * half_m);
  const glm::dvec3 lens(0.0, 2.9, 4.5), eye = wall.viewers.front().sweet_spot.position_m;
  const glm::dvec2 raster_low(-2.24, 0.36),
      raster_high(2.24, 2.88);  // corners of the raster, in the flat screen's plane
  for (const WarpNode& node : mesh.nodes) {
    const glm::dvec2 share(node.output.x, 1.0 - node.output.y);
    const glm::dvec3 to = glm::dvec3(raster_low + share * (raster_high - raster_low), 0.0) - lens;
    const double a = to.x * to.x + to.z * to.z, b = 2.0 * to.z * (lens.z - axis_z_m);
    const double c = (lens.z - axis_z_m) * (lens.z - axis_z_m) - kRadiusM * kRadiusM;
    const glm::dvec3 lit = lens + (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a) * to;
    const glm::dvec3 seen = eye + eye.z / (eye.z - lit.z) * (lit - eye);
    EXPECT_NEAR(node.picture.x, (seen.x - screen.lower_left.x) / screen.width_m(), 2e-6);
    EXPECT_NEAR(node.picture.y, (screen.upper_left.y - seen.y) / screen.height_m(), 2e-6);
  }
  for (const glm::dvec2 corner : {glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(1.0)}) {
    const auto place = warped_place(mesh, corner);
    ASSERT_TRUE(place);
    EXPECT_TRUE(place->picture.x < 0.0 || place->picture.x > 1.0) << "the raster reaches beyond the screen";
  }
}

}  // namespace warp_mesh_test
}  // namespace afm::scene
