// SPDX-License-Identifier: Apache-2.0
// Invariant: a driver that fails leaves no force on the hand, on a stand-in that fails in every listed way
#include "devices/hdapi_device.h"

#include <gmock/gmock.h>

#include <limits>

#include "hdapi_bench.h"
#include "support/no_alloc.h"
#include "support/places.h"

// The mock's scheduler runs only when a test says so: every millisecond here is the same in every run.
namespace hdapi_device_test {

using namespace afm::haptics;
using afm::scene::FaultCode;
using afm::scene::ServoState;
using afm::test::HdapiBench;
using afm::test::ManualClock;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr unsigned kWarm = 0x0200, kForce = 0x0201, kImpulse = 0x0202, kVelocity = 0x0203, kForceError = 0x0204;
constexpr unsigned kFault = 0x0300, kBusy = 0x0301, kComm = 0x0302, kCommSetup = 0x0303, kTimer = 0x0304;
constexpr unsigned kNominalForceProperty = 0x2603, kVelocityProperty = 0x2606, kImpulseProperty = 0x2607;
constexpr unsigned kMotorTemperatureProperty = 0x2605;
constexpr unsigned kCalibrated = 0x5000, kNeedsUpdate = 0x5001, kNeedsManualInput = 0x5002;

HdapiFunctions mock_functions() { return *load_hdapi(afm::support::mock_hd()).functions; }

auto open_mock(const afm::core::Clock& clock, const std::string& name = "") {
  return HdapiDevice::open(mock_functions(), clock, name, HdapiDevice::Supervision::Caller);
}

std::vector<std::string> calls() {
  std::vector<std::string> all;
  for (int i = 0; const char* call = mock_hd_call(i); ++i) all.emplace_back(call);
  return all;
}

TEST(HdapiDevice, ReportsItsLimitsInSi) {
  mock_hd_reset();
  const auto spec = HdapiDevice::query(mock_functions(), "");
  ASSERT_TRUE(spec) << spec.error().message;
  EXPECT_EQ(spec->name, "Mock Touch, serial 0001");
  EXPECT_EQ(spec->max_force_n, 3.3);
  EXPECT_EQ(spec->max_continuous_force_n, 0.88);
  EXPECT_EQ(spec->max_stiffness_n_per_m, 400.0);  // 500 in the driver
  EXPECT_EQ(spec->max_slew_n_per_s, 2000.0);
  EXPECT_DOUBLE_EQ(spec->max_speed_m_per_s, 1.5);
  EXPECT_DOUBLE_EQ(spec->workspace_min_m.y, -0.060);
  EXPECT_DOUBLE_EQ(spec->contact_point_m.y, -0.020);
  EXPECT_EQ(calls(), (std::vector<std::string>{"init", "disable_device"}));
}

TEST(HdapiDevice, GivesThePlaceInMetresAndTheFirstButton) {
  HdapiBench bench;
  mock_hd_set_position(10, 20, -30);
  mock_hd_set_buttons(3);
  bench.driver_tick();
  const DeviceSample sample = bench.device->read(bench.clock.now_ns());
  EXPECT_TRUE(sample.healthy);
  EXPECT_TRUE(sample.turn_on);
  EXPECT_DOUBLE_EQ(sample.position_m.x, 0.010);
  EXPECT_DOUBLE_EQ(sample.position_m.y, 0.020);
  EXPECT_DOUBLE_EQ(sample.position_m.z, -0.030);
  mock_hd_set_buttons(2);
  bench.driver_tick();
  EXPECT_FALSE(bench.device->read(bench.clock.now_ns()).turn_on);
}

TEST(HdapiDevice, LetsACycleBeFeltWithinTheDriversLimits) {
  HdapiBench bench;
  bench.hold_attached();
  bench.move_to(60);
  EXPECT_EQ(bench.events.size(), 2U);
  EXPECT_NEAR(bench.largest_force_n, 2.0, 0.01);
  EXPECT_LE(bench.largest_force_n, force_cap_n(bench.device->spec()));
  EXPECT_LE(bench.largest_step_n, 0.5 + 1e-12);  // limit of the governor
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
}

// The driver of the mock judges every step itself and would cut.
TEST(HdapiDevice, NeverStepsFurtherThanTheDeviceAllows) {
  HdapiBench bench([] { mock_hd_set_limit(kImpulseProperty, 0.1); });
  bench.hold_attached();
  bench.move_to(60);
  EXPECT_EQ(bench.events.size(), 2U);
  EXPECT_LE(bench.largest_step_n, 0.08 + 1e-12);
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
}

// Every second callback is lost while the tip is torn off: the governor then makes two steps between callbacks.
TEST(HdapiDevice, DividesTwoStepsOfTheServoThatFallBetweenTwoCallbacks) {
  HdapiBench bench([] { mock_hd_set_limit(kImpulseProperty, 0.1); });
  bench.hold_attached();
  for (double height_mm = 25; height_mm < 60; height_mm += 0.2) {
    mock_hd_set_position(0, HdapiBench::kContactMm + height_mm, 0);
    bench.clock.time_ns += HdapiBench::kPeriodNs;
    bench.servo_tick();
    bench.tick();
  }
  EXPECT_EQ(bench.events.size(), 2U);
  EXPECT_LE(bench.largest_step_n, 0.08 + 1e-12);
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
}

TEST(HdapiDevice, ReportsHowHotTheMotorsAreAndTheForceGivesWay) {
  HdapiBench bench;
  bench.hold_attached();
  const double cold_n = bench.force_n;
  mock_hd_set_limit(kMotorTemperatureProperty, 0.9);
  bench.run(50);
  EXPECT_NEAR(bench.state().safety.motor_heat, 0.9, 1e-12);
  EXPECT_LT(bench.state().safety.thermal_gain, 0.8);
  EXPECT_NEAR(bench.force_n, cold_n * bench.state().safety.thermal_gain, 1e-3);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  mock_hd_set_limit(kMotorTemperatureProperty, 1.0);
  bench.run(150);
  EXPECT_EQ(bench.force_n, 0.0);
  EXPECT_EQ(bench.state().fault, FaultCode::MotorsHot);
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
}

TEST(HdapiDevice, IsNotDrivenBySlowerTicksThanItsForcesLast) {
  HdapiBench bench;
  for (const double rate_hz : {100.0, 399.0}) {
    const auto loop = ServoLoop::create(bench.segment, *bench.device, {.rate_hz = rate_hz});
    ASSERT_FALSE(loop);
    EXPECT_THAT(loop.error().message, testing::HasSubstr("older than 5 ms; choose 400 Hz or more"));
  }
  EXPECT_TRUE(ServoLoop::create(bench.segment, *bench.device, {.rate_hz = 400.0}));
}

TEST(HdapiDevice, SeesAHotMotorBehindASensorThatSendsNoNumber) {
  HdapiBench bench;
  bench.hold_attached();
  mock_hd_break_first_sensor();
  mock_hd_set_limit(kMotorTemperatureProperty, 1.0);
  bench.run(150);
  EXPECT_EQ(bench.force_n, 0.0);
  EXPECT_EQ(bench.state().fault, FaultCode::MotorsHot);
}

TEST(HdapiDevice, GoesWithoutATemperatureThatTheDeviceDoesNotMeasure) {
  HdapiBench bench([] { mock_hd_set_limit(kMotorTemperatureProperty, -1.0); });
  bench.run(100);
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
  EXPECT_EQ(bench.device->read(bench.clock.now_ns()).motor_heat, 0.0);
}

TEST(HdapiDevice, CapsTheForceOfAWeakDevice) {
  HdapiBench bench([] { mock_hd_set_limit(kNominalForceProperty, 1.0); });
  bench.arm();
  bench.move_to(-5);
  bench.move_to(60);
  EXPECT_EQ(bench.events.size(), 2U);
  EXPECT_LE(bench.largest_force_n, 0.9);
  EXPECT_GT(bench.largest_force_n, 0.8);
}

TEST(HdapiDevice, FadesToZeroAndStaysThereWhenTheServoStopsWriting) {
  HdapiBench bench;
  bench.hold_attached();
  bench.largest_step_n = 0;
  for (int ms = 0; ms < 15; ++ms) bench.driver_tick();
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_LE(bench.largest_step_n, 0.2);
  for (int ms = 0; ms < 1000; ++ms) {
    bench.driver_tick();
    ASSERT_EQ(bench.felt(), 0.0);
  }
}

TEST(HdapiDevice, ComesBackWithoutAKickWhenTheServoWritesAgain) {
  for (const int pause_ms : {6, 10, 19, 50, 500}) {
    HdapiBench bench;
    bench.hold_attached();
    bench.largest_step_n = 0;
    for (int ms = 0; ms < pause_ms; ++ms) bench.driver_tick();
    bench.run(300);
    EXPECT_LE(bench.largest_step_n, 0.2) << pause_ms;
    // beyond 20 ms the governor itself has let go
    EXPECT_EQ(bench.state().servo_state, pause_ms < 20 ? ServoState::Running : ServoState::Disarmed) << pause_ms;
  }
}

struct FaultCase {
  unsigned error;
  HdapiHealth health;
  int recovers_after_ms;  // 0: never
  const char* said;
};

const FaultCase kFaultCases[] = {
    {kWarm, HdapiHealth::WarmMotors, 10'000, "motors are too warm"},
    {kForce, HdapiHealth::ForceExceeded, 200, "too large"},
    {kImpulse, HdapiHealth::ImpulseExceeded, 200, "too sudden"},
    {kVelocity, HdapiHealth::VelocityExceeded, 200, "faster than the driver allows"},
    {kForceError, HdapiHealth::DeviceFault, 0, "it failed"},
    {kFault, HdapiHealth::DeviceFault, 0, "it failed"},
    {kComm, HdapiHealth::ConnectionLost, 0, "connection was lost"},
    {kCommSetup, HdapiHealth::ConnectionLost, 0, "connection was lost"},
    {kTimer, HdapiHealth::DeviceFault, 0, "it failed"},
    {0x0BAD, HdapiHealth::DeviceFault, 0, "(0x0bad)"},
};

TEST(HdapiDevice, TakesTheForceAwayWithinTwoTicksOfAnyErrorAndNamesIt) {
  for (const FaultCase& fault : kFaultCases) {
    SCOPED_TRACE(fault.error);
    HdapiBench bench;
    bench.hold_attached();
    mock_hd_push_error(fault.error);
    bench.run(2);
    EXPECT_EQ(bench.felt(), 0.0);
    EXPECT_EQ(bench.health(), fault.health);
    EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
    EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
    EXPECT_THAT(bench.log, Contains(AllOf(HasSubstr("Mock Touch, serial 0001: "), HasSubstr(fault.said))));
  }
}

TEST(HdapiDevice, RecoversFromWhatPassesAndNeverFromALostDevice) {
  for (const FaultCase& fault : kFaultCases) {
    SCOPED_TRACE(fault.error);
    HdapiBench bench;
    bench.hold_attached();
    mock_hd_push_error(fault.error);
    bench.run(fault.recovers_after_ms == 0 ? 20'000 : fault.recovers_after_ms - 1);
    EXPECT_EQ(bench.health(), fault.health);
    EXPECT_EQ(bench.felt(), 0.0);
    if (fault.recovers_after_ms == 0) continue;
    bench.run(5);
    EXPECT_EQ(bench.health(), HdapiHealth::Ready);
    // no force without a lift and two presses: one for the fault, one to turn on
    bench.run(100);
    EXPECT_EQ(bench.felt(), 0.0);
    EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
    bench.move_to(60);
    bench.press_turn_on();
    EXPECT_EQ(bench.state().servo_state, ServoState::Disarmed);
    bench.press_turn_on();
    EXPECT_EQ(bench.state().servo_state, ServoState::Arming);
  }
}

TEST(HdapiDevice, IsNotHealthyWhileTheSchedulerStallsAndItsOutputIsSwitchedOff) {
  HdapiBench bench;
  bench.hold_attached();
  mock_hd_stall(1);
  bench.run(5);
  EXPECT_EQ(bench.state().servo_state, ServoState::Running);
  EXPECT_GT(bench.felt(), 0.5);  // force held by the driver
  bench.run(1);
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(bench.health(), HdapiHealth::SchedulerStalled);
  EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
  EXPECT_THAT(bench.log, Contains(HasSubstr("stopped calling")));

  mock_hd_stall(0);
  bench.run(100);
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
}

TEST(HdapiDevice, DoesNotFloodTheLogWhenTheDriverCallsAHundredTimesASecond) {
  HdapiBench bench;
  bench.arm();
  bench.log.clear();
  for (int tick = 0; tick < 9000; ++tick) {
    mock_hd_stall(tick % 10 == 0 ? 0 : 1);
    bench.tick();
  }
  EXPECT_LE(bench.log.size(), 2U);
  EXPECT_THAT(bench.log, Contains(HasSubstr("stopped calling")));
}

TEST(HdapiDevice, ComparesNotANumberAndLeapsWithNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [x, y] : {std::pair(nan, 5.0), std::pair(0.0, infinity), std::pair(0.0, 1000.0),
                             std::pair(-1e300, 5.0), std::pair(60.0, 5.0)}) {
    SCOPED_TRACE(testing::Message() << x << ' ' << y);
    HdapiBench bench;
    bench.hold_attached();
    const double height_m = bench.device->read(bench.clock.now_ns()).position_m.y;
    mock_hd_set_position(x, y, 0);
    bench.run(1);
    EXPECT_EQ(bench.health(), HdapiHealth::ImplausiblePosition);
    const DeviceSample sample = bench.device->read(bench.clock.now_ns());
    EXPECT_FALSE(sample.healthy);
    EXPECT_EQ(sample.position_m.y, height_m);
    EXPECT_NEAR(sample.position_m.x, 0.0, 1e-6);
    EXPECT_EQ(bench.felt(), 0.0);
    mock_hd_set_position(0, HdapiBench::kContactMm + 25, 0);
    bench.run(250);
    EXPECT_EQ(bench.health(), HdapiHealth::Ready);
    EXPECT_EQ(bench.felt(), 0.0);
  }
}

TEST(HdapiDevice, CalibratesWithTheForceOff) {
  HdapiBench bench;
  bench.hold_attached();
  mock_hd_set_calibration(kNeedsUpdate);
  bench.run(110);
  EXPECT_EQ(bench.felt(), 0.0);
  bench.run(200);
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
  EXPECT_THAT(bench.log, Contains(HasSubstr("is calibrating")));
  EXPECT_THAT(calls(), Contains("update_calibration"));
  EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
}

TEST(HdapiDevice, WaitsForThePenInTheInkwell) {
  HdapiBench bench([] { mock_hd_set_calibration(kNeedsManualInput); });
  bench.run(500);
  EXPECT_EQ(bench.health(), HdapiHealth::NeedsInkwell);
  EXPECT_THAT(bench.log, Contains(HasSubstr("put the pen into the inkwell")));
  bench.press_turn_on();
  EXPECT_EQ(bench.state().servo_state, ServoState::Fault);
  EXPECT_THAT(calls(), testing::Not(Contains("output_on")));
  mock_hd_set_calibration(kCalibrated);
  bench.run(150);
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
  EXPECT_EQ(std::count(bench.log.begin(), bench.log.end(), bench.log.front()), 1);  // said once
}

TEST(HdapiDevice, NeitherAllocatesInTheCallbackNorInTheServosTick) {
  HdapiBench bench;
  bench.hold_attached();
  for (int i = 0; i < 1000; ++i) {
    if (i == 500) mock_hd_push_error(kVelocity);
    bench.clock.time_ns += HdapiBench::kPeriodNs;
    const afm::test::NoAllocation guard;
    mock_hd_tick();
    bench.servo_tick();
  }
  EXPECT_EQ(bench.health(), HdapiHealth::Ready);
}

TEST(HdapiDevice, TriesTheDefaultsInOrderAndSaysWhatEachAnswered) {
  ManualClock clock;
  mock_hd_reset();
  mock_hd_fail_init(nullptr, kCommSetup, 1);
  mock_hd_fail_init("Default Device", kCommSetup, 1);
  EXPECT_TRUE(open_mock(clock));

  mock_hd_reset();
  mock_hd_fail_init("*", kCommSetup, 100);
  const auto none = open_mock(clock);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().category, afm::core::ErrorCategory::DeviceMissing);
  EXPECT_THAT(none.error().message,
              HasSubstr("the default device: mock: not connected (0x0303), \"Default Device\": mock: not connected "
                        "(0x0303), \"Default PHANToM\": mock: not connected (0x0303)"));
}

TEST(HdapiDevice, TakesTheNamedDeviceAndNoOther) {
  ManualClock clock;
  mock_hd_reset();
  mock_hd_fail_init("Left", kCommSetup, 1);
  const auto left = open_mock(clock, "Left");
  ASSERT_FALSE(left);
  EXPECT_THAT(left.error().message, HasSubstr("(\"Left\": mock: not connected (0x0303))"));
  EXPECT_EQ(calls(), std::vector<std::string>{"init"});
}

TEST(HdapiDevice, AsksTenTimesForADeviceThatIsInUse) {
  ManualClock clock;
  mock_hd_reset();
  mock_hd_fail_init("Left", kBusy, 10);
  EXPECT_TRUE(open_mock(clock, "Left"));

  mock_hd_reset();
  mock_hd_fail_init("Left", kBusy, 11);
  const auto busy = open_mock(clock, "Left");
  ASSERT_FALSE(busy);
  EXPECT_THAT(busy.error().message, HasSubstr("mock: in use (0x0301)"));
}

TEST(HdapiDevice, RefusesLimitsThatCannotBe) {
  ManualClock clock;
  for (const unsigned property : {kNominalForceProperty, kVelocityProperty, kImpulseProperty}) {
    for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e9}) {
      mock_hd_reset();
      mock_hd_set_limit(property, value);
      const auto device = open_mock(clock);
      ASSERT_FALSE(device);
      EXPECT_THAT(device.error().message, HasSubstr("reports an impossible"));
      EXPECT_THAT(calls(), Contains("disable_device"));
    }
  }
}

}  // namespace hdapi_device_test
