// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>
#include <string>
#include <thread>

#include "haptics/device_registry.h"
#include "support/network/loopback_sender.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace device_commands_test {

using support::ProgramResult;
using ::testing::HasSubstr;

ProgramResult touchafm(const std::string& arguments, const std::string& environment = "") {
  return support::run_program(environment + " " + support::touchafm() + " " + arguments);
}

const std::string kMock = "TOUCHAFM_HD_LIBRARY=" + support::mock_hd();
const std::string kMockDhd = "TOUCHAFM_FD_LIBRARY=" + support::mock_dhd();

TEST(DevicesCommand, SaysWhatWasTriedAndWhyNot) {
  const ProgramResult result = touchafm("devices");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"libHD.so.3.4", "libHD.so.3.0", "cannot open shared object file", "simulated hand"}) {
    EXPECT_THAT(result.out, HasSubstr(name));
  }
}

TEST(DevicesCommand, LooksForEveryHapticDevice) {
  const auto list = nlohmann::json::parse(touchafm("devices --json", kMock + " " + kMockDhd).out);
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    EXPECT_TRUE(std::any_of(list.begin(), list.end(), [&](const auto& row) {
      return row["kind"] == "haptic" && row["device"] == std::string(kind.subject);
    })) << kind.subject;
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
  EXPECT_THAT((*device)["detail"].get<std::string>(), HasSubstr("Mock Touch, serial 0001: 3.3 N peak"));
}

TEST(DevicesCommand, SaysWhichDevicesNoHardwareHasProved) {
  EXPECT_THAT(
      touchafm("devices", kMockDhd).out,
      HasSubstr("omega.3, serial 1234: 12 N peak, 150 x 150 x 150 mm; tested with a stand-in for its library only"));
}

TEST(DevicesCommand, SaysWhatTheLibraryAnswersWhenNoDeviceIsThere) {
  EXPECT_THAT(touchafm("devices", kMock + " MOCK_HD_FAULT=missing").out, HasSubstr("mock: not connected (0x0303)"));
  EXPECT_THAT(touchafm("devices", kMock + " MOCK_HD_FAULT=busy").out, HasSubstr("mock: in use (0x0301)"));
  EXPECT_THAT(touchafm("devices", kMockDhd + " MOCK_DHD_FAULT=missing").out, HasSubstr("no device is connected"));
}

TEST(GraphicsDevice, IsChosenByName) {
  const support::ScratchFolder folder;
  const std::string draw = "render --journey 3 --size 64x64 --out " + folder.file("a.png");
  const auto list = nlohmann::json::parse(touchafm("devices --json").out);
  ASSERT_EQ(list.front()["kind"], "vulkan");
  const auto name = list.front()["device"].get<std::string>();
  EXPECT_EQ(touchafm(draw + " --gpu '" + name + "'").exit_code, 0);
  const ProgramResult missing = touchafm(draw + " --gpu Voodoo");
  EXPECT_EQ(missing.exit_code, 4);
  EXPECT_THAT(missing.err, ::testing::AllOf(HasSubstr("no graphics device is called 'Voodoo'"), HasSubstr(name)));
  for (const char* command : {"demo --out x", "view", "wall --test-pattern --out x.png", "node left --interface lo"}) {
    EXPECT_EQ(touchafm(std::string(command) + " --gpu ''").exit_code, 2) << command;
  }
  const ProgramResult headset = touchafm("view --headset --gpu '" + name + "'");
  EXPECT_EQ(headset.exit_code, 2);
  EXPECT_THAT(headset.err, HasSubstr("--headset cannot be given with --gpu"));
}

