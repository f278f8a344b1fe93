// SPDX-License-Identifier: Apache-2.0
#include "servo/session_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "support/scratch_folder.h"

namespace afm::servo {
namespace session_folder_test {

RecordedSession part(std::int64_t begin_ms, int ticks, scene::ServoState state) {
  RecordedSession session;
  session.material = "mica";
  session.parameters.contact.tip_radius.si = 50e-9;
  for (int i = 0; i < ticks; ++i) {
    scene::TipSample sample;
    sample.time_ns = (begin_ms + i) * 1'000'000;
    sample.servo_state = state;
    session.samples.push_back(sample);
  }
  return session;
}

TEST(SessionFolder, KeepsASessionUnderTheNextFreeName) {
  const support::ScratchFolder scratch;
  SessionFolder folder = SessionFolder::open(scratch.file("kept")).value();
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(folder.add(part(0, 100, scene::ServoState::Disarmed)));
    ASSERT_TRUE(folder.add(part(100, 100, scene::ServoState::Running)));
    ASSERT_TRUE(folder.end());
  }
  EXPECT_TRUE(std::filesystem::exists(scratch.file("kept/session-mica.afms")));
  EXPECT_TRUE(std::filesystem::exists(scratch.file("kept/session-mica-2.afms")));
}

TEST(SessionFolder, KeepsASessionOfAMaterialWithASlashInItsName) {
  const support::ScratchFolder scratch;
  SessionFolder folder = SessionFolder::open(scratch.file("kept")).value();
  RecordedSession running = part(0, 100, scene::ServoState::Running);
  running.material = "SiO2/Si";
  ASSERT_TRUE(folder.add(running));
  ASSERT_TRUE(folder.end());
  EXPECT_TRUE(std::filesystem::exists(scratch.file("kept/session-SiO2%2FSi.afms")));
}

TEST(SessionFolder, KeepsNothingOfASessionWithoutForce) {
  const support::ScratchFolder scratch;
  SessionFolder folder = SessionFolder::open(scratch.file("kept")).value();
  ASSERT_TRUE(folder.add(part(0, 100, scene::ServoState::Disarmed)));
  EXPECT_TRUE(std::filesystem::exists(scratch.file("kept/session-mica.afms")));  // file still growing
  testing::internal::CaptureStderr();
  ASSERT_TRUE(folder.end());
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::HasSubstr("not recorded: " + scratch.file("kept/session-mica.afms") + ", 0.1 s without force"));
  EXPECT_TRUE(std::filesystem::is_empty(scratch.file("kept")));
}

TEST(SessionFolder, SaysWhenItHasGone) {
  const support::ScratchFolder scratch;
  SessionFolder folder = SessionFolder::open(scratch.file("kept")).value();
  std::filesystem::remove(scratch.file("kept"));
  const auto added = folder.add(part(0, 1, scene::ServoState::Running));
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("cannot write"), std::string::npos);
}

}  // namespace session_folder_test
}  // namespace afm::servo
