// SPDX-License-Identifier: Apache-2.0
// Invariant: per-vertex shading of small triangles looks like per-pixel shading, and no frame recompiles its shader
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace per_vertex_shading_test {

// A square of 1 x 1 node units with hills of that height, in 2 x quads x quads triangles, up along +z.
scene::Primitive hills(std::uint32_t material, std::uint32_t quads, double hill_height) {
  const auto height = [&](double x, double y) { return hill_height * std::sin(11.0 * x) * std::cos(9.0 * y); };
  scene::Primitive primitive;
  primitive.material = material;
  for (std::uint32_t row = 0; row <= quads; ++row) {
    for (std::uint32_t column = 0; column <= quads; ++column) {
      const double x = static_cast<double>(column) / quads - 0.5, y = static_cast<double>(row) / quads - 0.5;
      constexpr double kStep = 1e-4;
      const glm::dvec3 normal(height(x - kStep, y) - height(x + kStep, y), height(x, y - kStep) - height(x, y + kStep),
                              2.0 * kStep);
      primitive.vertices.push_back(
          {.position = glm::vec3(glm::dvec3(x, y, height(x, y))), .normal = glm::vec3(glm::normalize(normal))});
    }
  }
  for (std::uint32_t row = 0; row < quads; ++row) {
    for (std::uint32_t column = 0; column < quads; ++column) {
      const std::uint32_t a = row * (quads + 1) + column, above = a + quads + 1;
      primitive.indices.insert(primitive.indices.end(), {a, a + 1, above + 1, a, above + 1, above});
    }
  }
  return primitive;
}

// A floor of 2 x 10 x 10 triangles with the shadow of a bar and the shade at the contact on it: fewer triangles than
// are shaded by vertex, and rough enough for smooth.vert. What is seen from both sides is shaded by fragment.
scene::Scene scene_of_floor(bool by_fragment) {
  scene::Scene scene;
  const auto rough = add_material(scene, {.name = "rough",
                                          .base_color = {0.5F, 0.4F, 0.3F, 1.0F},
                                          .metallic = 0.0F,
                                          .roughness = 0.62F,
                                          .double_sided = by_fragment});
  const glm::dmat4 lying = glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
  add(scene, "floor", hills(rough, 10, 0.0), glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.25, -0.1)) * lying);
  const auto grey = add_material(scene, {.name = "grey", .base_color = {0.5F, 0.5F, 0.5F, 1.0F}, .metallic = 0.0F});
  add(scene, "bar", lever(grey, 0.05, 0.02, 1), glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5, 0.0, 0.0)));
  return scene;
}

class SmoothShading : public VulkanTest {
 protected:
  Pair draw_floor(bool by_fragment, const render::RendererOptions& options) {
    const scene::Scene scene = scene_of_floor(by_fragment);
    render::FrameState frame = bare_frame(scene);
    frame.contact = {.place_m = {0.1F, -0.25F, 0.0F},
                     .shade_radius_m = 0.05F,
                     .ring_color = glm::vec3(0.5F),
                     .ring_radius_m = 0.05F};
    return draw(scene, frame, options);
  }
};

class PerVertexShading : public VulkanTest {
 protected:
  // Same surface under the shadow of a lever; surfaces visible from both sides are shaded by fragment.
  static scene::Scene scene_of_hills(bool by_fragment) {
    scene::Scene scene;
    const auto gold = add_material(scene, {.name = "gold",
                                           .base_color = {1.0F, 0.76F, 0.33F, 1.0F},
                                           .metallic = 1.0F,
                                           .roughness = 0.4F,
                                           .double_sided = by_fragment});
    const auto grey = add_material(scene, {.name = "grey", .base_color = {0.5F, 0.5F, 0.5F, 1.0F}, .metallic = 0.0F});
    const glm::dmat4 tilted = glm::rotate(glm::dmat4(1.0), glm::radians(-60.0), glm::dvec3(1.0, 0.0, 0.0));
    add(scene, "hills", hills(gold, 100, 0.03), glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.3, -0.2)) * tilted);
    add(scene, "bar", lever(grey, 0.05, 0.02, 1), glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5, 0.1, 0.1)));
    return scene;
  }
  Pair draw_hills(bool by_fragment, const render::RendererOptions& options) {
    const scene::Scene scene = scene_of_hills(by_fragment);
    return draw(scene, bare_frame(scene), options);
  }
};

