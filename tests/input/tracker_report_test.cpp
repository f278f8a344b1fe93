// SPDX-License-Identifier: Apache-2.0
// Invariant: frames that a tracker lost are logged
#include "input/tracker_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace afm::input {
namespace tracker_report_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Optional;

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(TrackerReport, NamesTheAddressOfATrackerThatNeverSpeaks) {
  TrackerReport report("127.0.0.1:5000", kSecond);
  EXPECT_FALSE(report.follow({}, 2 * kSecond));
  EXPECT_THAT(
      report.follow({.bad_packets = 7}, 7 * kSecond),
      Optional(HasSubstr(
          "no frame in 5 s, but 7 malformed packets: start the measurement, and send its output to 127.0.0.1:5000")));
  EXPECT_FALSE(report.follow({.bad_packets = 8}, 30 * kSecond)) << "once is enough";
}

TEST(TrackerReport, FollowsATrackerThatFallsSilentAndComesBack) {
  TrackerReport report("127.0.0.1:5000", kSecond);
  EXPECT_THAT(report.follow({.time_ns = kSecond, .good_packets = 1}, kSecond),
              Optional(std::string("tracker: receiving frames")));
  EXPECT_FALSE(report.follow({.time_ns = kSecond, .good_packets = 1}, 2 * kSecond));
  EXPECT_THAT(report.follow({.time_ns = kSecond, .good_packets = 1}, 2 * kSecond + 1),
              Optional(HasSubstr("no frame for 1 s")));
  EXPECT_THAT(report.follow({.time_ns = 9 * kSecond, .good_packets = 2}, 9 * kSecond),
              Optional(std::string("tracker: receiving frames again")));
}

TEST(TrackerReport, AddsUpWhatWasLost) {
  TrackerReport report("127.0.0.1:5000", 0);
  DtrackUpdate update{.time_ns = kSecond, .good_packets = 1};
  const auto after = [&](std::int64_t s) {
    update.time_ns = s * kSecond;
    update.good_packets += 60;
    return report.follow(update, s * kSecond);
  };
  after(1);
  EXPECT_FALSE(after(2));
  update.lost_frames = 3;
  update.old_packets = 1;
  EXPECT_FALSE(after(5)) << "not a line for each of them";
  EXPECT_THAT(after(12),
              Optional(HasSubstr("in 10 s: 241 frames received, 3 lost, 1 late or repeated, 0 malformed packets")));
  EXPECT_FALSE(after(22)) << "nothing more was lost";
  update.lost_frames = 5;
  EXPECT_THAT(after(32),
              Optional(AllOf(HasSubstr("in 10 s: 60 frames received, 2 lost, 0 late"), Not(HasSubstr(";")))));
  EXPECT_THAT(report.total(), HasSubstr("361 frames received, 5 lost, 1 late or repeated"));
}

// The frames of the one with smaller numbers are late.
TEST(TrackerReport, AsksWhetherTwoTrackersSendToOnePort) {
  TrackerReport report("127.0.0.1:5000", 0);
  DtrackUpdate update{.time_ns = kSecond, .good_packets = 1};
  report.follow(update, kSecond);
  report.follow(update, kSecond);
  update = {.time_ns = 12 * kSecond, .good_packets = 601, .old_packets = 600};
  EXPECT_THAT(report.follow(update, 12 * kSecond),
              Optional(HasSubstr("600 late or repeated, 0 malformed packets; check that only one tracker sends, and "
                                 "once, to 127.0.0.1:5000")));
}

TEST(TrackerReport, NamesEachKindOfFaultOnceWithItsLine) {
  TrackerReport report("127.0.0.1:5000", kSecond);
  const auto heard = [&](const std::string& lines) {
    DtrackUpdate update{.time_ns = kSecond, .good_packets = 1};
    update.frame = parse_dtrack("fr 1\n" + lines).value();
    update.faults = update.frame.faults;
    return report.follow(update, kSecond);
  };
  const std::string good = "[0 1][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1] ", zeros = "[4 1][0 0 0 0 0 0][0 0 0 0 0 0 0 0 0]";
  EXPECT_THAT(heard("6d 1 " + good), Optional(HasSubstr("receiving frames")));
  EXPECT_THAT(
      heard("6d 2 " + good + zeros),
      Optional(std::string("tracker: line 6d: body 4 is left out: its matrix is not a rotation (\"" + zeros + "\")")));
  EXPECT_FALSE(heard("6d 2 " + good + zeros)) << "once";
  EXPECT_THAT(heard("6d 2 " + good + "[5 1][0 0 0 0 0 0][0 0 0 0 0 0 0 0 0]"),
              Optional(HasSubstr("line 6d: body 5 is")));
  EXPECT_THAT(heard("6d 1 " + good + "\n6d 7"),
              Optional(HasSubstr("line 6d is left out: it does not have the number")));
}

TEST(TrackerReport, SaysThatTheHeadIsNotAmongTheBodies) {
  TrackerReport report("127.0.0.1:5000", kSecond, 2);
  DtrackUpdate update{.good_packets = 1};
  const auto after = [&](std::int64_t s, const std::string& body) {
    update.time_ns = s * kSecond;
    update.frame = parse_dtrack("fr 1\n6d 1 [" + body + "][1 2 3 0 0 0][1 0 0 0 1 0 0 0 1]").value();
    return report.follow(update, s * kSecond);
  };
  EXPECT_THAT(after(1, "0 1"), Optional(HasSubstr("receiving frames")));
  EXPECT_FALSE(after(1, "0 1"));
  EXPECT_FALSE(after(2, "3 1"));
  EXPECT_FALSE(after(6, "2 -1"));
  EXPECT_THAT(after(7, "2 -1"), Optional(HasSubstr("no pose of body 2, the head, for 5 s; of bodies: 0, 3")));
  EXPECT_FALSE(after(20, "0 1")) << "once";
  TrackerReport another("127.0.0.1:5000", kSecond, 2);
  another.follow(update, 21 * kSecond);
  another.follow(update, 21 * kSecond);
  after(22, "2 1");
  EXPECT_FALSE(another.follow(update, 22 * kSecond));
  after(23, "0 1");
  EXPECT_FALSE(another.follow(update, 40 * kSecond) == std::nullopt) << "silent";
  EXPECT_FALSE(another.follow(update, 41 * kSecond)) << "the head was seen";
}

}  // namespace tracker_report_test
}  // namespace afm::input
