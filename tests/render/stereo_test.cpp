// SPDX-License-Identifier: Apache-2.0
// Invariant: points on the wall have no parallax; nearer ones have crossed parallax
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "physics/beam_shape.h"
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace stereo_test {

constexpr double kWallWidth = 3.048;
constexpr double kDistance = 2.5;
constexpr double kIpd = 0.063;
constexpr double kPixelsPerMetre = 256.0 / kWallWidth;

// Four samples place an edge within an eighth of a pixel; the centroid of a square averages its edges.
constexpr double kCentroidTolerance = 0.12;

glm::dmat4 placed(const glm::dvec3& at, double size) {
  return glm::scale(glm::translate(glm::dmat4(1.0), at), glm::dvec3(size));
}

class Stereo : public VulkanTest {
 protected:
  struct Seen {
    glm::dvec2 left, right;
  };
  // View of a single white square of 0.2 m at `at`.
  Seen see_square(const glm::dvec3& at) {
    scene::Scene scene;
    const auto white = add_material(scene, {.name = "white", .unlit = true});
    add(scene, "square", quad(white), placed(at, 0.2));
    const auto eyes = draw(scene, bare_frame(scene), small());
    const auto weight = brighter_than(120);
    return {centroid(eyes.left, weight).value(), centroid(eyes.right, weight).value()};
  }
};

TEST_F(Stereo, APointOnTheWallHasNoParallaxAndLiesWhereTheWallSays) {
  for (const auto& at : {glm::dvec3(0.0), glm::dvec3(-1.2, 0.8, 0.0), glm::dvec3(1.07, -0.61, 0.0)}) {
    const auto seen = see_square(at);
    EXPECT_NEAR(seen.left.x, seen.right.x, 1e-9);
    EXPECT_NEAR(seen.left.y, seen.right.y, 1e-9);
    EXPECT_NEAR(seen.left.x, (at.x + 0.5 * kWallWidth) * kPixelsPerMetre, kCentroidTolerance);
    EXPECT_NEAR(seen.left.y, (1.143 - at.y) * kPixelsPerMetre, kCentroidTolerance);
  }
}

TEST_F(Stereo, NearerIsCrossedAndFartherIsUncrossedByTheIntercept) {
  for (const double z : {0.5, 1.2, -0.8, -3.0}) {
    const auto seen = see_square({0.0, 0.0, z});
    const double parallax = -kIpd * z / (kDistance - z) * kPixelsPerMetre;
    EXPECT_NEAR(seen.right.x - seen.left.x, parallax, 2.0 * kCentroidTolerance) << z;
    EXPECT_EQ(std::signbit(seen.right.x - seen.left.x), z > 0.0) << z;
    EXPECT_NEAR(seen.right.y, seen.left.y, kCentroidTolerance) << z;
  }
}

TEST_F(Stereo, ParallaxFarAwayIsNoMoreThanTheEyesAreApart) {
  const auto seen = see_square({0.0, 0.0, -40.0});
  EXPECT_LE(seen.right.x - seen.left.x, kIpd * kPixelsPerMetre + kCentroidTolerance);
}

// Reversed depth separates two surfaces at any distance from the near plane, in either drawing order.
TEST_F(Stereo, TheNearerOfTwoSurfacesIsSeen) {
  for (const double z : {1.5, 0.0, -60.0}) {
    for (const bool near_first : {true, false}) {
      scene::Scene scene;
      const auto white = add_material(scene, {.name = "white", .unlit = true});
      const auto black = add_material(scene, {.name = "black", .base_color = {0.0F, 0.0F, 0.0F, 1.0F}, .unlit = true});
      const double size = 0.5 * (kDistance - z);
      const auto near_square = placed({0.0, 0.0, z + 1e-3 * (kDistance - z)}, size);
      const auto far_square = placed({0.0, 0.0, z}, size);
      add(scene, "first", quad(near_first ? white : black), near_first ? near_square : far_square);
      add(scene, "second", quad(near_first ? black : white), near_first ? far_square : near_square);
      const auto eyes = draw(scene, bare_frame(scene), small());
      EXPECT_GT(pixel(eyes.left, 128, 96).g, 200) << z << (near_first ? " near first" : " far first");
      EXPECT_GT(pixel(eyes.right, 128, 96).g, 200) << z << (near_first ? " near first" : " far first");
    }
  }
}

// The shape of physics/beam_shape.h, in a lever that lies in the wall's plane and bends in it.
TEST_F(Stereo, ABentLeverLiesWhereTheFormulaSays) {
  scene::Scene scene;
  const auto white = add_material(scene, {.name = "white", .unlit = true});
  constexpr double kLength = 2.0;
  constexpr double kDeflection = 0.5;
  const auto node = add(scene, "lever", lever(white, 0.01, 0.02, 64),
                        glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, -0.2, 0.0)) *
                            glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0)) *
                            glm::scale(glm::dmat4(1.0), glm::dvec3(kLength)));
  auto frame = bare_frame(scene);
  frame.bends = {{.node = node, .length = 1.0F, .end_deflection = static_cast<float>(kDeflection / kLength)}};
  const auto eyes = draw(scene, frame, small());
  for (const double xi : {0.1, 0.25, 0.5, 0.75, 0.95}) {
    const double deflection = kDeflection * physics::beam_deflection(xi);
    const auto column = static_cast<std::uint32_t>((-1.0 + kLength * xi + 0.5 * kWallWidth) * kPixelsPerMetre);
    const auto weight = brighter_than(120);
    double sum = 0.0, total = 0.0;
    for (std::uint32_t y = 0; y < eyes.left.height; ++y) {
      const double w = weight(pixel(eyes.left, column, y));
      sum += w * (y + 0.5);
      total += w;
    }
    ASSERT_GT(total, 0.0) << xi;

    // the pixel's own slope, and four samples of an edge
    EXPECT_NEAR(sum / total, (1.143 - (-0.2 + deflection)) * kPixelsPerMetre, 0.5) << xi;
  }
}

