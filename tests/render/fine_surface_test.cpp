// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace {

// A square of hills of 2 x 100 x 100 triangles, as large as 1 x 1 node units, up along +z.
scene::Primitive hills(std::uint32_t material) {
  constexpr std::uint32_t kQuads = 100;
  const auto height = [](double x, double y) { return 0.03 * std::sin(11.0 * x) * std::cos(9.0 * y); };
  scene::Primitive primitive;
  primitive.material = material;
  for (std::uint32_t row = 0; row <= kQuads; ++row) {
    for (std::uint32_t column = 0; column <= kQuads; ++column) {
      const double x = static_cast<double>(column) / kQuads - 0.5, y = static_cast<double>(row) / kQuads - 0.5;
      constexpr double kStep = 1e-4;
      const glm::dvec3 normal(height(x - kStep, y) - height(x + kStep, y), height(x, y - kStep) - height(x, y + kStep),
                              2.0 * kStep);
      primitive.vertices.push_back(
          {.position = glm::vec3(glm::dvec3(x, y, height(x, y))), .normal = glm::vec3(glm::normalize(normal))});
    }
  }
  for (std::uint32_t row = 0; row < kQuads; ++row) {
    for (std::uint32_t column = 0; column < kQuads; ++column) {
      const std::uint32_t a = row * (kQuads + 1) + column, above = a + kQuads + 1;
      primitive.indices.insert(primitive.indices.end(), {a, a + 1, above + 1, a, above + 1, above});
    }
  }
  return primitive;
}

class FineSurface : public VulkanTest {
 protected:
  // The same surface with the shadow of a lever on it; what is seen from both sides is shaded by fragment.
  Pair draw_hills(bool by_fragment, const render::RendererOptions& options) {
    scene::Scene scene;
    const auto gold = add_material(scene, {.name = "gold",
                                           .base_color = {1.0F, 0.76F, 0.33F, 1.0F},
                                           .metallic = 1.0F,
                                           .roughness = 0.4F,
                                           .double_sided = by_fragment});
    const auto grey = add_material(scene, {.name = "grey", .base_color = {0.5F, 0.5F, 0.5F, 1.0F}, .metallic = 0.0F});
    const glm::dmat4 tilted = glm::rotate(glm::dmat4(1.0), glm::radians(-60.0), glm::dvec3(1.0, 0.0, 0.0));
    add(scene, "hills", hills(gold), glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.3, -0.2)) * tilted);
    add(scene, "bar", lever(grey, 0.05, 0.02, 1), glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5, 0.1, 0.1)));
    return draw(scene, bare_frame(scene), options);
  }
};

// Triangles of about a pixel are shaded at their vertices: nobody sees the difference, and it is not the same program.
TEST_F(FineSurface, LooksAsItWouldByFragment) {
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

TEST_F(FineSurface, IsTheSameInOnePassAndInTwo) {
  const auto one = draw_hills(false, small(4, render::PassMode::Multiview));
  const auto two = draw_hills(false, small(4, render::PassMode::TwoPasses));
  EXPECT_EQ(one.left.rgba, two.left.rgba);
  EXPECT_EQ(one.right.rgba, two.right.rgba);
}

}  // namespace
}  // namespace afm::test
