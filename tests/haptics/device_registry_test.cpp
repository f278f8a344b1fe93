// SPDX-License-Identifier: Apache-2.0
// Invariant: a driver that never returns from opening a device ends the process that waits for it, before any force
#include "haptics/device_registry.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <tuple>

#include "core/exit_code.h"
#include "mock_control.h"
#include "mock_dhd_control.h"
#include "support/places.h"

namespace device_registry_test {

using namespace afm::haptics;
using afm::core::ErrorCategory;
using afm::core::MonotonicClock;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;

auto line(const char* subject, bool usable, const char* said) {
  return AllOf(Field(&ProbeLine::subject, HasSubstr(subject)), Field(&ProbeLine::usable, usable),
               Field(&ProbeLine::said, HasSubstr(said)));
}

afm::core::Result<OpenedDevice> open_word(const char* word, const Environment& environment,
                                          const MonotonicClock& clock) {
  return open_device(*find_device_kind(word), environment, clock);
}

constexpr unsigned kNotConnected = 0x0303;

class DeviceRegistry : public testing::Test {
 protected:
  DeviceRegistry() {
    mock_hd_reset();
    mock_hd_use_thread();
  }

  // port 1 has no service
  static Environment with_library(const std::string& library) {
    return [library](const std::string& variable) -> std::string {
      if (variable == "TOUCHAFM_HD_LIBRARY") return library;
      if (variable == "TOUCHAFM_FD_LIBRARY") return "/nowhere/libdhd.so";
      return variable == "TOUCHAFM_HAPLY_PORT" ? "1" : "";
    };
  }

