// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/fault_bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/doctor/private_words.h"
#include "haptics/device_registry.h"

namespace afm::app {
namespace fault_bundle_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

PrivateWords marie() {
  return {.homes = {"/srv/people/marie"},
          .users = {"marie"},
          .hosts = {"alices-laptop.physics.example.edu", "alices-laptop", "lab7"},
          .paths = {"/srv/drivers of Marie/libHD.so"}};
}

TEST(FaultBundle, LeavesOutPeopleComputerAndHomes) {
  EXPECT_EQ(without(marie(), "/srv/people/marie/lib/libHD.so: no"), "~/lib/libHD.so: no");
  EXPECT_EQ(without(marie(), "/home/pierre/.config and /home/pierre"), "~/.config and ~");
  EXPECT_EQ(without(marie(), "marie@lab7: Marie-curie"), "USER@HOST: USER-curie");
  EXPECT_EQ(without(marie(), "rosemaries lab70"), "rosemaries lab70") << "other words";
  EXPECT_EQ(without({.users = {"an"}}, "an error"), "an error");
  EXPECT_EQ(without({}, "as it was"), "as it was");
}

TEST(FaultBundle, LeavesOutTheHostOfAForwardedDisplay) {
  EXPECT_EQ(without(marie(), "DISPLAY=alices-laptop.physics.example.edu:10.0"), "DISPLAY=HOST:10.0");
  EXPECT_EQ(without(marie(), "DISPLAY=:0, localhost:10"), "DISPLAY=:0, localhost:10");
}

TEST(FaultBundle, LeavesOutFoldersThatAreNotTheSystems) {
  EXPECT_EQ(without({}, "hdapi library /srv/people/alice.liddell/libHD.so: loaded"),
            "hdapi library .../libHD.so: loaded");
  EXPECT_EQ(without({}, "/mnt/alice/a, \"/media/alice/b\", X=/run/media/alice/c"), ".../a, \".../b\", X=.../c");
  EXPECT_EQ(without(marie(), "/srv/drivers of Marie/libHD.so: no"), ".../libHD.so: no");
  for (const char* kept :
       {"/usr/lib/libHD.so", "/dev/dri/renderD128: accessible", "/etc/udev/rules.d/70-touchafm.rules",
        "see https://example.org/a/b", "read/write", "none"}) {
    EXPECT_EQ(without(marie(), kept), kept);
  }
}

TEST(FaultBundle, KeepsADevicesModelAlone) {
  EXPECT_EQ(model_of("Phantom Omni"), "Phantom Omni");
  EXPECT_EQ(model_of("Touch X, serial 0123"), "Touch X (rest of the name left out)");
  EXPECT_EQ(model_of("Touch of Alice Liddell 0123, serial Alice"), "Touch (rest of the name left out)");
  EXPECT_EQ(model_of("Alice"), "(name left out)");
  EXPECT_EQ(model_of("omega.3, serial 1234"), "omega.3 (rest of the name left out)");
  EXPECT_EQ(model_of("inverse3 049D, minverse 0012"), "inverse3 minverse (rest of the name left out)");
}

TEST(FaultBundle, KeepsTheNameOfEveryKindOfDevice) {
  for (const haptics::DeviceKind& kind : haptics::device_kinds()) {
    if (kind.word == haptics::simulated_kind().word) continue;  // simulated device, which nobody owns
    EXPECT_EQ(model_of(kind.subject), kind.subject);
  }
}

TEST(FaultBundle, HasWhatAReportNeeds) {
  MachineFacts facts;
  facts.kernel = "6.1.0, PREEMPT_RT";
  facts.graphics.push_back({.name = "llvmpipe", .kind = "cpu", .driver = "Mesa 22.3", .usable = true, .reason = ""});
  facts.display = "DISPLAY=:0";
  facts.hid_nodes.push_back({"/dev/hidraw3", false});
  facts.haptics.push_back({"hdapi (OpenHaptics)", true, "Touch of Alice, serial 0123: 3.3 N peak"});
  facts.haptics.push_back({"OpenHaptics", false, "/home/someone/libHD.so cannot be opened"});
  facts.haptics.push_back({"forcedimension device", false, "(#0: serial 4711, #1: serial 4712)"});
  facts.haptics.push_back({"haply device", true, "inverse3 49D1: its service answers at port 10001"});
  const std::string text = fault_bundle(facts, "graphics good\nhaptic device: Touch of Alice, serial 0123\n");
  EXPECT_THAT(text, AllOf(HasSubstr("touchafm "), HasSubstr("6.1.0, PREEMPT_RT"), HasSubstr("llvmpipe"),
                          HasSubstr("DISPLAY=:0"), HasSubstr("HID /dev/hidraw3: not accessible"),
                          HasSubstr("haptic OpenHaptics: not usable; ~/libHD.so cannot be opened"),
                          HasSubstr("graphics good"), HasSubstr("what you did")));
  for (const char* secret : {"someone", "Alice", "0123", "471", "49D1"}) EXPECT_THAT(text, Not(HasSubstr(secret)));
  EXPECT_THAT(text, HasSubstr("Touch (rest of the name left out): 3.3 N peak"));
}

}  // namespace fault_bundle_test
}  // namespace afm::app
