// SPDX-License-Identifier: Apache-2.0
// The example of docs/tracker-bridge.md, as the page has it, into a real socket.
#include <gtest/gtest.h>

#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "core/clock.h"
#include "core/whole_file.h"
#include "input/dtrack_source.h"
#include "support/fenced_blocks.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::input {
namespace tracker_bridge_test {

std::string block(const std::string& language, const std::string& words = {}) {
  const std::string text =
      support::fenced_block(core::read_file(support::source("docs/tracker-bridge.md")).value(), language, words);
  EXPECT_NE(text, "") << language << " " << words;
  return text;
}

TEST(TrackerBridge, PrintsADatagramThatIsRead) {
  const auto frame = parse_dtrack(block("", "fr 17"));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->frame, 17U);
  EXPECT_EQ(frame->faults.count, 0U);
  EXPECT_LT(glm::distance(frame->body(0)->position_m, glm::dvec3(0.12, -2.4, 1.66)), 1e-9);
  EXPECT_EQ(frame->flystick(0)->buttons, 1U);
}

TEST(TrackerBridge, SendsPosesThatAreRead) {
  const support::ScratchFolder folder;
  const std::string script = folder.write("bridge.py", block("python"));
  const core::MonotonicClock clock;
  DtrackSettings settings;
  settings.port = 0;
  const auto source = DtrackSource::open(settings, clock);
  ASSERT_TRUE(source) << source.error().message;
  const std::string command = "python3 -u " + script + " 127.0.0.1 " + std::to_string((*source)->port());
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> bridge(::popen(command.c_str(), "w"), ::pclose);
  ASSERT_NE(bridge, nullptr);
  // turned by 90 degrees about z: its x axis points along y
  std::fputs("body 2 0.1 -2.4 1.66 0 0 0.70710678 0.70710678\n", bridge.get());
  std::fputs("stick 0 0.3 -1.5 1.2 0 0 0 1 5 0.5 -1\n", bridge.get());
  std::fflush(bridge.get());
  DtrackUpdate update;
  for (int i = 0; i < 2000 && update.good_packets < 2; ++i) {
    (*source)->poll();
    update = (*source)->newest();
  }
  ASSERT_EQ(update.good_packets, 2U);
  EXPECT_EQ(update.bad_packets + update.left_out, 0U);
  const DtrackBody* const head = update.frame.body(2);
  ASSERT_NE(head, nullptr);
  EXPECT_LT(glm::distance(head->position_m, glm::dvec3(0.1, -2.4, 1.66)), 1e-6);
  EXPECT_LT(glm::distance(head->tracker_from_body * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-5);
  const DtrackFlystick* const stick = update.frame.flystick(0);
  ASSERT_NE(stick, nullptr);
  EXPECT_EQ(stick->buttons, 5U);
  EXPECT_EQ(stick->joystick[0], 0.5);
  EXPECT_EQ(stick->joystick[1], -1.0);
}

}  // namespace tracker_bridge_test
}  // namespace afm::input