  const Environment mock = with_library(afm::support::mock_hd());
  const Environment nowhere = with_library("/nowhere/libHD.so");
  const MonotonicClock clock;
};

TEST_F(DeviceRegistry, TakesARealDeviceBeforeTheSimulatedHand) {
  const auto opened = open_best_device(mock, clock);
  EXPECT_EQ(opened.device->spec().name, "Mock Touch, serial 0001");
  EXPECT_THAT(opened.lines,
              ElementsAre(line("libmock_hd.so", true, "loaded"), line("hdapi device", true, "Mock Touch")));
}

TEST_F(DeviceRegistry, FallsBackToTheSimulatedHandAndSaysWhy) {
  const auto no_library = open_best_device(nowhere, clock);
  EXPECT_EQ(no_library.device->spec().name, "simulated hand");
  EXPECT_THAT(no_library.lines,
              ElementsAre(line("hdapi library /nowhere/libHD.so", false, "No such file"),
                          line("forcedimension library /nowhere/libdhd.so", false, "No such file"),
                          line("haply device", false, "port 1"), line("gamepad", false, "none is plugged in"),
                          line("simulated hand", true, "")));

  mock_hd_fail_init("*", kNotConnected, 100);
  const auto no_device = open_best_device(mock, clock);
  EXPECT_THAT(no_device.lines,
              ElementsAre(line("libmock_hd.so", true, "loaded"), line("hdapi device", false, "mock: not connected"),
                          line("forcedimension library", false, "No such file"), line("haply device", false, "port 1"),
                          line("gamepad", false, ""), line("simulated hand", true, "")));
}

TEST_F(DeviceRegistry, DoesNotReplaceADeviceThatWasNamed) {
  const auto no_library = open_word("hdapi", nowhere, clock);
  ASSERT_FALSE(no_library);
  EXPECT_EQ(no_library.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(no_library.error().message, AllOf(HasSubstr("/nowhere/libHD.so"), HasSubstr("TOUCHAFM_HD_LIBRARY")));

  mock_hd_fail_init("*", kNotConnected, 100);
  const auto no_device = open_word("hdapi", mock, clock);
  ASSERT_FALSE(no_device);
  EXPECT_EQ(no_device.error().category, ErrorCategory::DeviceMissing);

  const auto no_haply = open_word("haply", mock, clock);
  ASSERT_FALSE(no_haply);
  EXPECT_EQ(no_haply.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(no_haply.error().message, HasSubstr("no haply inverse service at port 1"));

  const auto no_gamepad = open_word("gamepad", mock, clock);
  ASSERT_FALSE(no_gamepad);
  EXPECT_EQ(no_gamepad.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(no_gamepad.error().message, HasSubstr("no gamepad: none is plugged in"));
}

TEST_F(DeviceRegistry, FindsADeviceBehindForceDimensionsLibrary) {
  const Environment environment = [this](const std::string& variable) {
    return variable == "TOUCHAFM_FD_LIBRARY" ? afm::support::mock_dhd() : nowhere(variable.c_str());
  };
  mock_dhd_reset();
  mock_dhd_use_clock();
  const auto lines = probe_devices(environment);
  EXPECT_THAT(lines, Contains(line("libmock_dhd.so", true, "loaded")));
  EXPECT_THAT(lines, Contains(line("forcedimension device", true,
                                   "omega.3, serial 1234: 12 N peak, 150 x 150 x 150 mm; tested with a stand-in ")));
  const auto opened = open_best_device(environment, clock);
  EXPECT_EQ(opened.device->spec().name, "omega.3, serial 1234");
  EXPECT_TRUE(opened.device->spec().has_own_hand);

  mock_dhd_fail("dhdOpenID", 20, -1);
  const auto busy = open_word("forcedimension", environment, clock);
  ASSERT_FALSE(busy);
  EXPECT_EQ(busy.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(busy.error().message, HasSubstr("mock: in use"));
  EXPECT_THAT(open_word("forcedimension", nowhere, clock).error().message,
              AllOf(HasSubstr("/nowhere/libdhd.so"), HasSubstr("TOUCHAFM_FD_LIBRARY")));
}

TEST_F(DeviceRegistry, OpensTheSimulatedHandWithoutLookingFurther) {
  const auto opened = open_word("sim", mock, clock);
  ASSERT_TRUE(opened);
  EXPECT_THAT(opened->lines, ElementsAre(line("simulated hand", true, "")));
  EXPECT_EQ(mock_hd_call(0), nullptr);
}

TEST_F(DeviceRegistry, ListsWhatIsThereWithoutStartingIt) {
  EXPECT_THAT(probe_devices(mock),
              ElementsAre(line("libmock_hd.so", true, "loaded"),
                          line("hdapi device", true,
                               "3.3 N peak, 0.88 N continuous, 160 x 120 x 70 mm; tested with a stand-in "),
                          line("forcedimension library", false, "No such file"), line("haply device", false, "port 1"),
                          line("gamepad", false, "none is plugged in"), line("simulated hand", true, "")));
  EXPECT_STREQ(mock_hd_call(0), "init");
  EXPECT_STREQ(mock_hd_call(1), "disable_device");
  EXPECT_EQ(mock_hd_call(2), nullptr);
}

TEST_F(DeviceRegistry, LooksForEveryKindAndNamesItByItsWord) {
  const auto lines = probe_devices(nowhere);
  ASSERT_GE(device_kinds().size(), 4U);
  for (const DeviceKind& kind : device_kinds()) {
    EXPECT_TRUE(kind.subject.starts_with(kind.word)) << kind.word;
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const ProbeLine& l) {
      return l.subject.starts_with(kind.word);
    })) << kind.word;
  }
  EXPECT_EQ(find_device_kind("falcon"), nullptr);
}

// The process cannot continue with a thread that is caught in a vendor's library.
TEST_F(DeviceRegistry, EndsTheProcessWhereADriverDoesNotComeBack) {
  constexpr std::chrono::milliseconds kPatience(200);
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto code = testing::ExitedWithCode(static_cast<int>(afm::core::ExitCode::DeviceMissing));
  const char* message = "hdapi device: its driver did not answer within 0.2 s";
  ASSERT_EQ(::setenv("MOCK_HD_FAULT", "hangs", 1), 0);
  EXPECT_EXIT(std::ignore = open_device(*find_device_kind("hdapi"), mock, clock, {}, kPatience), code, message);
  EXPECT_EXIT(probe_devices(mock, kPatience), code, message);
  ::unsetenv("MOCK_HD_FAULT");

  const Environment dhd = [](const std::string& variable) {
    return variable == "TOUCHAFM_FD_LIBRARY" ? afm::support::mock_dhd() : std::string();
  };
  mock_dhd_reset();
  ASSERT_EQ(::setenv("MOCK_DHD_FAULT", "hangs", 1), 0);
  EXPECT_EXIT(std::ignore = open_device(*find_device_kind("forcedimension"), dhd, clock, {}, kPatience), code,
              "forcedimension device: its driver did not answer within 0.2 s");
  ::unsetenv("MOCK_DHD_FAULT");
}

TEST_F(DeviceRegistry, KnowsWhichHandNobodyHolds) {
  EXPECT_FALSE(open_word("sim", nowhere, clock)->device->spec().has_own_hand);
  EXPECT_TRUE(open_word("hdapi", mock, clock)->device->spec().has_own_hand);
}

// The rows of the table and the profiles agree.
TEST_F(DeviceRegistry, KnowsWhichHandsFeelAVibration) {
  EXPECT_TRUE(find_device_kind("sim")->vibrates);
  EXPECT_EQ(open_word("sim", nowhere, clock)->device->spec().max_vibration_n, kMostVibrationN);
  EXPECT_TRUE(find_device_kind("hdapi")->vibrates);
  EXPECT_EQ(open_word("hdapi", mock, clock)->device->spec().max_vibration_n, kMostVibrationN);
  const Environment dhd = [](const std::string& variable) {
    return variable == "TOUCHAFM_FD_LIBRARY" ? afm::support::mock_dhd() : std::string();
  };
  mock_dhd_reset();
  mock_dhd_use_clock();
  EXPECT_TRUE(find_device_kind("forcedimension")->vibrates);
  EXPECT_EQ(open_word("forcedimension", dhd, clock)->device->spec().max_vibration_n, kMostVibrationN);
  EXPECT_FALSE(find_device_kind("gamepad")->vibrates);
  EXPECT_EQ(omni_like("gamepad").max_vibration_n, 0.0) << "the profile of gamepads and recordings";
}

}  // namespace device_registry_test
