// SPDX-License-Identifier: Apache-2.0
// Three programs on one machine: nodes come, one is killed and comes back, and the picture is one.
// Invariant: a node that shows a wall survives any other description; it starts no servo and opens no haptic device
#include <dirent.h>
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "app/cluster/cluster_wall.h"
#include "cluster/master_link.h"
#include "core/clock.h"
#include "core/whole_file.h"
#include "exhibit/cluster/wall_model.h"
#include "support/archives/sticky_map.h"
#include "support/archives/stored_zip.h"
#include "support/faulty_device.h"
#include "support/places.h"

namespace afm::app {
namespace cluster_view_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ClusterViewTest : public ClusterWall {
 protected:
  // Node with a haptic device that would be found by any program that looks for one.
  std::unique_ptr<support::LiveProgram> node(const std::string& name, const std::string& fault = {}) const {
    std::vector<std::string> program = node_command(name, "127.0.0.1");
    if (!fault.empty()) program = test::on_faulty_device(fault, program);
    program.insert(program.begin(),
                   {"/usr/bin/env", "TOUCHAFM_HD_LIBRARY=" + support::mock_hd(), "TMPDIR=" + temporary_.path()});
    return start(program);
  }
  support::ScratchFolder temporary_;  // folder of the nodes
};

// Programs that a process has started, and devices that it has opened.
std::string children_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
  std::string all;
  std::getline(file, all);
  return all;
}
std::string open_devices_of(pid_t process) {
  std::string found;
  const std::string folder = "/proc/" + std::to_string(process) + "/fd";
  const std::unique_ptr<DIR, int (*)(DIR*)> open(::opendir(folder.c_str()), ::closedir);
  for (const dirent* entry = ::readdir(open.get()); entry != nullptr; entry = ::readdir(open.get())) {
    char target[256]{};
    if (::readlink((folder + "/" + entry->d_name).c_str(), target, sizeof(target) - 1) <= 0) continue;
    const std::string name = target;
    for (const char* device : {"/dev/hidraw", "/dev/input", "/dev/bus", "/dev/tty"}) {
      if (name.starts_with(device)) found += name + " ";
    }
  }
  return found;
}

// Whether the last line about a node says that it shows the wall. A busy machine's node can be missing for some frames.
bool is_shown(const support::LiveProgram& hand, const std::string& node) {
  const std::string all = hand.said();
  const auto end_of_last = [&](const std::string& line) { return all.rfind(line) + 1; };  // 0 if it was not logged
  return end_of_last("node " + node + " shows the wall") > end_of_last("node " + node + " is missing");
}

bool has_loaded(pid_t process, const std::string& library) {
  return core::read_file("/proc/" + std::to_string(process) + "/maps").value_or(library).find(library) !=
         std::string::npos;
}

TEST_F(ClusterViewTest, ShowsOnePictureAndGoesOnWhenANodeIsKilledAndComesBack) {
  auto left = node("left");
  const std::string swapchains = folder_.file("swapchains");
  const auto right = node("right", "barrier:" + swapchains);
  const auto hand = start(master_command());
  expect_both_shown(*hand);

  // only the master has a servo and a haptic device
  EXPECT_EQ(children_of(left->pid()), "");
  EXPECT_EQ(open_devices_of(left->pid()), "");
  EXPECT_FALSE(has_loaded(left->pid(), support::mock_hd()));
  EXPECT_TRUE(has_loaded(left->pid(), "libddsc"));

  EXPECT_THAT(left->said(), HasSubstr("without VK_NV_present_barrier"));
  EXPECT_THAT(right->said(), HasSubstr("change together with the other machines' (VK_NV_present_barrier)"));
  EXPECT_THAT(core::read_file(swapchains).value_or("none"), StartsWith("barrier"));

  // sample, eyes, parameters, eye distance, stereo mode, head; once the servo has the sample, friction loop and scan
  press_at_master("2 s F2 F8 v Left");
  ASSERT_TRUE(hand->says("chosen: Gold")) << hand->said();
  for (const char* said : {"eyes swapped", "Press Turn-On"}) {  // order in which key and servo are ready
    ASSERT_TRUE(hand->within(std::chrono::minutes(1), [&] { return hand->said().find(said) != std::string::npos; }))
        << hand->said();
  }
  xdotool("search --name 'output 1' windowfocus --sync key KP_Enter");
  ASSERT_TRUE(hand->says("force off: Stop was pressed")) << "at a node: " << hand->said();
  press_at_master("f i");
  ASSERT_TRUE(hand->says("scan: Gold")) << hand->said();
  EXPECT_TRUE(all_same()) << hand->said();
  press_at_master("i e");  // with a sanitizer a scan takes nearly all of each frame's time

  ASSERT_TRUE(hand->within(std::chrono::minutes(1), [&] { return is_shown(*hand, "left"); })) << hand->said();
  hand->skip_what_it_said();
  left->signal(SIGKILL);
  EXPECT_EQ(left->ends(), 128 + SIGKILL);
  EXPECT_TRUE(std::filesystem::is_empty(temporary_.path())) << "left by a node that was killed";
  ASSERT_TRUE(hand->says("node left is missing")) << hand->said();
  left = node("left");
  ASSERT_TRUE(hand->says("node left shows the wall")) << hand->said();
  EXPECT_TRUE(all_same()) << hand->said();

  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
  EXPECT_THAT(hand->said(), HasSubstr(" 0 built otherwise, 0 samples repaired"));
  EXPECT_THAT(hand->said(), Not(HasSubstr("otherwise: ")));
  right->signal(SIGTERM);
  EXPECT_EQ(right->ends(), 0) << right->said();
  left->signal(SIGTERM);
  EXPECT_EQ(left->ends(), 0) << left->said();
  EXPECT_THAT(left->said(), HasSubstr("cluster: node left ends; 0 datagrams refused"));
  // master and node name the session alike
  const std::string session = "cluster: session ";
  const std::size_t at = hand->said().find(session);
  ASSERT_NE(at, std::string::npos) << hand->said();
  const std::string named = hand->said().substr(at, hand->said().find(',', at) - at);
  EXPECT_THAT(left->said(), HasSubstr(named + ": node left of the wall"));
}

