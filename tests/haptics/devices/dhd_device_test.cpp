// SPDX-License-Identifier: Apache-2.0
// Invariant: a driver that fails leaves no force on the hand, on a stand-in for Force Dimension's library
#include "forcedimension/dhd_device.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "dhd_bench.h"
#include "support/no_alloc.h"

// The driver's thread runs only when a test says so: every millisecond here is the same in every run.
namespace dhd_device_test {

using namespace afm::haptics;
using afm::scene::FaultCode;
using afm::scene::ServoState;
using afm::test::DhdBench;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kSetForce = "dhdSetForceAndTorqueAndGripperForce";

std::vector<std::string> calls() {
  std::vector<std::string> all;
  for (int i = 0; const char* call = mock_dhd_call(i); ++i) all.emplace_back(call);
  return all;
}

// Expects no force without a lift and two presses, one of them for the fault.
void expect_rearming(DhdBench& bench) {
  bench.run(100);
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
  bench.move_to(60);
  bench.press_turn_on();
  EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
  bench.press_turn_on();
  EXPECT_EQ(bench.state().servo_state, ServoState::Arming);
}

TEST(DhdDevice, LetsACycleBeFeltWithinItsProfile) {
  DhdBench bench;
  bench.hold_attached();
  bench.move_to(60);
  EXPECT_EQ(bench.events.size(), 2U);
  EXPECT_NEAR(bench.largest_force_n, 2.0, 0.01);
  EXPECT_LE(bench.largest_force_n, force_cap_n(bench.device->spec()));
  EXPECT_LE(bench.largest_step_n, 0.5 + 1e-12);  // limit of the governor
  EXPECT_EQ(bench.health(), DhdHealth::Ready);
}

TEST(DhdDevice, AsksForGravityCompensationAWatchdogAndALimit) {
  const DhdBench bench;
  EXPECT_EQ(mock_dhd_gravity(), 1);
  EXPECT_EQ(mock_dhd_watchdog_ns(), DhdDevice::kWatchdogNs);
  EXPECT_EQ(mock_dhd_max_force(), 2.0);
}

TEST(DhdDevice, GoesWithoutWhatTheLibraryRefusesToSetUp) {
  DhdBench bench([] {
    mock_dhd_fail("dhdSetGravityCompensation", 6, -1);
    mock_dhd_fail("dhdGetEffectorMass", 6, -1);
    mock_dhd_fail("dhdSetMaxForce", 6, -1);
    mock_dhd_fail("dhdSetWatchdog", 6, -1);
  });
  bench.hold_attached();
  EXPECT_EQ(bench.health(), DhdHealth::Ready);
}

TEST(DhdDevice, TakesAClosedGripperForTheButton) {
  DhdBench bench([] { mock_dhd_set_gripper(1); });
  bench.hold_attached();
}

TEST(DhdDevice, IsNotDrivenBySlowerTicksThanItsForcesLast) {
  DhdBench bench;
  const auto loop = ServoLoop::create(bench.segment, *bench.device, {.rate_hz = 399.0});
  ASSERT_FALSE(loop);
  EXPECT_THAT(loop.error().message, HasSubstr("older than 5 ms; choose 400 Hz or more"));
}

TEST(DhdDevice, FadesToZeroWhenTheServoStopsWritingAndComesBackWithoutAKick) {
  for (const int pause_ms : {6, 15, 19, 500}) {
    SCOPED_TRACE(pause_ms);
    DhdBench bench;
    bench.hold_attached();
    bench.largest_step_n = 0;
    for (int ms = 0; ms < pause_ms; ++ms) bench.driver_tick();
    if (pause_ms >= 15) {
      EXPECT_EQ(bench.felt(), 0.0);
    }
    bench.run(300);
    EXPECT_LE(bench.largest_step_n, 0.2);
    // beyond 20 ms the governor itself has let go
    EXPECT_EQ(bench.state().servo_state, pause_ms < 20 ? ServoState::Running : ServoState::Disarmed);
  }
}

struct FaultCase {
  const char* name;
  void (*happens)();
  DhdHealth health;
  int recovers_after_ms;  // 0: never
  const char* said;
};

const FaultCase kFaultCases[] = {
    {"reading fails", [] { mock_dhd_fail("dhdGetPosition", 2, 1); }, DhdHealth::ConnectionLost, 0,
     "connection was lost; check cable and power, then start again; the driver said: mock: communication failed"},
    {"reading times out", [] { mock_dhd_fail("dhdGetPosition", 7, 1); }, DhdHealth::ConnectionLost, 0, "(error 7)"},
    {"no place has these angles", [] { mock_dhd_fail("dhdGetPosition", 8, 1); }, DhdHealth::ImplausiblePosition, 200,
     "impossible position"},
    {"an error without a number", [] { mock_dhd_fail("dhdGetPosition", 0, 1); }, DhdHealth::DeviceFault, 0,
     "it failed"},
    {"an error of tomorrow", [] { mock_dhd_fail("dhdGetPosition", 99, 1); }, DhdHealth::DeviceFault, 0, "(error 99)"},
    {"force not ready", [] { mock_dhd_fail(kSetForce, 12, 1); }, DhdHealth::ForceRefused, 200, "refused a force"},
    {"force fails", [] { mock_dhd_fail(kSetForce, 1, 1); }, DhdHealth::DeviceFault, 0, "it failed"},
    {"button fails", [] { mock_dhd_fail("dhdGetButton", 2, 1); }, DhdHealth::ButtonFailed, 200, "cannot be read"},
    {"unplugged", [] { mock_dhd_unplug(); }, DhdHealth::ConnectionLost, 0, "connection was lost"},
};

TEST(DhdDevice, TakesTheForceAwayWithinATickOfAnyErrorAndNamesIt) {
  for (const FaultCase& fault : kFaultCases) {
    SCOPED_TRACE(fault.name);
    DhdBench bench;
    bench.hold_attached();
    fault.happens();
    bench.run(1);
    EXPECT_EQ(bench.felt(), 0.0);
    EXPECT_EQ(bench.health(), fault.health);
    EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
    EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
    EXPECT_THAT(bench.log, Contains(AllOf(HasSubstr("omega.3, serial 1234: "), HasSubstr(fault.said))));
  }
}

TEST(DhdDevice, RecoversFromWhatPassesAndNeverFromALostDevice) {
  for (const FaultCase& fault : kFaultCases) {
    SCOPED_TRACE(fault.name);
    DhdBench bench;
    bench.hold_attached();
    fault.happens();
    bench.run(fault.recovers_after_ms == 0 ? 20'000 : fault.recovers_after_ms - 1);
    EXPECT_EQ(bench.health(), fault.health);
    EXPECT_EQ(bench.felt(), 0.0);
    if (fault.recovers_after_ms == 0) continue;
    bench.run(5);
    EXPECT_EQ(bench.health(), DhdHealth::Ready);
    expect_rearming(bench);
  }
}

struct CauseCase {
  int cause;
  DhdHealth health;
  int recovers_after_ms;  // 0: never
};

// The device itself has switched the force off; the status, read every 10 ms, says why.
TEST(DhdDevice, NamesWhyTheDeviceLeftForceMode) {
  for (const CauseCase& cut : {CauseCase{2, DhdHealth::VelocityExceeded, 200},
                               {3, DhdHealth::WatchdogExpired, 200},
                               {0, DhdHealth::ForceRefused, 200},
                               {4, DhdHealth::ForceRefused, 200},
                               {5, DhdHealth::ConnectionLost, 0}}) {
    SCOPED_TRACE(cut.cause);
    DhdBench bench;
    bench.hold_attached();
    mock_dhd_cut_force(cut.cause);
    EXPECT_EQ(bench.felt(), 0.0);
    bench.run(11);
    EXPECT_EQ(bench.health(), cut.health);
    EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
    bench.run(300);
    if (cut.recovers_after_ms == 0) continue;
    EXPECT_EQ(bench.health(), DhdHealth::Ready);
    expect_rearming(bench);
  }
}

// A person who switches the force off at the device wants it off.
TEST(DhdDevice, LeavesTheForceOffUntilTheUserSwitchesItOnAtTheDevice) {
  for (const auto& [cause, said] : {std::pair(1, "its force button is off"), std::pair(6, "dead-man switch")}) {
    SCOPED_TRACE(cause);
    DhdBench bench;
    bench.hold_attached();
    const auto before = std::ranges::count(calls(), "force_on");
    mock_dhd_cut_force(cause);
    bench.run(20'000);
    EXPECT_EQ(bench.felt(), 0.0);
    EXPECT_NE(bench.health(), DhdHealth::Ready);
    EXPECT_EQ(std::ranges::count(calls(), "force_on"), before);
    EXPECT_THAT(calls(), Not(Contains("brakes_off")));
    EXPECT_EQ(std::ranges::count_if(bench.log, [&](const auto& line) { return line.find(said) != std::string::npos; }),
              1);
    mock_dhd_press_force_button();
    EXPECT_EQ(bench.felt(), 0.0);
    bench.run(11);
    EXPECT_EQ(bench.health(), DhdHealth::Ready);
    expect_rearming(bench);
  }
}

TEST(DhdDevice, WaitsForItsCalibrationWithoutDisturbingIt) {
  DhdBench bench([] { mock_dhd_set_reset(1); });
  bench.run(500);
  EXPECT_EQ(bench.health(), DhdHealth::NeedsCalibration);
  EXPECT_THAT(bench.log, Contains(HasSubstr("put its calibration pin into the pit")));
  bench.press_turn_on();
  EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
  EXPECT_EQ(calls(), std::vector<std::string>{"open"});
  mock_dhd_set_reset(0);
  bench.run(15);
  EXPECT_EQ(bench.health(), DhdHealth::Ready);
}

// The SDK's example sends zero until the user has moved the grip.
TEST(DhdDevice, SendsZeroWhileAFalconIsCalibrated) {
  DhdBench bench([] {
    mock_dhd_set_devices(1, 60, "Falcon");
    mock_dhd_set_reset(1);
    mock_dhd_end_reset_after(100);
  });
  bench.run(90);
  EXPECT_EQ(bench.health(), DhdHealth::NeedsCalibration);
  EXPECT_THAT(bench.log, Contains(HasSubstr("Falcon: pull the grip out and push it in")));
  bench.run(30);
  EXPECT_EQ(bench.health(), DhdHealth::Ready);
}

TEST(DhdDevice, LosesItsForceWhenItIsCalibratedAnewOrLosesItsPower) {
  for (void (*happens)(int) : {mock_dhd_set_reset, +[](int on) { mock_dhd_set_power(1 - on); }}) {
    DhdBench bench;
    bench.hold_attached();
    happens(1);
    EXPECT_EQ(bench.felt(), 0.0);
    bench.run(11);
    EXPECT_NE(bench.health(), DhdHealth::Ready);
    EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
    happens(0);
    bench.run(15);
    EXPECT_EQ(bench.health(), DhdHealth::Ready);
    expect_rearming(bench);
  }
}

TEST(DhdDevice, SaysThatItHasNoPower) {
  DhdBench bench([] { mock_dhd_set_power(0); });
  bench.run(20);
  EXPECT_EQ(bench.health(), DhdHealth::NoPower);
  EXPECT_THAT(bench.log, Contains(HasSubstr("it has no power; switch it on")));
}

TEST(DhdDevice, LosesItsForceWhenItsStatusReportsAFault) {
  for (const bool connected : {true, false}) {
    DhdBench bench;
    bench.hold_attached();
    mock_dhd_set_connected(connected ? 1 : 0);
    mock_dhd_set_failed(connected ? 1 : 0);
    bench.run(11);
    EXPECT_EQ(bench.health(), connected ? DhdHealth::DeviceFault : DhdHealth::ConnectionLost);
    EXPECT_EQ(bench.felt(), 0.0);
  }
}

TEST(DhdDevice, IsNotBroughtBackByAFaultThatPasses) {
  DhdBench bench;
  bench.hold_attached();
  mock_dhd_fail("dhdGetPosition", 2, 1);
  bench.run(5);
  mock_dhd_fail("dhdGetButton", 2, 1);
  bench.run(500);
  EXPECT_EQ(bench.health(), DhdHealth::ConnectionLost);
}

TEST(DhdDevice, GivesNoForceWhileTheDeviceRefusesForceMode) {
  DhdBench bench([] { mock_dhd_fail("dhdEnableForce", 12, 1); });
  bench.run(2);
  EXPECT_EQ(bench.health(), DhdHealth::ForceRefused);
  bench.run(300);
  EXPECT_EQ(bench.health(), DhdHealth::Ready);
}

TEST(DhdDevice, BearsADeviceThatSwitchesItsForceOnSlowly) {
  DhdBench bench([] { mock_dhd_delay_force_mode(45); });
  for (int ms = 0; ms < 200; ++ms) {
    bench.run(1);
    ASSERT_EQ(bench.health(), DhdHealth::Ready) << ms;
  }
  bench.hold_attached();
}

// Positions of a moment ago are no failure, unless they stay.
TEST(DhdDevice, BearsTheTimeGuardForAMomentOnly) {
  DhdBench bench;
  bench.hold_attached();
  mock_dhd_answer("dhdGetPosition", 1, 9);
  bench.run(20);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  mock_dhd_answer("dhdGetPosition", 1, -1);
  bench.run(12);
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(bench.health(), DhdHealth::Stalled);
  EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
}

TEST(DhdDevice, SaysOnceThatItsMotorsAreSaturatedAndGoesOn) {
  DhdBench bench;
  bench.hold_attached();
  mock_dhd_answer(kSetForce, 2, -1);
  bench.run(9000);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  EXPECT_EQ(std::ranges::count_if(bench.log, [](const auto& l) { return l.find("whole force") != std::string::npos; }),
            1);
}

// The thread that calls the library is caught in it: the servo, the supervisor and the device each let go.
TEST(DhdDevice, IsNotHealthyWhileItsThreadHangsAndItsForceIsSwitchedOff) {
  DhdBench bench;
  bench.hold_attached();
  for (int ms = 0; ms < 11; ++ms) {
    bench.clock.time_ns += DhdBench::kPeriodNs;
    mock_dhd_set_time(bench.clock.time_ns);
    bench.servo_tick();
    EXPECT_EQ(bench.state().servo_state == ServoState::Fault, ms >= 10) << ms;
    if (const auto line = bench.device->supervise()) bench.log.push_back(*line);
  }
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(mock_dhd_brakes(), 1);
  EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
  EXPECT_THAT(bench.log, Contains(HasSubstr("stopped answering")));
  bench.run(100);
  EXPECT_EQ(bench.health(), DhdHealth::Ready);
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
}

TEST(DhdDevice, LeavesTheForceToTheDevicesWatchdogWhenNoThreadIsLeft) {
  DhdBench bench;
  bench.hold_attached();
  const std::int64_t begin_ns = bench.clock.time_ns;
  mock_dhd_set_time(begin_ns + DhdDevice::kWatchdogNs);
  EXPECT_GT(bench.felt(), 0.5);
  mock_dhd_set_time(begin_ns + DhdDevice::kWatchdogNs + 1);
  EXPECT_EQ(bench.felt(), 0.0);
}

TEST(DhdDevice, IsLeftWithZeroForceAndItsBrakesOn) {
  {
    DhdBench bench;
    bench.hold_attached();
  }
  const auto all = calls();
  ASSERT_GE(all.size(), 4U);
  EXPECT_EQ(std::vector<std::string>(all.end() - 3, all.end()),
            (std::vector<std::string>{"force_off", "brakes_on", "close"}));
  EXPECT_EQ(mock_dhd_brakes(), 1);
}

TEST(DhdDevice, NeitherAllocatesInItsCycleNorInTheServosTick) {
  DhdBench bench;
  bench.hold_attached();
  for (int i = 0; i < 1000; ++i) {
    if (i == 300) mock_dhd_fail(kSetForce, 12, 1);
    if (i == 700) mock_dhd_cut_force(2);
    bench.clock.time_ns += DhdBench::kPeriodNs;
    const afm::test::NoAllocation guard;
    afm::test::DhdMock::tick(*bench.device, bench.clock.time_ns);
    bench.servo_tick();
  }
  EXPECT_EQ(bench.health(), DhdHealth::Ready);
}

}  // namespace dhd_device_test
