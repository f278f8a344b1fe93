// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/recorded_wall.h"
#include "exhibit/scan/live_scan.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "exhibit/state/lines_to_write.h"

namespace afm::exhibit {
namespace recorded_wall_test {

const std::vector<std::string> kShown{"mica", "gold", "nitride"};
constexpr std::int64_t kFirstNs = 5'000'000'000, kFrameNs = 100'000'000;

// A moment in which everything differs from a wall at its start.
Moment changed() {
  Moment moment;
  moment.wall.navigation =
      glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, -0.2, 0.3)), 0.4, glm::dvec3(0, 1, 0));
  moment.wall.centerpiece = Centerpiece::Journey;
  moment.wall.journey_orders = 3.5;
  moment.wall.fade = 0.25;
  moment.wall.hovered = 2;
  input::WandState& wand = moment.wall.wand.emplace();
  wand.position_m = {0.5, 1.25, -0.75};
  wand.room_from_wand = glm::dquat(0.5, 0.5, -0.5, 0.5);
  wand.orientation_valid = wand.position_valid = wand.connected = true;
  wand.buttons = 5;
  moment.guidance = "Lift the tip";
  moment.retracting = true;
  moment.wall.release_z_m = 12e-9;
  moment.servo = {{"hand", "0.6 mm/nm", "scale fit"}, {"servo", "1000 Hz", ""}};
  return moment;
}

// Four frames: the third is `changed`.
servo::RecordedSession session() {
  servo::RecordedSession session;
  session.material = "gold";
  session.shown = kShown;
  for (std::int64_t i = 0; i < 400; ++i) {
    scene::TipSample& sample = session.samples.emplace_back();
    sample.tick = static_cast<std::uint64_t>(i);
    sample.time_ns = kFirstNs + i * 1'000'000;
    sample.material = 1;
  }
  for (std::int64_t i = 0; i < 4; ++i) {
    session.wall.push_back(wall_frame_of(i == 2 ? changed() : Moment(), kFirstNs + i * kFrameNs, kShown));
  }
  return session;
}

TEST(RecordedWall, ShowsAFrameAsItWas) {
  const servo::RecordedSession all = session();
  for (const servo::WallFrame& frame : all.wall) {
    const RecordedMoment then = moment_on_wall(all, kShown, frame.time_ns);
    EXPECT_EQ(then.frame, &frame);
    EXPECT_EQ(wall_frame_of(then.moment, frame.time_ns, kShown), frame);
    EXPECT_EQ(then.moment.wall.material, 1U);
    EXPECT_EQ(then.curves.size(), kShown.size());
  }
  EXPECT_NE(all.wall[2], all.wall[1]);
}

TEST(RecordedWall, ShowsAFrameUntilTheNextOneAndTheFirstOneBeforeIt) {
  const servo::RecordedSession all = session();
  EXPECT_EQ(moment_on_wall(all, kShown, 0).frame, &all.wall[0]);
  EXPECT_EQ(moment_on_wall(all, kShown, kFirstNs + 2 * kFrameNs - 1).frame, &all.wall[1]);
  EXPECT_EQ(moment_on_wall(all, kShown, kFirstNs + 3 * kFrameNs - 1).frame, &all.wall[2]);
  EXPECT_EQ(moment_on_wall(all, kShown, kFirstNs + 9 * kFrameNs).frame, &all.wall[3]);
}

TEST(RecordedWall, KeepsLinesToBeWritten) {
  const LinesToWrite lines{.lines_m = {{{-80e-9, 40e-9}, {80e-9, 40e-9}}, {{0.0, 40e-9}, {1e-9, 0.0}, {2e-9, -1e-9}}},
                           .width_m = 20e-9};
  const LinesToWrite back = lines_of(recorded_lines(lines));
  EXPECT_EQ(back.lines_m, lines.lines_m);
  EXPECT_EQ(back.width_m, lines.width_m);
}

}  // namespace recorded_wall_test
}  // namespace afm::exhibit
