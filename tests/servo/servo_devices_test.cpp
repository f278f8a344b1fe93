// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "core/clock.h"
#include "haptics/servo_loop.h"
#include "haptics/simulated_device.h"
#include "live_renderer.h"
#include "servo/servo_client.h"
#include "servo/servo_process.h"
#include "servo/session_file.h"
#include "support/paper_model.h"
#include "support/places.h"
#include "support/scratch_folder.h"

// touchafm-servo as a process, with a given device. The mock of the vendor's library plays a person by itself; no
// result depends on durations.
namespace afm::servo {
namespace servo_devices_test {

using scene::TipSample;

const std::string kServoProgram = support::built("bin/touchafm-servo");

// One cycle, which the mock plays again and again: two presses at the top, because a fault takes one to acknowledge,
// then half a second for the force to rise, down, and up. Contact lies at y = -20 mm; below some 35 mm no force may be
// switched on. The cycle is short, because 5 ms without a call of the driver, common on a busy machine, end it.
constexpr const char* kPerson =
    "0.0 0 40 0 0\n0.2 0 40 0 1\n0.25 0 40 0 0\n0.3 0 40 0 1\n0.35 0 40 0 0\n0.8 0 40 0 0\n1.1 0 -25 0 0\n1.4 0 40 0 "
    "0\n";

// Environment of one test's child processes.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { ::unsetenv(name_); }

 private:
  const char* name_;
};

class ServoDevices : public testing::Test {
 protected:
  ServoDevices() { side.store(scene::Selection{.material = test::kMica, .revision = 1}); }

  auto start(const std::string& choice) { return ServoProcess::spawn(kServoProgram, segment, side, {}, choice); }

  // Beats and collects samples until the condition holds.
  bool until(ServoProcess& servo, const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(100);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end || !servo.alive()) return condition();
      side.store(scene::RendererHeartbeat{.time_ns = core::MonotonicClock().now_ns(), .frame = ++frame});
      while (const auto sample = side.pop_sample()) samples.push_back(*sample);
      while (const auto event = side.pop_event()) events.push_back(*event);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
  }

  int exit_code(ServoProcess& servo) {
    until(servo, [&] { return !servo.alive(); });
    return servo.exit_status().value_or(-1);
  }

  scene::SharedSegment segment = std::move(*scene::SharedSegment::create(test::paper_model(), 0));
  scene::RendererSide side = segment.renderer_side();
  std::vector<TipSample> samples;
  std::vector<scene::TipEvent> events;
  std::uint64_t frame = 0;
};

TEST_F(ServoDevices, LetsACycleBeFeltThroughTheVendorsLibrary) {
  const support::ScratchFolder folder;
  const Environment library("TOUCHAFM_HD_LIBRARY", support::mock_hd());
  const Environment script("MOCK_HD_SCRIPT", folder.write("person.txt", kPerson));
  auto servo = start("hdapi");
  ASSERT_TRUE(servo) << servo.error().message;
  EXPECT_TRUE(until(**servo, [&] {
    return events.size() >= 2 &&
           std::any_of(samples.begin(), samples.end(), [](const TipSample& s) { return s.hand_force_n < -1.5; });
  }));
  const pid_t pid = (*servo)->pid();
  servo->reset();
  EXPECT_NE(::kill(pid, 0), 0);
  EXPECT_EQ(side.tip_state()->hand.force_n, (std::array<double, 3>{}));
}

// The same person, at an omega whose point of contact is 5 mm lower. The library's calls are made by a thread of the
// servo.
TEST_F(ServoDevices, LetsACycleBeFeltThroughForceDimensionsLibrary) {
  const support::ScratchFolder folder;
  const Environment library("TOUCHAFM_FD_LIBRARY", support::mock_dhd());
  const Environment script("MOCK_DHD_SCRIPT", folder.write("person.txt", kPerson));
  auto servo = start("forcedimension");
  ASSERT_TRUE(servo) << servo.error().message;
  EXPECT_TRUE(until(**servo, [&] {
    return events.size() >= 2 &&
           std::any_of(samples.begin(), samples.end(), [](const TipSample& s) { return s.hand_force_n < -1.5; });
  }));
  const pid_t pid = (*servo)->pid();
  servo->reset();
  EXPECT_NE(::kill(pid, 0), 0);
  EXPECT_EQ(side.tip_state()->hand.force_n, (std::array<double, 3>{}));
}

TEST_F(ServoDevices, EndsWithFourWhenTheNamedDeviceIsMissing) {
  auto no_library = start("hdapi");
  ASSERT_TRUE(no_library);
  EXPECT_EQ(exit_code(**no_library), 4);

  const Environment library("TOUCHAFM_HD_LIBRARY", support::mock_hd());
  const Environment fault("MOCK_HD_FAULT", "missing");
  auto no_device = start("hdapi");
  ASSERT_TRUE(no_device);
  EXPECT_EQ(exit_code(**no_device), 4);

  const Environment other_library("TOUCHAFM_FD_LIBRARY", support::mock_dhd());
  const Environment other_fault("MOCK_DHD_FAULT", "missing");
  auto no_omega = start("forcedimension");
  ASSERT_TRUE(no_omega);
  EXPECT_EQ(exit_code(**no_omega), 4);
}

