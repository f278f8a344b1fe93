// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <malloc.h>

#include <array>
#include <stdexcept>
#include <string>

#include "render/depth_meter.h"
#include "render/screenshot_queue.h"
#include "support/faulty_device.h"
#include "support/scratch_folder.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace {

constexpr int kRounds = 12;
constexpr int kFrames = 12;  // of each round

// What the process and its device hold. On a CPU device the driver's memory is the process's too.
struct Held {
  std::size_t heap_bytes = 0;
  int device_allocations = 0;
};

class LongRun : public testing::Test {
 protected:
  LongRun() : context_(open()), layer_(dlopen(AFM_FAULT_LAYER_FILE, RTLD_NOW | RTLD_NOLOAD)) {
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
      frame.banner.guidance += std::string(static_cast<std::size_t>(i), '!');
      frame.force_panel.curves.front().retract.resize(static_cast<std::size_t>(10 * i));
      frame.data_placement.right_m *= 1.0 - 0.02 * (i % 3);
      frame.room_from_node[test_.floor][3].z += i % 7;  // past the eyes
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

TEST_F(LongRun, HoldsNoMoreMemoryAtItsEndThanAfterAQuarter) {
  auto options = small(4, render::PassMode::Automatic);
  options.eye_width = 40;
  options.eye_height = 30;
  auto renderer = render::Renderer::create(context_, test_.scene, options);
  ASSERT_TRUE(renderer) << renderer.error().message;
  render::ScreenshotQueue saver(context_, *renderer);
  render::DepthMeter meter(context_, *renderer);
  std::array<Held, 2> seen{};
  for (int round = 0; round < kRounds; ++round) {
    play_round(*renderer, saver, meter);
    if (round == kRounds / 4) seen[0] = held();
  }
  seen[1] = held();
  EXPECT_GT(seen[0].device_allocations, 20);
  EXPECT_EQ(seen[1].device_allocations, seen[0].device_allocations);
  // a frame that kept three hundred bytes would keep more
  EXPECT_LE(seen[1].heap_bytes, seen[0].heap_bytes + 32768);
}

}  // namespace
}  // namespace afm::test
