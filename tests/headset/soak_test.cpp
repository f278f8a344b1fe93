// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>

#include "headset_fixture.h"

// Whatever a runtime does, and in whatever order: the picture comes back, nothing is called against the specification,
// no message of Vulkan's layers comes, and memory stays. AFM_HEADSET_SOAK: how many things it does in each test.
namespace afm::test {
namespace soak_test {

using render::Headset;

constexpr int kActions = 400;                // some 10 s
constexpr double kMostGrowth_bytes = 8'000;  // per action; one leaked eye image is 200 kB

class HeadsetSoak : public HeadsetTest {
 protected:
  void act(unsigned what) {
    static constexpr std::array kCalls{"xrPollEvent",
                                       "xrWaitFrame",
                                       "xrBeginFrame",
                                       "xrSyncActions",
                                       "xrLocateViews",
                                       "xrAcquireSwapchainImage",
                                       "xrWaitSwapchainImage",
                                       "xrReleaseSwapchainImage",
                                       "xrEndFrame",
                                       "xrCreateSession",
                                       "xrCreateSwapchain",
                                       "xrBeginSession",
                                       "xrEndSession",
                                       "xrGetSystem",
                                       "xrCreateReferenceSpace"};
    stand_in::StandIn& runtime = stand_in::stand_in();
    const std::scoped_lock lock(runtime.mutex);
    switch (what % 9) {
      case 0:
        for (const auto state : {XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_STOPPING}) {
          if (runtime.running) runtime.say(state);
        }
        break;
      case 1:
        runtime.say(XR_SESSION_STATE_EXITING);
        break;
      case 2:
        runtime.say(XR_SESSION_STATE_LOSS_PENDING);
        break;
      case 3:
      case 4:
        runtime.script.failing[kCalls[what / 9 % kCalls.size()]] =
            what % 2 == 0 ? XR_ERROR_INSTANCE_LOST : XR_ERROR_RUNTIME_FAILURE;
        break;
      case 5:
        runtime.script.should_render = false;
        break;
      case 6:
        runtime.script.tracked = false;
        break;
      case 7:
        runtime.script.blocked = true;
        break;
      default:
        runtime.recentered = true;
        for (XrPosef& eye : runtime.script.eyes) eye.position.x = 0.01F * static_cast<float>(what % 50);
        break;
    }
  }

  void undo() {
    stand_in::StandIn& runtime = stand_in::stand_in();
    const std::scoped_lock lock(runtime.mutex);
    runtime.script.should_render = runtime.script.tracked = true;
    runtime.script.blocked = false;
  }

  // Runs this many turns, with frames drawn or not.
  void go_on(int turns) {
    for (int i = 0; i < turns; ++i) {
      if (turn() != Headset::Turn::Frame) continue;
      if (const auto eyes = headset_->locate_eyes([] {})) {
        frame_.eyes = {(*eyes)[0].view, (*eyes)[1].view};
        frame_.panels_apart = headset_->most_panels();
        renderer_->render(frame_);
      }
      headset_->show();
    }
  }

  bool picture_comes_back() {
    stand_in::StandIn& runtime = stand_in::stand_in();
    for (int i = 0; i < 5; ++i) {
      if (draw_next()) return true;
      const std::scoped_lock lock(runtime.mutex);
      // put on again
      if (runtime.states.empty() && runtime.state == XR_SESSION_STATE_IDLE) runtime.say(XR_SESSION_STATE_READY);
      clock_.go_on(Headset::kLookAgainNs);
    }
    return false;
  }

  // Mean memory in use in either half: a session uses more of it with its layers than before them.
  std::array<double, 2> soak(int actions) {
    stand_in::stand_in().keeps_frames = false;
    connect();
    std::mt19937 random(22);
    std::array<double, 2> mean_bytes{};
    for (int i = 0; i < actions; ++i) {
      act(static_cast<unsigned>(random()));
      go_on(static_cast<int>(random() % 4));
      undo();
      if (!picture_comes_back()) {
        ADD_FAILURE() << "no picture after action " << i << "\n" << messages();
        return mean_bytes;
      }
      go_on(1);
      headset_->take_messages();
      {
        const std::scoped_lock lock(stand_in::stand_in().mutex);
        log().calls.clear();
      }
      mean_bytes[i < actions / 2 ? 0 : 1] += static_cast<double>(::mallinfo2().uordblks) / (0.5 * actions);
    }
    return mean_bytes;
  }

  static int actions() {
    const char* asked = std::getenv("AFM_HEADSET_SOAK");
    return asked == nullptr ? kActions : std::max(kActions, std::atoi(asked));
  }
};

TEST_F(HeadsetSoak, TheRuntimeDoesWhatItLikes) { soak(actions()); }

// Runs without Vulkan's layers, which keep something of every former image.
TEST_F(HeadsetSoak, MemoryStaysWhateverTheRuntimeDoes) {
  validation_ = render::Validation::Off;
  const auto [first_bytes, second_bytes] = soak(actions());
  EXPECT_LT(second_bytes, first_bytes + kMostGrowth_bytes * actions());
}

}  // namespace soak_test
}  // namespace afm::test
