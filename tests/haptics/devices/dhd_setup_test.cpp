// SPDX-License-Identifier: Apache-2.0
#include "forcedimension/dhd_setup.h"

#include <dlfcn.h>
#include <gmock/gmock.h>

#include <set>
#include <string>
#include <vector>

#include "core/clock.h"
#include "forcedimension/dhd_device.h"
#include "mock_dhd_control.h"
#include "support/places.h"

namespace dhd_setup_test {

using namespace afm::haptics;
using afm::core::ErrorCategory;
using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

DhdFunctions mock_functions() { return *load_dhd(afm::support::mock_dhd()).functions; }

std::vector<std::string> calls() {
  std::vector<std::string> all;
  for (int i = 0; const char* call = mock_dhd_call(i); ++i) all.emplace_back(call);
  return all;
}

TEST(DhdLibrary, TriesTheKnownNamesAndSaysWhatTheLinkerSaid) {
  const DhdSearch search = load_dhd("");
  ASSERT_FALSE(search.functions) << "a library of Force Dimension is installed on this machine";
  ASSERT_THAT(search.attempts, SizeIs(4));
  EXPECT_EQ(search.attempts[0].name, "libdhd.so.3");
  EXPECT_EQ(search.attempts[3].name, "libdrd.so");
  for (const auto& attempt : search.attempts) {
    EXPECT_THAT(attempt.refusal, HasSubstr(attempt.name + ": cannot open shared object file"));
  }
}

TEST(DhdLibrary, RefusesALibraryThatLacksAFunctionByItsName) {
  const DhdSearch search = load_dhd(afm::support::mock_dhd_without_brakes());
  EXPECT_FALSE(search.functions);
  ASSERT_THAT(search.attempts, SizeIs(1));
  EXPECT_EQ(search.attempts[0].refusal, "it lacks the function dhdSetBrakes");
}

TEST(DhdLibrary, RefusesAVersionThatItDoesNotKnow) {
  for (const int major : {2, 4}) {
    mock_dhd_reset();
    mock_dhd_set_version(major, 5);
    const DhdSearch search = load_dhd(afm::support::mock_dhd());
    EXPECT_FALSE(search.functions);
    EXPECT_EQ(search.attempts[0].refusal, "its version is " + std::to_string(major) + ".5.1; TouchAFM knows version 3");
  }
  mock_dhd_reset();
  EXPECT_TRUE(load_dhd(afm::support::mock_dhd()).functions);
}

TEST(DhdLibrary, DoesWithoutALargestForceThatAnOldOneHasNot) {
  const DhdSearch search = load_dhd(afm::support::mock_dhd_of_old());
  ASSERT_TRUE(search.functions) << search.attempts[0].refusal;
  EXPECT_EQ(search.functions->set_max_force, nullptr);
  EXPECT_NE(mock_functions().set_max_force, nullptr);
}

TEST(DhdSetup, ReportsTheProfileOfItsModelAndStartsNothing) {
  mock_dhd_reset();
  const auto spec = DhdDevice::query(mock_functions(), "");
  ASSERT_TRUE(spec) << spec.error().message;
  EXPECT_EQ(spec->name, "omega.3, serial 1234");
  EXPECT_EQ(spec->max_force_n, 12.0);
  EXPECT_EQ(spec->max_stiffness_n_per_m, 400.0);
  EXPECT_DOUBLE_EQ(spec->workspace_max_m.y, 0.075);
  EXPECT_DOUBLE_EQ(spec->contact_point_m.y, -0.025);
  EXPECT_TRUE(spec->measures);
  EXPECT_EQ(calls(), (std::vector<std::string>{"open", "close"}));
}

// Every model renders 50 mm above the sample; none exceeds the limits of careful drivers.
TEST(DhdSetup, HasAProfileOfEveryModel) {
  for (const int type : {63, 33, 34, 36, 35, 37, 104, 105, 108, 109, 60, 91, 0}) {
    const DeviceSpec spec = dhd::model_spec(type, "");
    SCOPED_TRACE(spec.name);
    EXPECT_GT(spec.workspace_max_m.y - spec.contact_point_m.y, 0.050);
    EXPECT_EQ(force_cap_n(spec), 2.0);
    EXPECT_LE(spec.max_continuous_force_n, 0.88);
    EXPECT_LE(spec.max_stiffness_n_per_m, 400.0);
  }
}

TEST(DhdSetup, GivesAnUnknownModelTheLimitsOfTheWeakestOne) {
  const DeviceSpec unknown = dhd::model_spec(206, "sigma.3");
  EXPECT_EQ(unknown.name, "sigma.3 (type 206 is unknown, with the limits of a Falcon)");
  for (const int type : {63, 33, 104, 108, 60}) {
    EXPECT_LE(unknown.max_force_n, dhd::model_spec(type, "").max_force_n);
    EXPECT_LE(unknown.workspace_max_m.y, dhd::model_spec(type, "").workspace_max_m.y);
  }
}

TEST(DhdSetup, TakesTheFirstDeviceThatCanBeOpened) {
  mock_dhd_reset();
  mock_dhd_set_devices(2, 104, "sigma.7");
  EXPECT_EQ(DhdDevice::query(mock_functions(), "")->name, "sigma.7, serial 1234");
  mock_dhd_fail("dhdOpenID", 20, 1);
  EXPECT_EQ(DhdDevice::query(mock_functions(), "")->name, "sigma.7, serial 1235");
}

TEST(DhdSetup, TakesTheDeviceThatIsNamedAndNoOther) {
  mock_dhd_reset();
  mock_dhd_set_devices(3, 33, "omega.3");
  EXPECT_EQ(DhdDevice::query(mock_functions(), "1236")->name, "omega.3, serial 1236");
  EXPECT_EQ(calls(), (std::vector<std::string>{"open", "close", "open", "close", "open", "close"}));
  EXPECT_EQ(DhdDevice::query(mock_functions(), "#1")->name, "omega.3, serial 1235");

  const auto none = DhdDevice::query(mock_functions(), "77");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(none.error().message, HasSubstr("(#0: serial 1234, #1: serial 1235, #2: serial 1236)"));
  EXPECT_THAT(DhdDevice::query(mock_functions(), "#3").error().message, HasSubstr("#3: only 3 connected"));
  for (const char* wrong : {"#", "left", "1234x", "-1", "70000", "# 1"}) {
    const auto refused = DhdDevice::query(mock_functions(), wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().category, ErrorCategory::WrongUsage) << wrong;
  }
}

TEST(DhdSetup, KnowsThatNoFalconHasASerialNumber) {
  mock_dhd_reset();
  mock_dhd_set_devices(1, 60, "Falcon");
  EXPECT_EQ(DhdDevice::query(mock_functions(), "")->name, "Falcon");
  const auto none = DhdDevice::query(mock_functions(), "65535");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("it has no serial number"));
}

