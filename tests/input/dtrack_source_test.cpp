// SPDX-License-Identifier: Apache-2.0
// A tracker's datagrams through a real socket of this machine.
#include "input/dtrack_source.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>

#include "support/network/loopback_sender.h"

namespace afm::input {
namespace dtrack_source_test {

class HandClock final : public core::Clock {
 public:
  std::int64_t now_ns() const noexcept override { return now; }
  std::int64_t now = 1'000'000'000;
};

DtrackSettings on_any_port() {
  DtrackSettings settings;
  settings.port = 0;
  return settings;
}

const std::string kFlystick =
    "fr 1\n6d 1 [2 1.000][0 0 1700 0 0 0][1 0 0 0 1 0 0 0 1]\n"
    "6df2 1 1 [0 1.000 6 2][1000 2000 3000][1 0 0 0 1 0 0 0 1][3 0.50 -1.00]\n";

TEST(DtrackSource, TurnsATrackersFrameIntoTheRooms) {
  HandClock clock;
  DtrackSettings settings = on_any_port();
  // z upwards becomes y upwards, and the origin lies a metre to the right
  settings.tracker_origin_m = {1.0, 0.0, 0.0};
  settings.room_from_tracker = glm::angleAxis(-std::numbers::pi / 2.0, glm::dvec3(1, 0, 0));
  const auto source = DtrackSource::open(settings, clock);
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_FALSE((*source)->poll().connected);
  EXPECT_TRUE(support::LoopbackSender((*source)->port()).send(kFlystick));
  const WandState wand = (*source)->poll();
  ASSERT_TRUE(wand.connected && wand.orientation_valid && wand.position_valid);
  EXPECT_LT(glm::distance(wand.position_m, glm::dvec3(2.0, 3.0, -2.0)), 1e-9);
  EXPECT_TRUE(wand.pressed(WandButton::Select) && wand.pressed(WandButton::Grab));
  EXPECT_FALSE(wand.pressed(WandButton::Home));
  EXPECT_EQ(wand.push, glm::dvec3(0.5, 0.0, 1.0));
  const DtrackUpdate update = (*source)->newest();
  ASSERT_NE(update.frame.body(2), nullptr);
  EXPECT_NEAR(in_room(*update.frame.body(2), settings).position_m.y, 1.7, 1e-9);
}

TEST(DtrackSource, LetsGoOfEverythingWhenTheTrackerFallsSilent) {
  HandClock clock;
  const auto source = DtrackSource::open(on_any_port(), clock);
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_TRUE(support::LoopbackSender((*source)->port()).send(kFlystick));
  EXPECT_TRUE((*source)->poll().connected);
  clock.now += 240'000'000;
  EXPECT_TRUE((*source)->poll().connected);
  clock.now += 20'000'000;
  const WandState wand = (*source)->poll();
  EXPECT_FALSE(wand.connected || wand.orientation_valid);
  EXPECT_EQ(wand.buttons, 0U);
}

TEST(DtrackSource, CountsGarbageAndGoesOn) {
  HandClock clock;
  const auto source = DtrackSource::open(on_any_port(), clock);
  ASSERT_TRUE(source) << source.error().message;
  const support::LoopbackSender sender((*source)->port());
  std::mt19937 random(5);
  constexpr int kRounds = 100, kPackets = 100;
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < kPackets; ++i) {
      std::string packet(1 + random() % 200, '\0');
      for (char& c : packet) c = static_cast<char>(random());
      EXPECT_TRUE(sender.send(packet));
    }
    (*source)->poll();
  }
  EXPECT_TRUE(sender.send(kFlystick));
  EXPECT_TRUE((*source)->poll().connected);
  const DtrackUpdate update = (*source)->newest();
  EXPECT_EQ(update.bad_packets, static_cast<std::uint64_t>(kRounds * kPackets));
  EXPECT_EQ(update.good_packets, 1U);
}

