// SPDX-License-Identifier: Apache-2.0
// Invariant: changing modes, sizes and panels for hours leaks no memory
#include <dlfcn.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "render/depth_meter.h"
#include "render/screenshot_queue.h"
#include "support/faulty_device.h"
#include "support/places.h"
#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace long_run_test {

constexpr int kWarmUpRounds = 3;
constexpr int kRounds = 9;
constexpr int kFrames = 12;                // per round
constexpr std::int64_t kLeak_bytes = 200;  // per frame; larger leaks are detected

std::int64_t median(std::array<std::int64_t, kRounds> values) {
  std::sort(values.begin(), values.end());
  return values[kRounds / 2];
}

// Memory of the process and its device. On a CPU device the driver's memory is the process's, too.
struct Held {
  std::size_t heap_bytes = 0;
  int device_allocations = 0;
};

class LongRun : public testing::Test {
 protected:
  LongRun() : context_(open()), layer_(dlopen(support::fault_layer().c_str(), RTLD_NOW | RTLD_NOLOAD)) {
    if (layer_ == nullptr) throw std::runtime_error("the layer is not loaded");
    live_allocations_ = reinterpret_cast<int (*)()>(dlsym(layer_, "afm_live_allocations"));
  }
  ~LongRun() override { dlclose(layer_); }

  static render::Context open() {
    const FaultyDevice counted("count");
    auto context = render::Context::open();
    if (!context) throw std::runtime_error(context.error().message);
    return std::move(*context);
  }

  Held held() const { return {mallinfo2().uordblks, live_allocations_()}; }

  // What hours of a session bring: other modes, sizes, details and eyes, panels that come, change and go, pictures that
  // are saved and read, depth that is measured. Every round ends as it began.
  void play_round(render::Renderer& renderer, render::ScreenshotQueue& saver, render::DepthMeter& meter) const {
    for (int i = 0; i < kFrames; ++i) {
      render::FrameState frame = whole_;
      frame.labels.resize(static_cast<std::size_t>(i % 4));
      frame.panels.banner.content.guidance += std::string(static_cast<std::size_t>(i), '!');
      frame.panels.force.content.curves.front().retract.resize(static_cast<std::size_t>(10 * i));
      frame.panels.data.placement.right_m *= 1.0 - 0.02 * (i % 3);
      frame.room_from_node[test_.floor][3].z += i % 7;  // place past the eyes
      if (i % 5 == 0) frame.eyes[1] = frame.eyes[0];
      if (i % 6 == 0) {
        ASSERT_TRUE(renderer.resize(40 + 8 * static_cast<std::uint32_t>(i % 4), 30));
      }
      renderer.set_quality({.scale = i % 2 == 0 ? 1.0 : 0.6, .samples = i % 4 == 0 ? 1U : 4U});
      renderer.render(frame);
      meter.measure();
      const auto mode = scene::kStereoModes[static_cast<std::size_t>(i) % scene::kStereoModes.size()].mode;
      if (i % 10 == 0) saver.save({}, folder_.file("picture.png"));
      saver.collect();
      if (!scene::has_two_pictures(mode) && !scene::frame_packing(mode)) renderer.read_composed({.mode = mode});
    }
    saver.finish();
    meter.wait();
    renderer.wait();
  }

  TestScene test_ = make_test_scene();
  render::FrameState whole_ = full_frame(test_);
  support::ScratchFolder folder_;
  render::Context context_;
  void* layer_;
  int (*live_allocations_)() = nullptr;
};

// A leak grows in every round; what a driver keeps, once it has compiled one more variant of a shader, grows once (6 MB
// in one of eight runs). So it is the middle one of the rounds' growths that must be nothing.
TEST_F(LongRun, HoldsNoMoreMemoryAfterARoundThanBeforeIt) {
  auto options = small(4, render::PassMode::Automatic);
  options.eye_width = 40;
  options.eye_height = 30;
  auto renderer = render::Renderer::create(context_, test_.scene, options);
  ASSERT_TRUE(renderer) << renderer.error().message;
  render::ScreenshotQueue saver(context_, *renderer);
  render::DepthMeter meter(context_, *renderer);
  for (int round = 0; round < kWarmUpRounds; ++round) play_round(*renderer, saver, meter);
  const int device_allocations = held().device_allocations;
  EXPECT_GT(device_allocations, 20);
  std::array<std::int64_t, kRounds> growths_bytes{};
  for (std::int64_t& growth : growths_bytes) {
    const auto before = static_cast<std::int64_t>(held().heap_bytes);
    play_round(*renderer, saver, meter);
    growth = static_cast<std::int64_t>(held().heap_bytes) - before;
  }
  EXPECT_EQ(held().device_allocations, device_allocations);
  EXPECT_LT(median(growths_bytes), kFrames * kLeak_bytes) << testing::PrintToString(growths_bytes);
}

}  // namespace long_run_test
}  // namespace afm::test
