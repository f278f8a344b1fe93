// SPDX-License-Identifier: Apache-2.0
// The real libhidapi, udev's library and all, on devices that umockdev pretends to have. Run by umockdev-wrapper.
// Invariant: hidapi opens, loses and reopens a wand
#include "input/hid_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "support/wand_port.h"

namespace afm::input {
namespace hid_source_test {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kCompact = "256F:0000C635";
constexpr const char* kCadMouse = "256F:0000C650";

// Tests with a computer into which a device can be plugged.
class HidSourceTest : public ::testing::Test {
 protected:
  void plug(const std::string& ids, const std::string& name) { port_.plug(ids, name); }
  void unplug() { port_.unplug(); }
  template <std::size_t Size>
  void send(const std::array<std::uint8_t, Size>& report) const {
    ASSERT_TRUE(port_.send(report));
  }

  // Polls as the wand's thread does until `done`, for a few seconds of this clock at most.
  template <class Done>
  WandState poll_until(HidSource& source, const Done& done) {
    WandState wand;
    for (int i = 0; i < 500; ++i) {
      clock_.now += 10'000'000;
      wand = source.poll();
      if (done(wand)) return wand;
    }
    ADD_FAILURE() << "in vain";
    return wand;
  }

  class HandClock final : public core::Clock {
   public:
    std::int64_t now_ns() const noexcept override { return now; }
    std::int64_t now = 1'000'000'000;
  };

  HandClock clock_;
  support::WandPort port_;
};

TEST_F(HidSourceTest, ListsAWandAndSaysThatItCanBeUsed) {
  plug(kCompact, "3Dconnexion SpaceMouse Compact");
  const auto found = find_hid_wands({});
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->size(), 1U);
  EXPECT_EQ(found->front().name, "3Dconnexion SpaceMouse Compact (256f:c635)");
  EXPECT_TRUE(found->front().is_wand);
  EXPECT_TRUE(found->front().usable) << found->front().said;
  EXPECT_EQ(found->front().said, "SpaceMouse Compact at /dev/hidraw1");
}

TEST_F(HidSourceTest, ListsAMouseAsNoWand) {
  plug(kCadMouse, "CadMouse");
  const auto found = find_hid_wands({});
  ASSERT_TRUE(found && found->size() == 1U);
  EXPECT_FALSE(found->front().is_wand);
  EXPECT_EQ(found->front().said, "CadMouse: not a wand");
}

TEST_F(HidSourceTest, FollowsAWandThroughPluggingUnpluggingAndPluggingAgain) {
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_FALSE((*source)->poll().connected);

  plug(kCompact, "SpaceMouse Compact");
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  send(std::array<std::uint8_t, 3>{3, 2, 0});
  WandState wand = poll_until(**source, [](const WandState& w) { return w.buttons != 0; });
  EXPECT_TRUE(wand.pressed(WandButton::Grab));
  send(std::array<std::uint8_t, 7>{1, 0x5e, 0x01, 0, 0, 0, 0});
  wand = poll_until(**source, [](const WandState& w) { return w.push.x > 0.0; });
  EXPECT_EQ(wand.push.x, 1.0);

  unplug();
  wand = poll_until(**source, [](const WandState& w) { return !w.connected; });
  EXPECT_EQ(wand.buttons, 0U);
  EXPECT_FALSE(wand.orientation_valid);
  EXPECT_EQ(wand.push, glm::dvec3(0.0));

  plug(kCompact, "SpaceMouse Compact");
  wand = poll_until(**source, [](const WandState& w) { return w.connected; });
  EXPECT_EQ(wand.buttons, 0U);
}

TEST_F(HidSourceTest, LogsReportsOfTheWrongLengthAndGoesOn) {
  plug(kCompact, "SpaceMouse Compact");
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  testing::internal::CaptureStderr();
  for (int i = 0; i < 10; ++i) {
    send(std::array<std::uint8_t, 4>{1, 0x5e, 0x01, 0xa2});
    (*source)->poll();
  }
  send(std::array<std::uint8_t, 3>{3, 1, 0});
  poll_until(**source, [](const WandState& wand) { return wand.pressed(WandButton::Select); });
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr(": 1 report not understood, the last of 4 bytes that begin with 0x01; if the wand"));
  EXPECT_THAT(log, HasSubstr(": 10 reports not understood"));
  EXPECT_THAT(log, Not(HasSubstr(": 2 reports"))) << "once a decade";
}

constexpr const char* kReceiver = "256F:0000C652";
constexpr const char* kDualSense = "054C:00000CE6";
constexpr std::array<std::uint8_t, 7> kPush{1, 0x5e, 0x01, 0, 0, 0, 0}, kRest{1, 0, 0, 0, 0, 0, 0};

// 3Dconnexion's receiver has five interfaces of one usage; the cap sends on any of them.
TEST_F(HidSourceTest, FollowsTheInterfaceOfAReceiverThatSpeaks) {
  for (std::size_t speaking = 0; speaking < 5; ++speaking) {
    for (int i = 0; i < 5; ++i) plug(kReceiver, "3Dconnexion Universal Receiver");
    const auto source = HidSource::open({}, HandPlace{}, clock_);
    ASSERT_TRUE(source) << source.error().message;
    poll_until(**source, [](const WandState& wand) { return wand.connected; });
    ASSERT_TRUE(port_.send(speaking, kPush));
    poll_until(**source, [](const WandState& wand) { return wand.push.x == 1.0; });
    ASSERT_TRUE(port_.send(speaking, std::array<std::uint8_t, 3>{3, 2, 0}));
    poll_until(**source, [](const WandState& wand) { return wand.pressed(WandButton::Grab); });
    while (port_.plugged()) unplug();
    poll_until(**source, [](const WandState& wand) { return !wand.connected && wand.buttons == 0; });
  }
}