// Executable memory without a file: code compiled by a driver that draws on the CPU.
std::size_t compiled_bytes() {
  std::ifstream maps("/proc/self/maps");
  std::size_t bytes = 0;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream fields(line);
    std::string range, access, offset, device, inode;
    fields >> range >> access >> offset >> device >> inode;
    if (access != "r-xp" || inode != "0" || line.find('[') != std::string::npos) continue;
    const std::size_t dash = range.find('-');
    bytes += std::stoul(range.substr(dash + 1), nullptr, 16) - std::stoul(range.substr(0, dash), nullptr, 16);
  }
  return bytes;
}

// Triangles of about a pixel are shaded at their vertices: the difference is invisible, although it is another program.
TEST_F(PerVertexShading, LooksAsItWouldByFragment) {
  const auto fine = draw_hills(false, small());
  const auto plain = draw_hills(true, small());
  for (const auto& [a, b] : {std::pair(&fine.left, &plain.left), std::pair(&fine.right, &plain.right)}) {
    std::size_t apart = 0, other = 0;
    for (std::size_t i = 0; i < a->rgba.size(); ++i) {
      const int difference = std::abs(int{a->rgba[i]} - int{b->rgba[i]});
      apart += difference > 12 ? 1 : 0;
      other += difference > 0 ? 1 : 0;
    }
    EXPECT_LT(static_cast<double>(apart), 0.004 * static_cast<double>(a->rgba.size()));
    EXPECT_GT(other, std::size_t{0});
  }
}

TEST_F(PerVertexShading, IsTheSameInOnePassAndInTwo) {
  const auto one = draw_hills(false, small(4, render::PassMode::Multiview));
  const auto two = draw_hills(false, small(4, render::PassMode::TwoPasses));
  EXPECT_EQ(one.left.rgba, two.left.rgba);
  EXPECT_EQ(one.right.rgba, two.right.rgba);
}

// The light on a rough floor is worked out at its vertices, the shadow and the shade at the contact where they are.
TEST_F(SmoothShading, LooksAsItWouldByFragment) {
  const auto smooth = draw_floor(false, small());
  const auto plain = draw_floor(true, small());
  for (const auto& [a, b] : {std::pair(&smooth.left, &plain.left), std::pair(&smooth.right, &plain.right)}) {
    int most = 0;
    for (std::size_t i = 0; i < a->rgba.size(); ++i) most = std::max(most, std::abs(int{a->rgba[i]} - int{b->rgba[i]}));
    EXPECT_LE(most, 3) << "nobody sees that";
    EXPECT_GT(most, 0) << "it is another program";
  }
}

TEST_F(SmoothShading, IsTheSameInOnePassAndInTwo) {
  const auto one = draw_floor(false, small(4, render::PassMode::Multiview));
  const auto two = draw_floor(false, small(4, render::PassMode::TwoPasses));
  EXPECT_EQ(one.left.rgba, two.left.rgba);
  EXPECT_EQ(one.right.rgba, two.right.rgba);
}

// lavapipe recompiles a shader for every value of a uniform with many branches, and keeps all versions.
TEST_F(PerVertexShading, IsNotCompiledAnewInEveryFrame) {
  const scene::Scene scene = scene_of_hills(false);
  auto renderer = make_renderer(scene, small(1));
  std::size_t warm = 0;
  for (int i = 0; i < 20; ++i) {
    auto frame = bare_frame(scene);
    frame.contact = {.place_m = {0.01F * static_cast<float>(i), 0.0F, 0.0F},
                     .shade_radius_m = 0.1F + 0.01F * static_cast<float>(i),
                     .ring_color = glm::vec3(i % 2 == 0 ? 0.0F : 0.5F),
                     .ring_radius_m = i % 2 == 0 ? 0.0F : 0.01F * static_cast<float>(i)};
    renderer.render(frame);
    renderer.wait();
    if (i == 5) warm = compiled_bytes();
  }
  EXPECT_GT(warm, 0U) << "only lavapipe compiles where it can be seen";
  EXPECT_EQ(compiled_bytes(), warm);
}

}  // namespace per_vertex_shading_test
}  // namespace afm::test