TEST_F(Stereo, HiddenNodesAreNotDrawnAndHighlightedOnesGlow) {
  const auto test = make_test_scene();
  auto frame = bare_frame(test.scene);
  const auto plain = draw(test.scene, frame, small());
  frame.highlighted = {test.mica};
  const auto glowing = draw(test.scene, frame, small());
  frame.highlighted.clear();
  frame.visible.assign(test.scene.nodes.size(), 1);
  frame.visible[test.mica] = 0;
  const auto hidden = draw(test.scene, frame, small());

  // place where the mica ball is seen
  const std::uint32_t x = 90, y = 131;
  EXPECT_GT(pixel(glowing.left, x, y).r, pixel(plain.left, x, y).r + 15);
  EXPECT_NE(pixel(hidden.left, x, y).g, pixel(plain.left, x, y).g);
  EXPECT_GT(difference(hidden.left, plain.left, 5).share_beyond, 0.005);
}

// The scene's own units are metres of the instrument: a sample of 1e-9 m looks like one of 1 m shown as large.
TEST_F(Stereo, TheUnitOfAMeshDoesNotShow) {
  const auto picture = [&](double unit) {
    scene::Scene scene;
    const auto gold = add_material(
        scene, {.name = "gold", .base_color = {1.0F, 0.76F, 0.33F, 1.0F}, .metallic = 1.0F, .roughness = 0.4F});
    auto ball = sphere(gold, 24);
    for (auto& vertex : ball.vertices) {
      vertex.position *= static_cast<float>(unit);
    }
    add(scene, "ball", ball, placed({0.0, 0.0, -0.2}, 0.8 / unit));
    return draw(scene, bare_frame(scene), small());
  };
  const auto metres = picture(1.0);
  const auto nanometres = picture(1e-9);
  const auto found = difference(metres.left, nanometres.left, 2);
  EXPECT_LE(found.share_beyond, 0.0005);
}

}  // namespace stereo_test
}  // namespace afm::test