TEST_F(HidSourceTest, FollowsTheWandThatIsUsedOnceTheOtherRests) {
  plug(kCompact, "SpaceMouse Compact");
  plug(kCompact, "SpaceMouse Compact");
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  ASSERT_TRUE(port_.send(0, std::array<std::uint8_t, 3>{3, 1, 0}));
  poll_until(**source, [](const WandState& wand) { return wand.pressed(WandButton::Select); });
  // while a button of the first is down, the second does not take over
  ASSERT_TRUE(port_.send(1, kPush));
  for (int i = 0; i < 200; ++i) {
    clock_.now += 10'000'000;
    ASSERT_TRUE((*source)->poll().pressed(WandButton::Select));
  }
  ASSERT_TRUE(port_.send(0, std::array<std::uint8_t, 3>{3, 0, 0}));
  ASSERT_TRUE(port_.send(1, kRest));
  poll_until(**source, [](const WandState& wand) { return wand.buttons == 0; });
  ASSERT_TRUE(port_.send(1, kPush));
  poll_until(**source, [](const WandState& wand) { return wand.push.x == 1.0; });
}

// A gamepad that is only charged sends its state all the time.
TEST_F(HidSourceTest, DoesNotFollowAWandThatOnlyLiesThere) {
  testing::internal::CaptureStderr();
  plug(kDualSense, "DualSense");
  plug(kCompact, "SpaceMouse Compact");
  std::array<std::uint8_t, 64> lying{};
  lying[0] = 1;
  lying[1] = lying[2] = lying[3] = lying[4] = 128;
  lying[8] = 8;
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  ASSERT_TRUE(port_.send(1, kPush));
  poll_until(**source, [](const WandState& wand) { return wand.push.x == 1.0; });
  for (int i = 0; i < 400; ++i) {
    clock_.now += 10'000'000;
    lying[1] = lying[2] = static_cast<std::uint8_t>(127 + i % 3);
    port_.send(0, lying);
    ASSERT_EQ((*source)->poll().push.x, 1.0) << i;
  }
  EXPECT_THAT(testing::internal::GetCapturedStderr(), Not(HasSubstr("not understood")));
}

TEST_F(HidSourceTest, OpensAWandPluggedInBesideAnother) {
  plug(kCompact, "SpaceMouse Compact");
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  plug(kReceiver, "3Dconnexion Universal Receiver");
  for (int i = 0; i < 300; ++i) {
    clock_.now += 10'000'000;
    (*source)->poll();
  }
  ASSERT_TRUE(port_.send(1, kPush));
  poll_until(**source, [](const WandState& wand) { return wand.push.x == 1.0; });
  unplug();
  poll_until(**source, [](const WandState& wand) { return !wand.connected; });
  ASSERT_TRUE(port_.send(0, std::array<std::uint8_t, 3>{3, 1, 0}));
  poll_until(**source, [](const WandState& wand) { return wand.pressed(WandButton::Select); });
}

TEST_F(HidSourceTest, KeepsToTheWandThatIsNamed) {
  plug(kReceiver, "3Dconnexion Universal Receiver");
  plug(kCompact, "SpaceMouse Compact");
  for (const char* name : {"spacemouse comp", "256F:c635", "/dev/hidraw2"}) {
    const auto source = HidSource::open({}, HandPlace{}, clock_, name);
    ASSERT_TRUE(source) << source.error().message;
    poll_until(**source, [](const WandState& wand) { return wand.connected; });
    port_.send(0, kPush);
    for (int i = 0; i < 20; ++i) {
      clock_.now += 10'000'000;
      ASSERT_EQ((*source)->poll().push.x, 0.0) << name;
    }
    ASSERT_TRUE(port_.send(1, kPush));
    poll_until(**source, [](const WandState& wand) { return wand.push.x == 1.0; });
    ASSERT_TRUE(port_.send(1, kRest));
    poll_until(**source, [](const WandState& wand) { return wand.push.x == 0.0; });
  }
  const auto none = HidSource::open({}, HandPlace{}, clock_, "DualSense");
  ASSERT_TRUE(none);
  for (int i = 0; i < 20; ++i) {
    clock_.now += 100'000'000;
    EXPECT_FALSE((*none)->poll().connected);
  }
}

// A pedal that only stops the force can be used beside a wand, even a named one.
TEST_F(HidSourceTest, StopsByAPedalBesideTheWand) {
  HidMapping pedal{.name = "Pedal", .vendor = 0x1234, .product = 0xab, .axes = {}, .buttons = {}};
  pedal.buttons.push_back({.button = WandButton::Stop, .report = 3, .byte = 1, .bit = 0});
  plug(kCompact, "SpaceMouse Compact");
  plug("1234:000000AB", "Pedal");
  const auto source = HidSource::open({pedal}, HandPlace{}, clock_, "SpaceMouse");
  ASSERT_TRUE(source) << source.error().message;
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  ASSERT_TRUE(port_.send(0, kPush));
  poll_until(**source, [](const WandState& wand) { return wand.push.x == 1.0; });
  ASSERT_TRUE(port_.send(1, std::array<std::uint8_t, 3>{3, 1, 0}));
  const WandState wand = poll_until(**source, [](const WandState& w) { return w.stops == 1; });
  EXPECT_EQ(wand.push.x, 1.0) << "the wand is followed still";
}

}  // namespace hid_source_test
}  // namespace afm::input
