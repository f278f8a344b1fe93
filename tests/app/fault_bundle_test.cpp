// SPDX-License-Identifier: Apache-2.0
#include "app/commands/fault_bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace afm::app {
namespace fault_bundle_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto kMarie = [] { return PrivateWords{.home = "/srv/people/marie", .user = "marie", .host = "lab7"}; };

TEST(FaultBundle, LeavesOutPeopleComputerAndHomes) {
  EXPECT_EQ(without(kMarie(), "/srv/people/marie/lib/libHD.so: no"), "~/lib/libHD.so: no");
  EXPECT_EQ(without(kMarie(), "/home/pierre/.config and /home/pierre"), "~/.config and ~");
  EXPECT_EQ(without(kMarie(), "marie@lab7: marie-curie"), "USER@HOST: USER-curie");
  EXPECT_EQ(without(kMarie(), "rosemaries lab70"), "rosemaries lab70") << "other words";
  EXPECT_EQ(without({.user = "an"}, "an error"), "an error");
  EXPECT_EQ(without({}, "as it was"), "as it was");
}

TEST(FaultBundle, HasWhatAReportNeeds) {
  MachineFacts facts;
  facts.kernel = "6.1.0, PREEMPT_RT";
  facts.graphics.push_back({.name = "llvmpipe", .kind = "cpu", .driver = "Mesa 22.3", .usable = true, .reason = ""});
  facts.display = "DISPLAY=:0";
  facts.hid_nodes.push_back({"/dev/hidraw3", false});
  facts.haptics.push_back({"OpenHaptics", false, "/home/someone/libHD.so cannot be opened"});
  const std::string text = fault_bundle(facts, "graphics good\n");
  EXPECT_THAT(text, AllOf(HasSubstr("touchafm "), HasSubstr("6.1.0, PREEMPT_RT"), HasSubstr("llvmpipe"),
                          HasSubstr("DISPLAY=:0"), HasSubstr("HID /dev/hidraw3: not accessible"),
                          HasSubstr("haptic OpenHaptics: not usable; ~/libHD.so cannot be opened"),
                          HasSubstr("graphics good"), HasSubstr("what you did")));
  EXPECT_THAT(text, Not(HasSubstr("someone")));
  const PrivateWords mine = private_words();
  if (mine.host.size() > 2) {
    EXPECT_THAT(text, Not(HasSubstr(" " + mine.host)));
  }
}

}  // namespace fault_bundle_test
}  // namespace afm::app