TEST(DevicesCommand, NamesAHeadsetRuntimeThatDoesNotExist) {
  const std::string environment = "XR_RUNTIME_JSON=/nonexistent.json";
  for (const char* command : {"devices", "doctor --seconds 0.1"}) {
    const ProgramResult listed = touchafm(command, environment);
    EXPECT_THAT(listed.out, HasSubstr("XR_RUNTIME_JSON names /nonexistent.json, which does not exist")) << command;
  }
  const ProgramResult view = touchafm("view --headset", environment);
  EXPECT_EQ(view.exit_code, 4);
  EXPECT_THAT(view.err, HasSubstr("XR_RUNTIME_JSON names /nonexistent.json, which does not exist"));
  EXPECT_THAT(view.err, ::testing::Not(HasSubstr("install libopenxr-loader1")));
}

// A tracker that sends garbage, fast, until the end of its scope.
class Garbage {
 public:
  Garbage()
      : thread_([this] {
          const std::string packet(120, '\xA5');
          while (!ending_) {
            sender_.send(packet);
            std::this_thread::sleep_for(std::chrono::microseconds(100));
          }
        }) {}
  Garbage(const Garbage&) = delete;
  Garbage& operator=(const Garbage&) = delete;
  ~Garbage() {
    ending_ = true;
    thread_.join();
  }

  std::string port() const { return std::to_string(sender_.port()); }

 private:
  const support::LoopbackSender sender_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

TEST(DevicesCommand, ReportsATrackerThatSendsGarbage) {
  const Garbage tracker;
  const support::ScratchFolder folder;
  const std::string file = folder.write("tracker.toml", "[dtrack]\nport = " + tracker.port() +
                                                            "\nroom_from_tracker = { position = [0, 0, 0], orientation "
                                                            "= [0, 0, 0, 1] }\n");
  const ProgramResult result = touchafm("devices --json --wand-file " + file);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto list = nlohmann::json::parse(result.out);
  const auto row = std::find_if(list.begin(), list.end(), [](const auto& r) { return r["kind"] == "tracker"; });
  ASSERT_NE(row, list.end());
  EXPECT_EQ((*row)["device"], "dtrack 127.0.0.1:" + tracker.port());
  EXPECT_EQ((*row)["usable"], false);
  const std::string detail = (*row)["detail"];
  EXPECT_THAT(detail, HasSubstr("malformed packets"));
  EXPECT_GT(std::stoi(detail), 100);
}

TEST(DevicesCommand, NamesTheMistakeOfAWandFile) {
  const support::ScratchFolder folder;
  const ProgramResult result =
      touchafm("devices --wand-file " + folder.write("wand.toml", "[device]\nname = \"stick\"\ncolour = 1\n"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("line 3: device.colour: unknown key; known are name, vendor, product"));
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

TEST(DoctorCommand, PrintsAHistogramThatHoldsEveryTick) {
  const ProgramResult result = touchafm("doctor --seconds 0.3");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::smatch missed;
  ASSERT_TRUE(std::regex_search(result.out, missed, std::regex("([0-9]+) of ([0-9]+) ticks missed"))) << result.out;
  // "     10 to 20 us       123  ###"
  const std::regex row("(?:to [0-9]+|and more) \u00b5s +([0-9]+)  ");
  std::uint64_t ticks = 0;
  int rows = 0;
  for (std::sregex_iterator it(result.out.begin(), result.out.end(), row); it != std::sregex_iterator(); ++it, ++rows) {
    ticks += std::stoull((*it)[1]);
  }
  EXPECT_EQ(rows, 8) << result.out;
  for (const char* range : {" 0 to 10 ", " 10 to 20 ", " 20 to 50 ", " 50 to 100 ", " 100 to 200 ", " 200 to 500 ",
                            " 500 to 1000 ", "1000 and more "}) {
    EXPECT_THAT(result.out, HasSubstr(std::string(range) + "\u00b5s"));
  }
  EXPECT_EQ(ticks + std::stoull(missed[1]), std::stoull(missed[2])) << result.out;
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
    EXPECT_THAT(result.err, HasSubstr("give --seconds 0.1 to 600")) << seconds;
    EXPECT_EQ(result.out, "");
  }
}

}  // namespace device_commands_test
}  // namespace afm::app