TEST_F(ClusterViewTest, ShowsThePixelOfAForceMapThatIsFelt) {
  const auto left = node("left"), right = node("right");
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--force-map", folder_.write("gel.jpk-force-map",
                                                              test::stored_zip(test::jpk_map(test::sticky_curve)))});
  const auto hand = start(command);
  expect_both_shown(*hand);
  ASSERT_TRUE(hand->within(std::chrono::minutes(1), [&] {
    return hand->said().find("Press Turn-On") != std::string::npos;
  })) << hand->said();
  left->skip_what_it_said();
  press_at_master("plus");
  ASSERT_TRUE(hand->says("force map: pixel 2,1")) << hand->said();
  EXPECT_TRUE(left->says("it is curve 3 of 6")) << "the node does not read the pixel: " << left->said();
  EXPECT_TRUE(all_same()) << hand->said();
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
  EXPECT_THAT(hand->said(), HasSubstr(" 0 built otherwise"));
  EXPECT_THAT(hand->said(), Not(HasSubstr("otherwise: ")));
}

TEST_F(ClusterViewTest, ShowsALeverThatTapsWithItsDialAndItsChanges) {
  const auto left = node("left"), right = node("right");
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--mode", "tapping", "--free-amplitude", "20nm", "--resonance", "300kHz",
                                 "--quality-factor", "400", "--spring-constant", "40N/m", "--haptics", "sim"});
  const auto hand = start(command);
  expect_both_shown(*hand);
  press_at_master("1 F6 f");
  ASSERT_TRUE(hand->says("chosen: Mica")) << hand->said();
  ASSERT_TRUE(hand->says("jump to the repulsive state")) << hand->said();
  press_at_master("plus");
  ASSERT_TRUE(hand->says("the changed parameters are now in effect")) << hand->said();
  ASSERT_TRUE(hand->says("jump to the repulsive state")) << hand->said();
  press_at_master("KP_Enter");
  ASSERT_TRUE(hand->says("force off: Stop was pressed")) << hand->said();
  EXPECT_TRUE(all_same()) << hand->said();
  // image of the sample, with another free amplitude, then another drive
  press_at_master("i Tab Tab Tab Tab Tab Tab Tab minus");
  ASSERT_TRUE(hand->says("19 nm, 300 kHz")) << hand->said();
  press_at_master("Tab minus");
  ASSERT_TRUE(hand->says("19 nm, 299.925 kHz")) << hand->said();
  press_at_master("i");
  ASSERT_TRUE(hand->says("scan: ended")) << hand->said();
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
  EXPECT_THAT(hand->said(), HasSubstr(" 0 built otherwise"));
  EXPECT_THAT(hand->said(), Not(HasSubstr("otherwise: ")));
}

// Marks on the sample, which grow while the simulated hand touches it, and a node that comes when they are there.
TEST_F(ClusterViewTest, ShowsTheMarksOfATipWithInk) {
  const auto left = node("left");
  auto right = node("right");
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--particles", "write-ink", "--haptics", "sim"});
  const auto hand = start(command);
  expect_both_shown(*hand);
  press_at_master("1");
  ASSERT_TRUE(hand->says("the tip touches: ink flows")) << hand->said();
  ASSERT_TRUE(hand->says("the liquid tears")) << hand->said();
  right->signal(SIGTERM);
  EXPECT_EQ(right->ends(), 0) << right->said();
  right = node("right");
  ASSERT_TRUE(hand->says("node right shows the wall")) << hand->said();
  press_at_master("KP_Enter");
  ASSERT_TRUE(hand->says("force off")) << hand->said();
  EXPECT_TRUE(all_same()) << hand->said();
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
  EXPECT_THAT(hand->said(), HasSubstr(" 0 built otherwise"));
  EXPECT_THAT(hand->said(), Not(HasSubstr("otherwise: ")));
}

