// SPDX-License-Identifier: Apache-2.0
// The real libhidapi, udev's library and all, on devices that umockdev pretends to have. Run by umockdev-wrapper.
#include "input/hid_source.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "support/wand_port.h"

namespace afm::input {
namespace hid_source_test {

constexpr const char* kCompact = "256F:0000C635";
constexpr const char* kCadMouse = "256F:0000C650";

// With a computer into which a device can be plugged.
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

TEST_F(HidSourceTest, CountsReportsOfTheWrongLengthAndGoesOn) {
  plug(kCompact, "SpaceMouse Compact");
  const auto source = HidSource::open({}, HandPlace{}, clock_);
  ASSERT_TRUE(source) << source.error().message;
  poll_until(**source, [](const WandState& wand) { return wand.connected; });
  send(std::array<std::uint8_t, 4>{1, 0x5e, 0x01, 0xa2});
  poll_until(**source, [&](const WandState&) { return (*source)->refused_reports() == 1; });
  send(std::array<std::uint8_t, 3>{3, 1, 0});
  poll_until(**source, [](const WandState& wand) { return wand.pressed(WandButton::Select); });
}

}  // namespace hid_source_test
}  // namespace afm::input