// A frame that comes late or is sent again must not move a head or press a button.
TEST(DtrackSource, DropsFramesThatAreOlderThanTheNewest) {
  HandClock clock;
  const auto source = DtrackSource::open(on_any_port(), clock);
  ASSERT_TRUE(source) << source.error().message;
  const support::LoopbackSender sender((*source)->port());
  const auto heard = [&](std::uint32_t number, double x_mm) {
    EXPECT_TRUE(sender.send("fr " + std::to_string(number) + "\n6df2 1 1 [0 1.000 0 0][" + std::to_string(x_mm) +
                            " 0 0][1 0 0 0 1 0 0 0 1][]\n"));
    return (*source)->poll().position_m.x;
  };
  EXPECT_NEAR(heard(4294967290U, 100), 0.1, 1e-9);
  EXPECT_NEAR(heard(4294967290U, 200), 0.1, 1e-9) << "sent again";
  EXPECT_NEAR(heard(4294967000U, 300), 0.1, 1e-9) << "late";
  EXPECT_NEAR(heard(3, 400), 0.4, 1e-9) << "the numbers came round";
  EXPECT_EQ((*source)->newest().old_packets, 2U);
  clock.now += 260'000'000;
  EXPECT_NEAR(heard(1, 500), 0.5, 1e-9) << "the tracker was started anew";
}

TEST(DtrackSource, CountsTheFramesThatAreMissing) {
  HandClock clock;
  const auto source = DtrackSource::open(on_any_port(), clock);
  ASSERT_TRUE(source) << source.error().message;
  const support::LoopbackSender sender((*source)->port());
  const auto lost_after = [&](std::uint32_t number) {
    EXPECT_TRUE(sender.send("fr " + std::to_string(number) + "\n"));
    (*source)->poll();
    return (*source)->newest().lost_frames;
  };
  EXPECT_EQ(lost_after(10), 0U);
  EXPECT_EQ(lost_after(12), 0U) << "a tracker that sends every second frame";
  EXPECT_EQ(lost_after(18), 2U);
  EXPECT_EQ(lost_after(16), 2U) << "late";
  clock.now += 260'000'000;
  EXPECT_EQ(lost_after(900), 2U) << "after a silence the numbers begin anew";
  EXPECT_EQ(lost_after(902), 2U);
  EXPECT_EQ(lost_after(2'000'000'000), 2U) << "another tracker, no loss of two billion frames";
  EXPECT_EQ(lost_after(2'000'000'002), 2U);
}

TEST(DtrackSource, SaysWhyItCannotListen) {
  HandClock clock;
  const auto first = DtrackSource::open(on_any_port(), clock);
  ASSERT_TRUE(first);
  DtrackSettings taken;
  taken.port = (*first)->port();
  const auto second = DtrackSource::open(taken, clock);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_NE(second.error().message.find("cannot listen for a tracker at 127.0.0.1:"), std::string::npos);
  DtrackSettings elsewhere;
  elsewhere.address = "tracker.local";
  const auto third = DtrackSource::open(elsewhere, clock);
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().category, core::ErrorCategory::WrongUsage);
}

TEST(DtrackSource, JoinsAMulticastGroupBesideAnotherProgram) {
  HandClock clock;
  DtrackSettings settings = on_any_port();
  settings.address = "239.192.7.13";
  const auto first = DtrackSource::open(settings, clock);
  ASSERT_TRUE(first) << first.error().message;
  settings.port = (*first)->port();
  const auto second = DtrackSource::open(settings, clock);
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_TRUE(support::LoopbackSender(settings.port, "239.192.7.13").send(kFlystick));
  EXPECT_TRUE((*first)->poll().connected);
  EXPECT_TRUE((*second)->poll().connected);
}

TEST(DtrackSource, CountsWhatIsLeftOutAndKeepsTheLatest) {
  HandClock clock;
  const auto source = DtrackSource::open(on_any_port(), clock);
  ASSERT_TRUE(source) << source.error().message;
  const support::LoopbackSender sender((*source)->port());
  EXPECT_TRUE(sender.send("fr 1\n6d 2 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1] [4 1][0 0 0 0 0 0][0 0 0 0 0 0 0 0 0]\n"));
  (*source)->poll();
  EXPECT_TRUE(sender.send("fr 2\n6d 1 [0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]\n"));
  (*source)->poll();
  const DtrackUpdate update = (*source)->newest();
  EXPECT_EQ(update.good_packets, 2U);
  EXPECT_EQ(update.left_out, 1U);
  EXPECT_EQ(update.faults.first[0].id, 4U);
  EXPECT_TRUE(sender.send("nonsense"));
  (*source)->poll();
  EXPECT_EQ((*source)->newest().faults.first[0].line, "");
}

}  // namespace dtrack_source_test
}  // namespace afm::input
