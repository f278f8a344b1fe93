// SPDX-License-Identifier: Apache-2.0
#include "servo/frame_log.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <sstream>

#include "core/file_descriptor.h"
#include "core/whole_file.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace frame_log_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kDegreeRad = 0.017453292519943295;
constexpr std::int64_t kMs = 1'000'000;

std::vector<std::string> lines_without_comments(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("#")) lines.push_back(line);
  }
  return lines;
}

TEST(FrameLog, HasALineForEachFrameWithWhatWasMeasured) {
  const support::ScratchFolder folder;
  const std::string path = folder.file("frames.csv");
  {
    auto log = FrameLog::create(path, 1000 * kMs);
    ASSERT_TRUE(log) << log.error().message;
    (*log)->add({.begun_ns = 1500 * kMs, .presented_ns = 1510 * kMs, .ipd_m = 0.063});
    (*log)->add({.begun_ns = 1516 * kMs,
                 .presented_ns = 1530 * kMs,
                 .head_latency_s = 0.0214,
                 .nearest_rad = kDegreeRad,
                 .farthest_rad = -0.5 * kDegreeRad,
                 .ipd_m = 0.0415,
                 .servo_late_us = 87,
                 .servo_missed = 3,
                 .pose_age_s = 0.00123,
                 .headset = "shown"});
    ASSERT_TRUE((*log)->finish());
  }
  const std::string text = core::read_file(path).value();
  EXPECT_THAT(text, StartsWith("# TouchAFM "));
  EXPECT_THAT(lines_without_comments(text),
              ElementsAre("frame,time_s,drawn_ms,interval_ms,head_latency_ms,nearest_deg,farthest_deg,ipd_mm,"
                          "servo_late_us,servo_missed,pose_age_ms,headset",
                          "0,0.500000,10.000,,,,,63.0,,0,,",
                          "1,0.516000,14.000,20.000,21.400,1.000,-0.500,41.5,87,3,1.230,shown"));
}

TEST(FrameLog, ReplacesAFileAndRefusesAFolder) {
  const support::ScratchFolder folder;
  const std::string path = folder.write("frames.csv", std::string(100'000, 'x'));
  ASSERT_TRUE((*FrameLog::create(path, 0))->finish());
  EXPECT_EQ(lines_without_comments(core::read_file(path).value()).size(), 1U);
  const auto refused = FrameLog::create(folder.file("nowhere/frames.csv"), 0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().category, core::ErrorCategory::Failed);
  EXPECT_THAT(refused.error().message, HasSubstr("--frame-log: cannot write "));
}

TEST(FrameLog, SaysAtTheEndThatTheDiskWasFull) {
  auto log = FrameLog::create("/dev/full", 0);
  ASSERT_TRUE(log);
  (*log)->add({.begun_ns = 1, .presented_ns = 2});
  const auto done = (*log)->finish();
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("No space left on device"));
}

TEST(FrameLog, WaitsForNoReaderOfAPipeIndefinitely) {
  const support::ScratchFolder folder;
  const std::string path = folder.file("pipe");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const auto refused = FrameLog::create(path, 0);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("no program reads from it"));

  const core::FileDescriptor idle(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  auto log = FrameLog::create(path, 0);
  ASSERT_TRUE(log) << log.error().message;
  for (int i = 0; i < 5000; ++i) (*log)->add({.begun_ns = 1, .presented_ns = 2});
  const auto done = (*log)->finish();
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("took nothing for 5 s"));
}

TEST(ServoLateness, IsThatOfTheTicksSinceTheFrameBefore) {
  ServoLateness lateness;
  scene::ServoTiming timing;
  EXPECT_FALSE(lateness.since_last(timing));
  timing.ticks = 3;
  timing.wake_us[900] = 1;
  timing.wake_us[20] = 2;
  EXPECT_EQ(lateness.since_last(timing), 900U);
  timing.ticks = 5;
  timing.wake_us[40] = 2;
  EXPECT_EQ(lateness.since_last(timing), 40U) << "the late one was long ago";
  EXPECT_FALSE(lateness.since_last(timing));
  timing.ticks = 6;
  timing.wake_us.back() = 1;
  timing.wake_max_us = 70'000;
  EXPECT_EQ(lateness.since_last(timing), 70'000U);
}

}  // namespace frame_log_test
}  // namespace afm::servo
