// SPDX-License-Identifier: Apache-2.0
#include "servo/keep_running.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/whole_file.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace keep_running_test {

using ::testing::HasSubstr;

class KeepRunning : public ::testing::Test {
 protected:
  // A program that notes each of its starts and then does what `end` says.
  core::Result<void> run(const std::string& end) {
    return keep_running("/bin/sh", {"-c", "echo started >> " + starts() + "; " + end});
  }
  std::string starts() const { return folder_.file("starts"); }
  std::ptrdiff_t times() const {
    const std::string text = core::read_file(starts()).value();
    return std::count(text.begin(), text.end(), '\n');
  }
  support::ScratchFolder folder_;
};

TEST_F(KeepRunning, EndsWithAProgramThatEndsWell) {
  EXPECT_TRUE(run("exit 0"));
  EXPECT_EQ(times(), 1);
}

TEST_F(KeepRunning, StartsACrashedProgramAgain) {
  EXPECT_TRUE(run("test $(wc -l < " + starts() + ") -ge 3 && exit 0; kill -SEGV $$"));
  EXPECT_EQ(times(), 3);
}

TEST_F(KeepRunning, GivesUpOnOneThatCannotRun) {
  const auto done = run("exit 1");
  ASSERT_FALSE(done);
  EXPECT_EQ(times(), kMostRestarts + 1);
  EXPECT_THAT(done.error().message, HasSubstr("ended with exit code 1 6 times within a minute"));
}

TEST_F(KeepRunning, DoesNotRepeatWhatIsRefused) {
  EXPECT_EQ(run("exit 2").error().category, core::ErrorCategory::WrongUsage);
  EXPECT_EQ(run("exit 3").error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(run("exit 4").error().category, core::ErrorCategory::DeviceMissing);
  EXPECT_EQ(times(), 3);
  EXPECT_FALSE(keep_running("/nowhere/touchafm", {}));
}

}  // namespace keep_running_test
}  // namespace afm::servo
