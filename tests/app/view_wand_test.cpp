// SPDX-License-Identifier: Apache-2.0
// The real window with a tracker's Flystick and glasses: packets of DTrack's through a socket, garbage between them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "exhibit/frame/exhibit_setup.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/tracker.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace view_wand_test {

using ::testing::HasSubstr;

TEST(ViewWand, AFlystickChoosesGoldMovesTheSceneAndBringsItHome) {
  exhibit::ExhibitFiles files;
  files.assets_dir = support::source("assets");
  const exhibit::Stage stage = exhibit::load_exhibit(files).value();
  const glm::dvec3 gold = stage.wall_scene.swatch_targets()[1].center_m;
  const glm::dvec3 hand(0.5, 1.2, 1.8);
  const support::VirtualDisplay display(320, 240);
  support::Tracker tracker;
  tracker.show(hand, gold + glm::dvec3(3.0, 0.0, 0.0), 0);
  support::LiveProgram view(
      {support::touchafm(), "view", "--size", "320x240", "--frame-rate", "12", "--eye-width", "160", "--servo",
       support::servo_mode(), "--wand", "dtrack:" + tracker.place(), "--head", "dtrack:2", "--validate"},
      display.name());
  ASSERT_TRUE(view.says("listening for a tracker at " + tracker.place())) << view.said();
  ASSERT_TRUE(view.says("Choose a sample")) << view.said();
  // a press before the ray has reached the swatch chooses nothing
  for (int press = 0; press < 60; ++press) {
    tracker.show(hand, gold, press % 2 == 0 ? 0 : 1);
    if (view.says("chosen: Gold", std::chrono::seconds(1))) break;
  }
  ASSERT_THAT(view.said(), HasSubstr("chosen: Gold"));
  // held fast wherever the first frame with the button finds it, then moved
  for (int step = 0; step < 60; ++step) {
    tracker.show(hand + (step % 2 == 0 ? glm::dvec3(0.0) : glm::dvec3(0.2, 0.3, 0.0)), gold, 2);
    if (view.says("wand: the scene was moved", std::chrono::seconds(1))) break;
  }
  ASSERT_THAT(view.said(), HasSubstr("wand: the scene was moved"));
  tracker.show(hand, gold, 8);
  ASSERT_TRUE(view.says("wand: the scene is back in its place")) << view.said();
  tracker.show(hand, gold, 0, {0.0, -0.85, 2.0});
  ASSERT_TRUE(view.says("head: the tracker reports an impossible position, 0.85 m below the floor")) << view.said();
  tracker.show(hand, gold, 0);
  ASSERT_TRUE(view.says("head: the tracked position is plausible again")) << view.said();
  tracker.fall_silent();
  ASSERT_TRUE(view.says("tracker: no frame for 1 s")) << view.said();
  view.signal(SIGINT);
  EXPECT_EQ(view.ends(), 0) << view.said();
  EXPECT_TRUE(view.says("head: latency from packet to presented frame")) << view.said();
  EXPECT_TRUE(view.says("tracker: in the whole run: ")) << view.said();
}

struct Contact {
  int moved = 0, told = 0;  // numbers of log lines: the scene was moved; it is locked
  bool whole = false;       // true: the tip jumped off before the force ended
};

std::vector<Contact> contacts_in(const std::string& said) {
  std::vector<Contact> all;
  bool attached = false;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    const auto has = [&](const char* text) { return line.find(text) != std::string::npos; };
    if (has("jump to contact")) all.emplace_back();
    attached = (attached || has("jump to contact")) && !has("force off");
    if (!attached) continue;
    all.back().moved += has("wand: the scene was moved") ? 1 : 0;
    all.back().told += has("wand: the scene is locked") ? 1 : 0;
    all.back().whole = has("jump off contact");
    attached = !all.back().whole;
  }
  return all;
}

bool whole_pulled_contact(const std::string& said) {
  const std::vector<Contact> all = contacts_in(said);
  return std::any_of(all.begin(), all.end(), [](const Contact& contact) { return contact.whole && contact.told > 0; });
}

// The message is logged once, not in each frame while the wand continues to pull.
void expect_locked_in_contact(const std::string& said) {
  for (const Contact& contact : contacts_in(said)) {
    EXPECT_EQ(contact.moved, 0) << said;
    EXPECT_LE(contact.told, 1) << said;
  }
}

// A scene that moves would throw a hand that is on the sample.
TEST(ViewWand, MovesNothingWhileTheTipIsInContact) {
  const glm::dvec3 hand(0.5, 1.2, 1.8), aim(0.0, 1.2, 0.0);
  const support::VirtualDisplay display(320, 240);
  support::Tracker tracker;
  tracker.show(hand, aim, 0);
  support::LiveProgram view(
      {support::touchafm(), "view", "--size", "320x240", "--frame-rate", "12", "--eye-width", "160", "--servo",
       support::servo_mode(), "--haptics", "sim", "--material", "gold", "--wand", "dtrack:" + tracker.place()},
      display.name());
  ASSERT_TRUE(view.says("F1 shows the keys")) << view.said();
  ASSERT_EQ(support::run_program("DISPLAY=" + display.name() + " xdotool mousemove 160 10 key 1").exit_code, 0);
  ASSERT_TRUE(view.says("jump to contact")) << view.said();
  // a late tick ends the force, and with it the contact: the simulated hand begins again
  for (int step = 0; step < 120 && !whole_pulled_contact(view.said()); ++step) {
    tracker.show(hand + (step % 2 == 0 ? glm::dvec3(0.0) : glm::dvec3(0.2, 0.3, 0.0)), aim, 2);
    view.says("jump off contact", std::chrono::seconds(1));
  }
  EXPECT_TRUE(whole_pulled_contact(view.said())) << view.said();
  expect_locked_in_contact(view.said());
}

}  // namespace view_wand_test
}  // namespace afm::app