// The other machines show the numbers of each law, lever, tip, medium and tool that is chosen and the picture of
// another level, as does one that comes later.
TEST_F(ClusterViewTest, FollowsTheSettingsAmongParticles) {
  const auto left = node("left");
  auto right = node("right");
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--particles", "gold-row", "--haptics", "sim"});
  const auto hand = start(command);
  expect_both_shown(*hand);
  press_at_master("1");
  ASSERT_TRUE(hand->says("chosen: Mica")) << hand->said();
  for (const char* chosen : {"friction law amontons", "lever ", "tip ", "medium humid air", "tool grip", "level 1"}) {
    press_at_master("Insert");
    ASSERT_TRUE(hand->says("; Delete chooses the next")) << hand->said();
    press_at_master("Delete");
    ASSERT_TRUE(hand->says(chosen)) << hand->said();
    ASSERT_TRUE(hand->says(": as soon as the tip is off")) << hand->said();
    EXPECT_NE(hand->says_one_of({": in use", ": the tip holds what it touched"}), "") << chosen << hand->said();
    EXPECT_TRUE(all_same()) << chosen << hand->said();
  }
  press_at_master("F5");
  EXPECT_TRUE(hand->says("lies 0.00 nm from where the picture had it")) << hand->said();
  EXPECT_TRUE(all_same()) << hand->said();
  right->signal(SIGTERM);
  EXPECT_EQ(right->ends(), 0) << right->said();
  right = node("right");
  ASSERT_TRUE(hand->says("node right shows the wall")) << hand->said();
  EXPECT_TRUE(all_same()) << hand->said();
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
  EXPECT_THAT(hand->said(), HasSubstr(" 0 built otherwise"));
  EXPECT_THAT(hand->said(), Not(HasSubstr("otherwise: ")));
}

// Descriptions of garbage, of another build, and of a wall that needs something missing on this machine.
TEST_F(ClusterViewTest, ANodeThatShowsAWallKeepsItWhenADescriptionCannotBeShown) {
  const auto left = node("left");
  const auto hand = start(master_command());
  ASSERT_TRUE(hand->says("node left shows the wall")) << hand->said();
  const core::MonotonicClock clock;
  const std::vector<std::byte> junk(2000, std::byte{'['});
  exhibit::WallModel other_build, no_probe;
  other_build.wall = no_probe.wall = core::read_file(folder_.file("wall.toml")).value();
  other_build.build = 1;
  no_probe.build = exhibit::build_digest(support::touchafm()).value();
  no_probe.files.probe = "/no/such/probe.glb";
  for (const std::vector<std::byte>& forged :
       {junk, exhibit::document_of(other_build), exhibit::document_of(no_probe)}) {
    const auto stray = cluster::MasterLink::open({.interface_address = "127.0.0.1",
                                                  .peers = {"127.0.0.1"},
                                                  .domain = static_cast<std::uint32_t>(std::stoul(domain()))},
                                                 forged, 0, clock);
    ASSERT_TRUE(stray) << stray.error().message;
    ASSERT_TRUE(left->says("another wall was announced, but cannot be shown: ")) << left->said();
  }
  // the node still follows its master
  press_at_master("2");
  ASSERT_TRUE(hand->says("chosen: Gold")) << hand->said();
  const auto frames_same = [&] {
    const render::Image seen = display_.screenshot();
    return is_drawn(seen, 0) && difference(seen, 0, 1) == 0;
  };
  EXPECT_TRUE(left->within(std::chrono::minutes(1), frames_same)) << left->said();
  left->signal(SIGTERM);
  EXPECT_EQ(left->ends(), 0) << left->said();
}

// Each master listened before the other could be heard.
TEST_F(ClusterViewTest, OfTwoMastersOneEndsWithAReason) {
  std::vector<std::unique_ptr<support::LiveProgram>> masters;
  std::vector<std::unique_ptr<support::ScratchFolder>> folders;
  for (int i = 0; i < 2; ++i) {
    folders.push_back(std::make_unique<support::ScratchFolder>());
    std::vector<std::string> command = master_command();
    command.insert(command.begin(), {"/usr/bin/env", "XDG_RUNTIME_DIR=" + folders.back()->path()});
    masters.push_back(start(command));
  }
  const auto ends = [&](std::size_t i) {
    const std::string said = masters[i]->said();
    return said.find("another master, which started earlier, drives") != std::string::npos ||
           said.find("another master already drives") != std::string::npos;
  };
  ASSERT_TRUE(masters[0]->within(std::chrono::minutes(1), [&] { return ends(0) || ends(1); })) << masters[0]->said();
  const std::size_t later = ends(0) ? 0 : 1;
  EXPECT_EQ(masters[later]->ends(), 2) << masters[later]->said();
  EXPECT_FALSE(ends(1 - later)) << masters[1 - later]->said();
  masters[1 - later]->signal(SIGTERM);
  EXPECT_EQ(masters[1 - later]->ends(), 0) << masters[1 - later]->said();
}

}  // namespace cluster_view_test
}  // namespace afm::app
