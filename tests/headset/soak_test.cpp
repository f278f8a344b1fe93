// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>

#include "headset_fixture.h"

// Whatever a runtime does, and in whatever order: the picture comes back, nothing is called against the specification,
// no message of Vulkan's layers comes, and memory stays. AFM_HEADSET_SOAK: how many things it does.
namespace afm::test {
namespace {

using render::Headset;

constexpr int kActions = 600;                         // some 20 s
constexpr std::size_t kMostGrowth_bytes = 4'000'000;  // of the second half; one kept eye image is 200 kB

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

  // Frames as they come, drawn or not.
  void go_on(int turns) {
    for (int i = 0; i < turns; ++i) {
      if (turn() != Headset::Turn::Frame) continue;
      if (const auto eyes = headset_->locate_eyes()) {
        frame_.eyes = {(*eyes)[0].view, (*eyes)[1].view};
        renderer_->render(frame_);
      }
      headset_->show([] {});
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
};

TEST_F(HeadsetSoak, TheRuntimeDoesWhatItLikes) {
  const char* asked = std::getenv("AFM_HEADSET_SOAK");
  const int actions = asked == nullptr ? kActions : std::atoi(asked);
  ASSERT_GE(actions, kActions);
  stand_in::stand_in().keeps_frames = false;
  connect();
  std::mt19937 random(22);
  std::size_t half_bytes = 0;
  for (int i = 0; i < actions; ++i) {
    act(static_cast<unsigned>(random()));
    go_on(static_cast<int>(random() % 4));
    undo();
    ASSERT_TRUE(picture_comes_back()) << "after action " << i << "\n" << messages();
    go_on(1);
    headset_->take_messages();
    {
      const std::scoped_lock lock(stand_in::stand_in().mutex);
      log().calls.clear();
    }
    if (i == actions / 2) half_bytes = ::mallinfo2().uordblks;
  }
  EXPECT_LT(::mallinfo2().uordblks, half_bytes + kMostGrowth_bytes);
}

}  // namespace
}  // namespace afm::test
