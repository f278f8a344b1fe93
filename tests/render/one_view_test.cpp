// SPDX-License-Identifier: Apache-2.0
// Invariant: a graphics device without multiview draws the same bytes
#include <gmock/gmock.h>

#include <array>
#include <memory>

#include "render/depth_meter.h"
#include "support/faulty_device.h"
#include "support/vulkan_fixture.h"

// A device that cannot draw both eyes in one pass: the layer hides the feature, and the validation layer below it
// objects to every use of what was not asked for.
namespace afm::test {
namespace one_view_test {

class OneView : public testing::Test {
 protected:
  static render::Context open() {
    const FaultyDevice without_multiview("one-view");
    auto context = render::Context::open({.validation = render::Validation::On});
    if (!context) throw std::runtime_error(context.error().message);
    return std::move(*context);
  }

  // Images of both eyes, and of a wall in every mode.
  std::vector<render::Image> draw(render::Context& context) {
    auto renderer = render::Renderer::create(context, test_.scene, small(4, render::PassMode::Automatic));
    if (!renderer) throw std::runtime_error(renderer.error().message);
    renderer->render(full_frame(test_));
    std::vector<render::Image> pictures{renderer->read_eye(scene::Eye::Left), renderer->read_eye(scene::Eye::Right)};
    for (const scene::StereoModeTraits& named : scene::kStereoModes) {
      const render::Composition composition{.mode = named.mode, .warp = bent_, .blend = blend_};
      if (scene::has_two_pictures(named.mode)) {
        for (render::Image& picture : renderer->read_pair(composition)) pictures.push_back(std::move(picture));
      } else {
        pictures.push_back(renderer->read_composed(composition));
      }
    }
    return pictures;
  }

  TestScene test_ = make_test_scene();
  std::shared_ptr<const scene::WarpMesh> bent_{};
  std::shared_ptr<const scene::Blend> blend_{};
};

TEST_F(OneView, ShowsWhatADeviceWithMultiviewShows) {
  auto able = render::Context::open();
  ASSERT_TRUE(able) << able.error().message;
  auto unable = open();
  EXPECT_TRUE(able->draws_both_eyes_at_once());
  EXPECT_FALSE(unable.draws_both_eyes_at_once());
  const auto wanted = draw(*able), drawn = draw(unable);
  ASSERT_EQ(drawn.size(), wanted.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(drawn[i].rgba, wanted[i].rgba) << "picture " << i;
  EXPECT_THAT(unable.take_validation_messages(), testing::IsEmpty());
}

// A curved screen that is blended with another.
TEST_F(OneView, CorrectsAProjectorAsADeviceWithMultiviewDoes) {
  bent_ = std::make_shared<const scene::WarpMesh>(
      scene::WarpMesh{2, 2, {{{0, 0}, {0.1, 0}}, {{1, 0}, {1, 0.2}}, {{0, 1}, {0, 1}}, {{1, 1}, {0.9, 0.9}}}});
  scene::Blend blend;
  blend.fields = {{.width = {0, 0, 0.5, 0}}, {.low = {0.5, 0}, .high = {1.5, 1}, .width = {0.5, 0, 0, 0}}};
  blend_ = std::make_shared<const scene::Blend>(blend);
  auto able = render::Context::open();
  ASSERT_TRUE(able) << able.error().message;
  auto unable = open();
  const auto wanted = draw(*able), drawn = draw(unable);
  ASSERT_EQ(drawn.size(), wanted.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(drawn[i].rgba, wanted[i].rgba) << "picture " << i;
  EXPECT_THAT(unable.take_validation_messages(), testing::IsEmpty());
}

TEST_F(OneView, MeasuresDepthToo) {
  auto unable = open();
  auto renderer = render::Renderer::create(unable, test_.scene, small(1, render::PassMode::TwoPasses));
  ASSERT_TRUE(renderer) << renderer.error().message;
  render::DepthMeter meter(unable, *renderer);
  renderer->render(full_frame(test_));
  meter.measure();
  meter.wait();
  ASSERT_TRUE(meter.newest());
  EXPECT_LT(meter.newest()->nearest_m, meter.newest()->farthest_m);
  EXPECT_THAT(unable.take_validation_messages(), testing::IsEmpty());
}

TEST_F(OneView, RefusesToDrawBothEyesInOnePass) {
  auto unable = open();
  const auto renderer = render::Renderer::create(unable, test_.scene, small(1, render::PassMode::Multiview));
  ASSERT_FALSE(renderer);
  EXPECT_THAT(renderer.error().message, testing::HasSubstr("does not support multiview; draw them in two passes"));
}

}  // namespace one_view_test
}  // namespace afm::test
