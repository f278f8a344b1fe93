// SPDX-License-Identifier: Apache-2.0
// Invariant: a lost or hanging graphics device or a dead X server leads to a released hand and a complete session
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "servo/session_file.h"
#include "support/faulty_device.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

// The program with a failing graphics device, simulated by a Vulkan layer in front of the driver.
namespace afm::app {
namespace device_failure_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> failing(const std::string& fault, std::vector<std::string> command) {
  command.insert(command.begin(), support::touchafm());
  return test::on_faulty_device(fault, command);
}

// Last line, without a sanitizer's warnings about its symbolizer, which may be too slow.
std::string last_line(std::string text) {
  for (;;) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const std::string line = text.substr(text.rfind('\n') + 1);
    if (line.find("external symbolizer!") == std::string::npos) return line;
    text.resize(text.size() - line.size());
  }
}

class DeviceFailureTest : public ::testing::Test {
 protected:
  std::vector<std::string> view(const std::string& fault, std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"view",
                                 "--size",
                                 "320x240",
                                 "--frame-rate",
                                 "20",
                                 "--eye-width",
                                 "160",
                                 "--haptics",
                                 "sim",
                                 "--servo",
                                 support::servo_mode(),
                                 "--linger",
                                 "0"};
    all.insert(all.end(), more.begin(), more.end());
    return failing(fault, all);
  }

  // Expects one session in the folder that can be read and contains what was felt.
  static void expect_a_session(const std::string& folder) {
    std::vector<std::filesystem::path> kept;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) kept.push_back(entry.path());
    ASSERT_EQ(kept.size(), 1U);
    const auto session = servo::load_session(kept.front().string());
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_GT(session->samples.size(), 100U);
  }

  support::ScratchFolder folder_;
  support::VirtualDisplay display_{640, 480};
};

TEST_F(DeviceFailureTest, ALostDeviceEndsTheViewWithItsSessionKeptAndTheHandReleased) {
  const std::string sessions = folder_.file("sessions");
  support::LiveProgram program(view("lost:300", {"--record", sessions, "--material", "mica"}), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_EQ(support::run_program("DISPLAY=" + display_.name() + " xdotool mousemove 100 100 key 1").exit_code, 0);
  ASSERT_EQ(program.ends(), 1) << program.said();
  EXPECT_THAT(last_line(program.said()), AllOf(HasSubstr("error: the graphics device"), HasSubstr("was lost while")));
  EXPECT_THAT(program.said(), Not(HasSubstr("terminate")));
  expect_a_session(sessions);
}

TEST_F(DeviceFailureTest, AnXServerThatDiesEndsTheViewWithItsSessionKeptAndTheHandReleased) {
  const std::string sessions = folder_.file("sessions");
  support::LiveProgram program(view("nothing", {"--record", sessions}), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_EQ(support::run_program("DISPLAY=" + display_.name() + " xdotool mousemove 100 100 key 1").exit_code, 0);
  ASSERT_TRUE(program.says("jump to contact")) << program.said();
  display_.die();
  ASSERT_EQ(program.ends(), 1) << program.said();
  EXPECT_THAT(last_line(program.said()), HasSubstr("error: the display and its window were lost"));
  EXPECT_THAT(program.said(), Not(HasSubstr("the servo ended unexpectedly")));
  expect_a_session(sessions);
}

TEST_F(DeviceFailureTest, ASurfaceThatIsLostForGoodEndsTheViewAndItsForce) {
  const std::string sessions = folder_.file("sessions");
  support::LiveProgram program(view("surface:200", {"--record", sessions, "--material", "mica"}), display_.name());
  ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
  ASSERT_EQ(support::run_program("DISPLAY=" + display_.name() + " xdotool mousemove 100 100 key 1").exit_code, 0);
  ASSERT_EQ(program.ends(), 1) << program.said();
  EXPECT_THAT(last_line(program.said()), HasSubstr("error: the window's surface"));
  expect_a_session(sessions);
  const auto session = servo::load_session(sessions + "/session-mica.afms");
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_EQ(session->samples.back().servo_state, scene::ServoState::Disarmed);
}

TEST_F(DeviceFailureTest, ADeviceThatHangsIsGivenUp) {
  const std::string out = folder_.file("out.png");
  support::LiveProgram render(failing("hung:1", {"render", "--journey", "4", "--size", "64x48", "--out", out}), "");
  ASSERT_EQ(render.ends(), 1) << render.said();
  EXPECT_THAT(last_line(render.said()), AllOf(HasSubstr("error: the graphics device"), HasSubstr("within 120 s")));
  EXPECT_FALSE(std::filesystem::exists(out));

  support::LiveProgram live(view("hung:60"), display_.name());
  ASSERT_EQ(live.ends(), 1) << live.said();
  EXPECT_THAT(live.said(), HasSubstr("did not finish its work within 120 s"));
}

TEST_F(DeviceFailureTest, NoMemoryIsSaidInOneLine) {
  support::LiveProgram program(view("memory:3"), display_.name());
  ASSERT_EQ(program.ends(), 1) << program.said();
  EXPECT_THAT(last_line(program.said()), HasSubstr("error: out of memory on"));
}

TEST_F(DeviceFailureTest, ADemonstrationLeavesNothingHalfDone) {
  const std::string out = folder_.file("out");
  support::LiveProgram program(
      failing("lost:40", {"demo", "--out", out, "--eye-width", "160", "--servo", support::servo_mode()}),
      display_.name());
  ASSERT_EQ(program.ends(), 1) << program.said();
  EXPECT_THAT(last_line(program.said()), HasSubstr("was lost while"));
  EXPECT_TRUE(std::filesystem::is_empty(out));
}

}  // namespace device_failure_test
}  // namespace afm::app