TEST(DhdSetup, SaysWhatTheLibraryAnswered) {
  const afm::core::MonotonicClock clock;
  mock_dhd_reset();
  mock_dhd_set_devices(0, 33, "");
  const auto none = DhdDevice::open(mock_functions(), clock, "");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().category, ErrorCategory::DeviceMissing);
  EXPECT_THAT(none.error().message, HasSubstr("no device is connected, or permission is denied"));

  mock_dhd_reset();
  mock_dhd_fail("dhdGetDeviceCount", 2, 1);
  EXPECT_THAT(DhdDevice::open(mock_functions(), clock, "").error().message,
              HasSubstr("cannot look for devices: mock: communication failed (error 2)"));

  mock_dhd_reset();
  mock_dhd_fail("dhdOpenID", 20, 1);
  EXPECT_THAT(DhdDevice::open(mock_functions(), clock, "").error().message, HasSubstr("#0: mock: in use (error 20)"));

  mock_dhd_reset();
  mock_dhd_fail("dhdGetSystemType", 2, 1);
  const auto without_type = DhdDevice::open(mock_functions(), clock, "");
  ASSERT_FALSE(without_type);
  EXPECT_EQ(without_type.error().category, ErrorCategory::Failed);
  EXPECT_EQ(calls().back(), "close");
  EXPECT_EQ(mock_dhd_violation(), nullptr) << mock_dhd_violation();
}

}  // namespace dhd_setup_test
