// SPDX-License-Identifier: Apache-2.0
// Invariant: a mesh with vertices from a frame looks and redraws like one that was loaded with them
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>
#include <vector>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

// A surface that grows: the frame gives the vertices of its mesh.
namespace afm::test {
namespace shapes_test {

constexpr std::uint32_t kSide = 33;

// Waves of this height on a square, in front of the wall.
std::vector<scene::Vertex> waves(float height) {
  std::vector<scene::Vertex> vertices;
  for (std::uint32_t row = 0; row < kSide; ++row) {
    for (std::uint32_t column = 0; column < kSide; ++column) {
      const float x = static_cast<float>(column) / (kSide - 1) - 0.5F, y = 0.5F - static_cast<float>(row) / (kSide - 1);
      const float wave = std::sin(12.0F * x);
      vertices.push_back({{x, y, 0.5F + height * wave},
                          glm::normalize(glm::vec3(-12.0F * height * std::cos(12.0F * x), 0.0F, 1.0F)),
                          {0.5F + 0.4F * wave, 0.4F, 0.2F, 1.0F}});
    }
  }
  return vertices;
}

scene::Primitive grid(std::uint32_t material, float height) {
  scene::Primitive grid;
  grid.material = material;
  grid.vertices = waves(height);
  for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
    for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
      const std::uint32_t first = row * kSide + column, below = first + kSide;
      grid.indices.insert(grid.indices.end(), {first, below, below + 1, first, below + 1, first + 1});
    }
  }
  return grid;
}

struct Growing {
  scene::Scene scene;
  scene::NodeIndex node = 0;
  render::FrameState frame;
};

Growing growing(float loaded, bool reshaped) {
  Growing growing;
  const std::uint32_t chalk = add_material(growing.scene, {.name = "chalk", .metallic = 0.0F});
  const glm::dmat4 lying = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.3, -0.4)) *
                           glm::rotate(glm::dmat4(1.0), glm::radians(-60.0), glm::dvec3(1.0, 0.0, 0.0)) *
                           glm::scale(glm::dmat4(1.0), glm::dvec3(1.6, 1.2, 0.5));
  add(growing.scene, "behind", quad(chalk), glm::translate(lying, glm::dvec3(0.0, 0.0, -0.2)));
  growing.node = add(growing.scene, "surface", grid(chalk, loaded), lying);
  growing.scene.nodes[growing.node].reshaped = reshaped;
  growing.frame = bare_frame(growing.scene);
  growing.frame.key_light.map_share = 0.0F;  // no shadow, since a shape casts none
  return growing;
}

using Shapes = VulkanTest;

TEST_F(Shapes, LookLikeMeshesLoadedThus) {
  Growing shaped = growing(0.4F, true);
  shaped.frame.shapes = {{.node = shaped.node, .vertices = waves(0.15F)}};
  const Growing loaded = growing(0.15F, false);
  for (const render::PassMode mode : {render::PassMode::Multiview, render::PassMode::TwoPasses}) {
    const Pair as_shape = draw(shaped.scene, shaped.frame, small(4, mode));
    const Pair as_mesh = draw(loaded.scene, loaded.frame, small(4, mode));
    constexpr int kRounding = 6;  // tolerance, since the light of a mesh may be computed per vertex
    EXPECT_LT(difference(as_shape.left, as_mesh.left, kRounding).share_beyond, 0.004);
    EXPECT_LT(difference(as_shape.right, as_mesh.right, kRounding).share_beyond, 0.004);
  }
}

TEST_F(Shapes, AreNotShownWithoutAnEntryOfTheFrame) {
  Growing shaped = growing(0.4F, true);
  const render::Image without = draw(shaped.scene, shaped.frame, small()).left;
  shaped.frame.shapes = {{.node = shaped.node, .vertices = waves(0.15F)}};
  EXPECT_NE(where_differ(draw(shaped.scene, shaped.frame, small()).left, without), "");
  shaped.frame.visible.assign(shaped.scene.nodes.size(), 1);
  shaped.frame.visible[shaped.node] = 0;
  EXPECT_EQ(where_differ(draw(shaped.scene, shaped.frame, small()).left, without), "") << "hidden";
}

// Changes line by line, with frames in which nothing changes and one without the shape.
TEST_F(Shapes, RedrawnWhereTheyChangeGiveTheBytesOfRedrawingEverything) {
  Growing shaped = growing(0.4F, true);
  render::RendererOptions options = small();
  options.redraw = render::Redraw::Changes;
  auto changes = make_renderer(shaped.scene, options);
  options.redraw = render::Redraw::Everything;
  auto everything = make_renderer(shaped.scene, options);
  const std::vector<scene::Vertex> flat = waves(0.0F), measured = waves(0.3F);
  std::vector<scene::Vertex> now = flat;
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t row = i / 2 * 4;
    for (std::size_t column = 0; column < kSide; ++column) now[row * kSide + column] = measured[row * kSide + column];
    shaped.frame.shapes.clear();
    if (i != 6) shaped.frame.shapes.push_back({.node = shaped.node, .vertices = now});
    changes.render(shaped.frame);
    everything.render(shaped.frame);
    for (const scene::Eye eye : scene::kEyes) {
      ASSERT_EQ(where_differ(changes.read_eye(eye), everything.read_eye(eye)), "") << "frame " << i;
    }
    if (i == 3) {
      EXPECT_EQ(changes.redrawn_share(), 0.0) << "nothing has changed";
    }
  }
}

}  // namespace shapes_test
}  // namespace afm::test
