// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>

#include "core/whole_file.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

// The demonstration and the live window while one call or one allocation of the program fails, drawn by a fixed seed:
// half an hour, on demand (label long).
namespace afm::app {
namespace injected_failures_live_test {

constexpr int kFailures = 100;

// Number of calls, from the last line of the report of a first run without failures.
long counted(const std::string& report) {
  const std::string text = core::read_file(report).value_or("");
  const auto last = text.rfind("count ");
  return last == std::string::npos ? 0 : std::stol(text.substr(last + 6));
}

class LiveFailures : public ::testing::TestWithParam<const char*> {
 protected:
  // `wish` as in failing_calls.cpp. Ended by SIGINT after `seconds`, by SIGKILL where that does nothing.
  support::ProgramResult run(const std::string& environment, int seconds, long number, const std::string& command) {
    report_ = reports_.file(std::to_string(number));
    return support::run_program(environment + "timeout --preserve-status -s INT -k 30 " + std::to_string(seconds) +
                                " env LD_PRELOAD=" + support::failing_calls() +
                                " AFM_FAIL_PROGRAM=1 AFM_FAIL=" + GetParam() + ":" + std::to_string(number) +
                                " AFM_FAIL_REPORT=" + report_ + " " + support::touchafm() + " " + command);
  }

  long draw(int index, long count) {
    return std::string(GetParam()) == "calls" ? 1 + index % count : 1 + static_cast<long>(random_()) % count;
  }

  static void expect_a_code_and_one_error(const support::ProgramResult& done, long number) {
    EXPECT_TRUE(done.exit_code == 0 || done.exit_code == 1 || done.exit_code == 3)
        << GetParam() << number << " ended with " << done.exit_code << ": " << done.err;
    int errors = 0;
    for (std::size_t at = done.err.find("error: "); at != std::string::npos; at = done.err.find("error: ", at + 1)) {
      ++errors;
    }
    EXPECT_EQ(errors, done.exit_code == 0 ? 0 : 1) << GetParam() << number << ": " << done.err;
  }

  const support::ScratchFolder reports_;
  std::string report_;
  std::minstd_rand random_{15};
};

TEST_P(LiveFailures, OfADemonstrationAreBorne) {
  long count = 0;
  int failed = 0;
  for (int i = 0; i <= kFailures; ++i) {
    const support::ScratchFolder out;
    const long number = i == 0 ? 0 : draw(i - 1, count);
    const auto done = run("", 120, number, "demo --material mica --eye-width 160 --out " + out.file("out"));
    if (i == 0) {
      ASSERT_EQ(done.exit_code, 0) << done.err;
      count = counted(report_);
      ASSERT_GE(count, 20);
      continue;
    }
    expect_a_code_and_one_error(done, number);
    failed += done.exit_code == 0 ? 0 : 1;
    if (!std::filesystem::exists(out.file("out"))) continue;
    for (const auto& file : std::filesystem::recursive_directory_iterator(out.file("out"))) {
      const std::string path = file.path().string();
      if (path.ends_with(".json")) {
        EXPECT_TRUE(nlohmann::json::accept(core::read_file(path).value_or(""))) << number << path;
      } else if (path.ends_with(".html")) {
        EXPECT_THAT(core::read_file(path).value_or(""), testing::HasSubstr("</html>")) << number;
      } else if (path.ends_with(".png")) {
        EXPECT_THAT(core::read_file(path).value_or(""), testing::HasSubstr("IEND")) << number << path;
      } else if (file.is_regular_file()) {
        EXPECT_TRUE(path.ends_with(".csv") || path.ends_with(".afms") || path.ends_with(".svg")) << number << path;
      }
    }
  }
  std::printf("demo: %d of %d failures of %s ended it\n", failed, kFailures, GetParam());
  EXPECT_GT(failed, 0);
}

TEST_P(LiveFailures, OfALiveWindowAreBorne) {
  const support::VirtualDisplay display(640, 480);
  long count = 0;
  int failed = 0;
  for (int i = 0; i <= kFailures; ++i) {
    const support::ScratchFolder sessions;
    const long number = i == 0 ? 0 : draw(i - 1, count);
    const auto done =
        run("DISPLAY=" + display.name() + " ", 8, number,
            "view --size 320x240 --eye-width 160 --frame-rate 12 --haptics sim --record " + sessions.path());
    if (i == 0) {
      ASSERT_EQ(done.exit_code, 0) << done.err;
      count = counted(report_);
      ASSERT_GE(count, 20);
      continue;
    }
    expect_a_code_and_one_error(done, number);
    failed += done.exit_code == 0 ? 0 : 1;
    for (const auto& file : std::filesystem::directory_iterator(sessions.path())) {
      const auto replayed = support::run_program(support::touchafm() + " replay " + file.path().string());
      EXPECT_EQ(replayed.exit_code, 0) << number << replayed.err;
    }
  }
  std::printf("view: %d of %d failures of %s ended it\n", failed, kFailures, GetParam());
  EXPECT_GT(failed, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, LiveFailures, testing::Values("calls", "memory"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace injected_failures_live_test
}  // namespace afm::app