TEST_F(ServoDevices, FallsBackToTheSimulatedHand) {
  auto servo = start("auto");
  ASSERT_TRUE(servo);
  EXPECT_TRUE(until(**servo, [&] { return samples.size() > 20; }));
  EXPECT_DOUBLE_EQ(samples.back().hand_height_m, 0.060);
}

TEST_F(ServoDevices, RefusesADeviceThatItDoesNotKnow) {
  for (const char* choice : {"falcon", "replay:", ""}) {
    auto servo = start(choice);
    ASSERT_TRUE(servo);
    EXPECT_EQ(exit_code(**servo), 2) << choice;
  }
  auto no_pad = start("gamepad");
  ASSERT_TRUE(no_pad);
  EXPECT_EQ(exit_code(**no_pad), 4);
  auto no_file = start("replay:/nowhere/x.afms");
  ASSERT_TRUE(no_file);
  EXPECT_EQ(exit_code(**no_file), 3);
}

// A cycle of the simulated hand in virtual time.
RecordedSession record_cycle() {
  auto recorded = std::move(*scene::SharedSegment::create(test::paper_model(), 0));
  auto renderer = recorded.renderer_side();
  haptics::SimulatedDevice device;
  auto loop = std::move(*haptics::ServoLoop::create(recorded, device, {}));
  renderer.store(scene::Selection{.material = test::kMica, .revision = 1});
  RecordedSession session;
  session.material = "mica";
  session.parameters = test::paper_model().materials[test::kMica];
  session.device = haptics::shared(device.spec());
  session.room_from_sample = test::paper_model().nodes[1].parent_from_node;
  session.rate_hz = 1000.0;
  std::uint32_t revision = 0;
  for (std::int64_t ms = 1; ms <= 2500; ++ms) {
    const auto aim = [&](double height_m, double seconds, bool pressed) {
      renderer.store(scene::HandScript{.target_m = {0.002, height_m, -0.001},
                                       .duration_s = seconds,
                                       .revision = ++revision,
                                       .turn_on_pressed = pressed ? 1U : 0U});
    };
    if (ms == 300) aim(0.060, 0.0, true);
    if (ms == 320) aim(0.060, 0.0, false);
    if (ms == 1000) aim(-0.010, 0.5, false);
    if (ms == 1600) aim(0.065, 0.5, false);
    renderer.store(scene::RendererHeartbeat{.time_ns = ms, .frame = static_cast<std::uint64_t>(ms)});
    loop->tick(1'000'000 * ms, 0);
    while (const auto sample = renderer.pop_sample()) session.samples.push_back(*sample);
    while (const auto event = renderer.pop_event()) session.events.push_back(*event);
  }
  return session;
}

TEST_F(ServoDevices, ReplaysASessionTickByTickToTheSameForces) {
  const support::ScratchFolder folder;
  const RecordedSession session = record_cycle();
  ASSERT_EQ(session.events.size(), 2U);
  const std::string file = folder.file("cycle.afms");
  ASSERT_TRUE(save_session(session, file));

  auto servo = start("replay:" + file);
  ASSERT_TRUE(servo) << servo.error().message;
  EXPECT_TRUE(until(**servo, [&] { return !samples.empty() && samples.back().tick > session.samples.size(); }));
  std::size_t compared = 0;
  for (const TipSample& played : samples) {
    const std::size_t index = played.tick - 1;  // one entry per tick
    if (index >= session.samples.size() || played.phase == physics::Phase::WaitForLift) continue;
    const TipSample& recorded = session.samples[index];
    if (recorded.phase == physics::Phase::WaitForLift) continue;
    ASSERT_EQ(played.tip.z_m, recorded.tip.z_m) << index;
    ASSERT_EQ(played.tip.force_n, recorded.tip.force_n) << index;
    ++compared;
  }
  EXPECT_GT(compared, 1500U);
}

// Error of a client whose servo ends.
core::Error end_of(const scene::SharedModel& model, const ServoChoice& choice) {
  auto client = ServoClient::start(model, 0, choice, kServoProgram);
  EXPECT_TRUE(client);
  core::Error error{core::ErrorCategory::Failed, "it goes on"};
  test::eventually([&] {
    const auto polled = (*client)->poll(test::now_ns());
    if (!polled) error = polled.error();
    return !polled;
  });
  return error;
}

// Another start would be refused, too, so that nobody tries it.
TEST(RefusingServo, SaysWhetherItRefusesTheSceneOrASetting) {
  scene::SharedModel too_slow = test::paper_model();  // a lever that follows the hand too late
  scene::SharedContact& mica = too_slow.materials[test::kMica];
  mica.law = physics::Law::Dmt;
  mica.contact.reduced_modulus = physics::Pressure(1.5e9);
  mica.contact.spring_constant = physics::Stiffness(40.0);
  mica.lever = {physics::Frequency(300e3), 2500.0, physics::Temperature(295.0)};
  mica.free_amplitude_m = 20e-9;
  mica.drive_hz = 300e3;
  const core::Error scene = end_of(too_slow, {});
  EXPECT_EQ(scene.category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(scene.message, testing::HasSubstr("the servo cannot make this scene or session felt: the line above"));
  const core::Error setting = end_of(test::paper_model(), {.settings = {.rate_hz = 10.0}});
  EXPECT_EQ(setting.category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(setting.message, testing::HasSubstr("the servo refuses its settings: the line above"));
}

}  // namespace servo_devices_test
}  // namespace afm::servo
