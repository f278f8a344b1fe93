// SPDX-License-Identifier: Apache-2.0
// Invariant: a tiled wall shows the same picture as a single one
#include <algorithm>
#include <array>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace tiles_test {

class Tiles : public VulkanTest {
 protected:
  // The part of the paper's wall from x to x + 1/2 and y to y + 1/2 of its size, from its lower left corner.
  static scene::Screen tile(double x, double y) {
    const scene::Screen whole = paper_screen();
    const glm::dvec3 right = whole.lower_right - whole.lower_left, up = whole.upper_left - whole.lower_left;
    const glm::dvec3 corner = whole.lower_left + x * right + y * up;
    return {"tile", corner, corner + 0.5 * right, corner + 0.5 * up};
  }
  TestScene test_ = make_test_scene();
};

// Each tile is drawn for its own screen; together they equal the wall drawn as a whole, with the background.
TEST_F(Tiles, TogetherAreTheWholeWall) {
  auto frame = bare_frame(test_.scene);
  auto renderer = make_renderer(test_.scene, small());
  renderer.render(frame);
  const std::array whole{renderer.read_eye(scene::Eye::Left), renderer.read_eye(scene::Eye::Right)};
  ASSERT_TRUE(renderer.resize(128, 96));
  std::array<render::Image, 2> tiled = whole;
  const std::array views = frame.eyes;
  for (const int column : {0, 1}) {
    for (const int row : {0, 1}) {
      for (std::size_t eye = 0; eye < 2; ++eye) {
        frame.eyes[eye] = scene::off_axis_view(tile(0.5 * column, 0.5 * (1 - row)), views[eye].eye_position_m,
                                               scene::DepthConvention::VulkanReversedInfinite, scene::kNearM, 0.0)
                              .value();
      }
      renderer.render(frame);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const auto part = renderer.read_eye(scene::kEyes[eye]);
        for (std::uint32_t y = 0; y < 96; ++y) {
          const auto from = part.rgba.begin() + std::ptrdiff_t{4} * 128 * y;
          const std::ptrdiff_t to = 256 * (std::ptrdiff_t{y} + 96 * row) + std::ptrdiff_t{128} * column;
          std::copy_n(from, 4 * 128, tiled[eye].rgba.begin() + 4 * to);
        }
      }
    }
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    // the last bit of a projection moves an edge over a sample here and there
    const Difference found = difference(whole[eye], tiled[eye], 2);
    EXPECT_LE(found.share_beyond, 0.0005) << found.largest;
    EXPECT_GT(difference(whole[eye], tiled[1 - eye], 2).share_beyond, 0.01);
  }
}

}  // namespace tiles_test
}  // namespace afm::test
