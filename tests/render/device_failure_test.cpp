// SPDX-License-Identifier: Apache-2.0
// Invariant: a lost graphics device, a lost surface or lack of memory leads to one line of output
#include "render/device_failure.h"

#include <gmock/gmock.h>

#include <optional>
#include <string>

#include "support/faulty_device.h"
#include "support/vulkan_fixture.h"

// A layer between the program and the driver fails like real devices.
namespace afm::test {
namespace device_failure_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DeviceFailureTest : public testing::Test {
 protected:
  static render::Context open(const std::string& fault) {
    const FaultyDevice device(fault);
    auto context = render::Context::open();
    if (!context) throw std::runtime_error(context.error().message);
    return std::move(*context);
  }

  // Error thrown within a few frames, with the number of frames before it; empty if all are drawn.
  template <class Draw>
  static std::optional<std::string> failure_of(Draw&& draw) {
    try {
      for (int i = 0; i < 20; ++i) draw();
    } catch (const render::DeviceFailure& failure) {
      return failure.what();
    }
    return std::nullopt;
  }

  TestScene test_ = make_test_scene();
  render::FrameState frame_ = full_frame(test_);
};

TEST_F(DeviceFailureTest, ALostDeviceIsSaidInOneLineAndTakenDownInOrder) {
  auto context = open("lost:12");
  auto renderer = render::Renderer::create(context, test_.scene, small());
  ASSERT_TRUE(renderer);
  const auto said = failure_of([&] {
    frame_.panels.banner.content.guidance += '.';  // changed text, since unchanged contents are not drawn
    renderer->render(frame_);
  });
  ASSERT_TRUE(said);
  EXPECT_THAT(*said, AllOf(HasSubstr("was lost while drawing a frame"), HasSubstr(context.device_name()),
                           Not(HasSubstr("\n"))));

  // every other call throws it, too, and destroying the renderer throws nothing
  EXPECT_THROW(renderer->wait(), render::DeviceFailure);
  EXPECT_THROW(renderer->read_eye(scene::Eye::Left), render::DeviceFailure);
  EXPECT_THROW(renderer->read_composed({}), render::DeviceFailure);
  EXPECT_FALSE(renderer->resize(100, 100));
}

// Wherever the memory ends, it is an error of creation or of a frame, never a crash. A renderer and its first frame
// make some forty allocations.
TEST_F(DeviceFailureTest, AnyAllocationMayBeTheLast) {
  int refused = 0, failed = 0, drawn = 0;
  for (const int last : {1, 2, 4, 8, 12, 16, 20, 24, 28, 32, 60}) {
    auto context = open("memory:" + std::to_string(last));
    std::optional<core::Result<render::Renderer>> renderer;
    renderer.emplace(render::Renderer::create(context, test_.scene, small()));
    if (!*renderer) {
      EXPECT_THAT(renderer->error().message, HasSubstr("out of memory on " + context.device_name())) << last;
      EXPECT_EQ(renderer->error().category, core::ErrorCategory::Failed);
      ++refused;
      continue;
    }
    const auto said = failure_of([&] { (*renderer)->render(frame_); });
    if (said) {
      EXPECT_THAT(*said, AllOf(HasSubstr("out of memory"), HasSubstr("drawing a frame"))) << last;
      ++failed;
      continue;
    }

    // a request for more fails, too, and leaves everything unchanged
    ++drawn;
    std::optional<std::string> refusal;
    for (int i = 0; i < 30 && !refusal; ++i) {
      const auto resized = (*renderer)->resize(320, 240);
      if (!resized) refusal = resized.error().message;
    }
    ASSERT_TRUE(refusal);
    EXPECT_THAT(*refusal, HasSubstr("out of memory"));
  }
  EXPECT_GE(refused, 3);
  EXPECT_GE(failed, 2);
  EXPECT_GE(drawn, 1);
}

}  // namespace device_failure_test
}  // namespace afm::test
