// SPDX-License-Identifier: Apache-2.0
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace golden_test {

class Golden : public VulkanTest {};

TEST_F(Golden, TheLitSceneLooksAsItDid) {
  const auto test = make_test_scene();
  auto frame = bare_frame(test.scene);
  frame.bends = {{.node = test.lever, .length = 1.0F, .end_deflection = -0.12F}};
  EXPECT_EQ(compare_with_golden(draw(test.scene, frame, small()).left, "lit-scene"), "");
}

TEST_F(Golden, ThePanelsLookAsTheyDid) {
  const auto test = make_test_scene();
  auto options = small();
  options.eye_width = 384;
  options.eye_height = 288;
  options.panel_texels_per_m = 252.0;
  EXPECT_EQ(compare_with_golden(draw(test.scene, full_frame(test), options).left, "panels"), "");
}

}  // namespace golden_test
}  // namespace afm::test
