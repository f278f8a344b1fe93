// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>

#include "support/run_program.h"

namespace afm::app {
namespace {

using support::ProgramResult;
using ::testing::HasSubstr;

ProgramResult touchafm(const std::string& arguments, const std::string& environment = "") {
  return support::run_program(environment + " " AFM_PROGRAM " " + arguments);
}

const std::string kMock = "TOUCHAFM_HD_LIBRARY=" AFM_MOCK_HD;

TEST(DevicesCommand, SaysWhatWasTriedAndWhyNot) {
  const ProgramResult result = touchafm("devices");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"libHD.so.3.4", "libHD.so.3.0", "cannot open shared object file", "simulated hand"}) {
    EXPECT_THAT(result.out, HasSubstr(name));
  }
}

TEST(DevicesCommand, FindsADeviceBehindAnInstalledLibrary) {
  const ProgramResult result = touchafm("devices --json", kMock);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto list = nlohmann::json::parse(result.out);
  const auto device =
      std::find_if(list.begin(), list.end(), [](const auto& row) { return row["device"] == "hdapi device"; });
  ASSERT_NE(device, list.end());
  EXPECT_EQ((*device)["usable"], true);
  EXPECT_THAT((*device)["detail"].get<std::string>(), HasSubstr("Mock Touch, serial 0001: 3.3 N at most"));
}

TEST(DevicesCommand, SaysWhatTheLibraryAnswersWhenNoDeviceIsThere) {
  EXPECT_THAT(touchafm("devices", kMock + " MOCK_HD_FAULT=missing").out, HasSubstr("mock: not connected (0x0303)"));
  EXPECT_THAT(touchafm("devices", kMock + " MOCK_HD_FAULT=busy").out, HasSubstr("mock: in use (0x0301)"));
}

TEST(DoctorCommand, EndsWellWhateverItFinds) {
  const ProgramResult result = touchafm("doctor --seconds 0.1");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* check : {"kernel", "real-time priority", "locked memory", "wake-up at 1 kHz", "graphics", "display",
                            "haptic device", "wands (HID)", "late by    ticks"}) {
    EXPECT_THAT(result.out, HasSubstr(check));
  }
}

TEST(DoctorCommand, GivesItsFindingsAndTheHistogramAsJson) {
  const ProgramResult result = touchafm("doctor --json --seconds 0.2", kMock);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto root = nlohmann::json::parse(result.out);
  for (const auto& check : root["checks"]) {
    EXPECT_EQ(check["verdict"] == "good", check["mend"] == "") << check;
  }
  const auto& wake = root["wake"];
  const auto bins = wake["histogram_us"].get<std::vector<std::uint64_t>>();
  EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}), wake["ticks"]);
  // a deadline at the very end may pass uncounted
  const std::uint64_t deadlines = wake["ticks"].get<std::uint64_t>() + wake["missed"].get<std::uint64_t>();
  EXPECT_GE(deadlines, 199U);
}

TEST(DoctorCommand, RefusesATimeThatCannotBe) {
  for (const char* seconds : {"0", "-1", "1e9", "nan"}) {
    const ProgramResult result = touchafm(std::string("doctor --seconds ") + seconds);
    EXPECT_EQ(result.exit_code, 2) << seconds;
    EXPECT_THAT(result.err, HasSubstr("--seconds is 0.1 to 600")) << seconds;
    EXPECT_EQ(result.out, "");
  }
}

}  // namespace
}  // namespace afm::app
