// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <random>

#include "scene/display/stereo_layout.h"
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

// The fixture fails a test on any message of the validation layers, synchronisation validation among them.
namespace afm::test {
namespace storm_test {

class Storm : public VulkanTest {
 protected:
  TestScene test_ = make_test_scene();
};

// 200 steps of whatever a session may do in an hour, within a few seconds.
TEST_F(Storm, OfSizesModesAndSamplesIsDrawnWithoutAMessage) {
  std::mt19937 random(5);
  const auto any = [&](std::uint32_t from, std::uint32_t to) {
    return std::uniform_int_distribution<std::uint32_t>(from, to)(random);
  };
  const auto whole = full_frame(test_);
  const std::array modes{render::PassMode::Automatic, render::PassMode::Multiview, render::PassMode::TwoPasses};
  auto renderer = make_renderer(test_.scene, small());
  std::uint32_t samples = 4;
  glm::uvec2 size(256, 192);
  for (int step = 0; step < 200; ++step) {
    if (step % 25 == 24) {
      samples = any(0, 3) == 0 ? 1 : 4;
      renderer = make_renderer(test_.scene, small(samples, modes[any(0, 2)]));
      size = {256, 192};
    }
    if (any(0, 2) == 0) {
      size = {any(0, 5) == 0 ? 1 : any(1, 320), any(0, 5) == 0 ? 1 : any(1, 240)};
      ASSERT_TRUE(renderer.resize(size.x, size.y));
    }
    renderer.set_quality({.scale = 0.01 * any(1, 100), .samples = any(0, 1) == 0 ? 1 : samples});
    auto frame = whole;
    if (any(0, 3) == 0) frame.eyes[1] = frame.eyes[0];
    frame.room_from_node[test_.floor][3].z += any(0, 4);  // place past the eyes
    frame.labels.resize(any(0, static_cast<std::uint32_t>(frame.labels.size())));
    frame.panels.data.placement.right_m *= 0.1 * any(0, 12);
    renderer.render(frame);
    if (any(0, 4) == 0) {
      const auto mode = scene::kStereoModes[any(0, scene::kStereoModes.size() - 1)].mode;
      if (scene::has_two_pictures(mode)) continue;
      const auto picture = renderer.read_composed({.mode = mode});
      ASSERT_EQ(glm::uvec2(picture.width, picture.height), scene::picture_size(mode, size));
    }
    if (any(0, 4) == 0) renderer.read_eye(scene::Eye::Right);
  }
}

TEST_F(Storm, TheLongestPicturesThatTheDeviceTakesAreDrawn) {
  for (const glm::uvec2 size : {glm::uvec2(8192, 1), glm::uvec2(1, 8192), glm::uvec2(1, 1)}) {
    auto options = small(4);
    options.eye_width = size.x;
    options.eye_height = size.y;
    auto renderer = make_renderer(test_.scene, options);
    renderer.render(full_frame(test_));
    EXPECT_EQ(renderer.read_composed({}).width, 2 * size.x);
  }
}

}  // namespace storm_test
}  // namespace afm::test
