// SPDX-License-Identifier: Apache-2.0
// Invariant: however a headset is lost, the hand is free within 350 ms, and the program finds it again
#include <algorithm>

#include "headset_fixture.h"

// Headsets that are taken off, lost, closed or frozen, and machines that have none.
namespace afm::test {
namespace losses_test {

using render::Headset;
using ::testing::HasSubstr;
using ::testing::Not;

class HeadsetLosses : public HeadsetTest {
 protected:
  void say(std::initializer_list<XrSessionState> states) {
    for (const XrSessionState state : states) stand_in::stand_in().say(state);
  }
  void expect_lost() {
    for (int i = 0; i < 5 && turn() != Headset::Turn::Off; ++i) headset_->show();
    EXPECT_EQ(turn(), Headset::Turn::Off);
    EXPECT_THAT(messages(), HasSubstr("looking for it every 2 s"));
  }
  void expect_found_again() {
    EXPECT_FALSE(draw_next()) << "looked for before its time";
    clock_.go_on(Headset::kLookAgainNs);
    EXPECT_TRUE(draw_next());
  }
};

TEST_F(HeadsetLosses, AHeadsetThatIsTakenOffAndPutOnThreeTimesShowsThePictureEachTime) {
  connect();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(draw_next()) << i;
    say({XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_STOPPING});
    EXPECT_EQ(turn(), Headset::Turn::Off);
    EXPECT_FALSE(headset_->controller().connected) << "nobody holds it";
    EXPECT_EQ(turn(), Headset::Turn::Off);
    say({XR_SESSION_STATE_READY});
  }
  EXPECT_TRUE(draw_next());
  EXPECT_EQ(std::count(log().calls.begin(), log().calls.end(), "xrCreateSession"), 1);
  EXPECT_EQ(std::count(log().calls.begin(), log().calls.end(), "xrBeginSession"), 4);
  EXPECT_EQ(std::count(log().calls.begin(), log().calls.end(), "xrEndSession"), 3);
}

TEST_F(HeadsetLosses, StoppingInTheMiddleOfAFrameEndsTheFrameFirst) {
  connect();
  ASSERT_TRUE(draw_next());
  ASSERT_EQ(turn(), Headset::Turn::Frame);
  say({XR_SESSION_STATE_STOPPING});
  ASSERT_TRUE(headset_->locate_eyes([] {}));
  headset_->show();
  EXPECT_EQ(turn(), Headset::Turn::Off);
  say({XR_SESSION_STATE_READY});
  EXPECT_TRUE(draw_next());
}

TEST_F(HeadsetLosses, StoppingWhileAFrameIsWaitedForEndsThatFrameFirst) {
  connect();
  ASSERT_TRUE(draw_next());
  script().blocked = true;
  ASSERT_EQ(turn(), Headset::Turn::Frozen);
  {
    const std::scoped_lock lock(stand_in::stand_in().mutex);
    say({XR_SESSION_STATE_STOPPING});
    script().blocked = false;
  }
  EXPECT_EQ(turn(), Headset::Turn::Off);
  {
    const std::scoped_lock lock(stand_in::stand_in().mutex);
    say({XR_SESSION_STATE_READY});
  }
  EXPECT_TRUE(draw_next());
}

TEST_F(HeadsetLosses, ASessionThatIsClosedOrAboutToBeLostIsLookedForAgain) {
  connect();
  for (const XrSessionState end : {XR_SESSION_STATE_EXITING, XR_SESSION_STATE_LOSS_PENDING}) {
    ASSERT_TRUE(draw_next());
    say({end});
    expect_lost();
    expect_found_again();
  }
}

TEST_F(HeadsetLosses, ALossInAnyCallIsFollowedByANewSession) {
  connect();
  for (const XrResult loss : {XR_ERROR_INSTANCE_LOST, XR_ERROR_SESSION_LOST}) {
    for (const char* call :
         {"xrPollEvent", "xrWaitFrame", "xrBeginFrame", "xrSyncActions", "xrLocateViews", "xrAcquireSwapchainImage",
          "xrWaitSwapchainImage", "xrReleaseSwapchainImage", "xrEndFrame"}) {
      ASSERT_TRUE(draw_next()) << call;
      script().failing[call] = loss;
      // the frame in which it fails, and the one that notices
      for (int i = 0; i < 3 && script().failing.count(call) > 0; ++i) {
        if (turn() != Headset::Turn::Frame) continue;
        headset_->locate_eyes([] {});
        headset_->show();
      }
      expect_lost();
      expect_found_again();
    }
  }
}

TEST_F(HeadsetLosses, ALossWhileTheSessionIsMadeIsLookedForAgain) {
  connect();
  for (const char* call : {"xrCreateSession", "xrCreateSwapchain", "xrAttachSessionActionSets", "xrBeginSession"}) {
    ASSERT_TRUE(draw_next()) << call;
    say({XR_SESSION_STATE_EXITING});
    expect_lost();
    script().failing[call] = XR_ERROR_INSTANCE_LOST;
    clock_.go_on(Headset::kLookAgainNs);
    EXPECT_FALSE(draw_next()) << call;
    clock_.go_on(Headset::kLookAgainNs);
  }
  EXPECT_TRUE(draw_next());
}

TEST_F(HeadsetLosses, ARuntimeThatIsGoneIsSaidOnceAndFoundWhenItIsBack) {
  connect();
  ASSERT_TRUE(draw_next());
  script().available = false;
  script().failing["xrWaitFrame"] = XR_ERROR_INSTANCE_LOST;
  expect_lost();
  clock_.go_on(Headset::kLookAgainNs);
  turn();
  EXPECT_THAT(messages(), HasSubstr("XR_ERROR_RUNTIME_UNAVAILABLE"));
  for (int i = 0; i < 3; ++i) {
    clock_.go_on(Headset::kLookAgainNs);
    turn();
    EXPECT_EQ(messages(), "");
  }
  script().available = true;
  clock_.go_on(Headset::kLookAgainNs);
  EXPECT_TRUE(draw_next());
}

// The heartbeat continues for the time that a hand may be held without a picture, and no longer.
TEST_F(HeadsetLosses, AFrozenRuntimeIsWaitedForWithBeatsFor250MsAndThenWithout) {
  connect();
  ASSERT_TRUE(draw_next());
  script().blocked = true;
  beats_ = 0;
  EXPECT_EQ(turn(), Headset::Turn::Frozen);
  EXPECT_GE(beats_, 40);
  EXPECT_LE(beats_, 50);
  beats_ = 0;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(turn(), Headset::Turn::Frozen);
  EXPECT_EQ(beats_, 0);
  EXPECT_THAT(messages(), Not(HasSubstr("restart it")));
  clock_.go_on(10'000'000'000);
  EXPECT_EQ(turn(), Headset::Turn::Frozen);
  EXPECT_THAT(messages(), HasSubstr("restart it"));
  EXPECT_EQ(turn(), Headset::Turn::Frozen);
  EXPECT_EQ(messages(), "") << "said once";
  {
    const std::scoped_lock lock(stand_in::stand_in().mutex);
    script().blocked = false;
  }
  EXPECT_TRUE(draw_next());
}

// The wearer sees the last picture for as long as no image is lent, which the loop has to know.
TEST_F(HeadsetLosses, ARuntimeThatLendsNoImageIsWaitedForWithBeatsAndNotedAsUnseen) {
  connect();
  ASSERT_TRUE(draw_next());
  EXPECT_TRUE(shown_);
  script().lends = false;
  beats_ = 0;
  EXPECT_FALSE(draw_next());
  EXPECT_FALSE(shown_);
  EXPECT_GE(beats_, 50);
  EXPECT_THAT(log().frames.back().eyes, testing::IsEmpty());
  script().lends = true;
  ASSERT_TRUE(draw_next());
  EXPECT_TRUE(shown_);
}

TEST_F(HeadsetLosses, ANameThatIsNoTextIsPrintedSafely) {
  script().name = "\x1b[2J" + std::string(XR_MAX_SYSTEM_NAME_SIZE, 'x');  // name without an end
  connect();
  EXPECT_EQ(runtime_->headset_name().find('\x1b'), std::string::npos);
  EXPECT_LE(runtime_->headset_name().size(), XR_MAX_SYSTEM_NAME_SIZE + 2U);
}

TEST_F(HeadsetLosses, MissingPartsAreNamedInOneLine) {
  const auto refusal = [] {
    const auto runtime = render::HeadsetRuntime::connect("/etc/runtime.json");
    EXPECT_FALSE(runtime);
    EXPECT_EQ(runtime.error().category, core::ErrorCategory::DeviceMissing);
    EXPECT_THAT(runtime.error().message, Not(HasSubstr("\n")));
    return runtime.error().message;
  };
  script().available = false;
  EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("XR_ERROR_RUNTIME_UNAVAILABLE"), HasSubstr("/etc/runtime.json"),
                                        HasSubstr("install libopenxr-loader1")));
  script().available = true;
  script().headset_plugged_in = false;
  EXPECT_THAT(refusal(), HasSubstr("XR_ERROR_FORM_FACTOR_UNAVAILABLE"));
  script().headset_plugged_in = true;
  script().eye_width = 0;
  EXPECT_THAT(refusal(), HasSubstr("recommends pictures of 0 x 192 pixels"));
  script().eye_width = 256;
  ::setenv("XR_RUNTIME_JSON", "/nonexistent.json", 1);
  EXPECT_THAT(refusal(), HasSubstr("XR_ERROR_RUNTIME_UNAVAILABLE"));
}

}  // namespace losses_test
}  // namespace afm::test
