// SPDX-License-Identifier: Apache-2.0
#include "input/tracker_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace afm::input {
namespace tracker_report_test {

using ::testing::HasSubstr;
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
  EXPECT_THAT(after(32), Optional(HasSubstr("in 10 s: 60 frames received, 2 lost, 0 late")));
  EXPECT_THAT(report.total(), HasSubstr("361 frames received, 5 lost, 1 late or repeated"));
}

}  // namespace tracker_report_test
}  // namespace afm::input
