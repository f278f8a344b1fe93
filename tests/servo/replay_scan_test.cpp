// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "servo/recorded_servo.h"
#include "servo/session_file.h"
#include "support/paper_model.h"
#include "support/samples/rough_surface.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_scan_test {

using scene::ScanHand;
using scene::ScanLead;

RecordedSession saved_and_loaded(const RecordedSession& session) {
  const support::ScratchFolder folder;
  EXPECT_TRUE(save_session(session, folder.file("scan.afms")));
  auto loaded = load_session(folder.file("scan.afms"));
  EXPECT_TRUE(loaded) << loaded.error().message;
  return std::move(*loaded);
}

// A scan with missing frames and a path that jumps.
TEST(Replay, GivesAHandThatAScanLeadsAgain) {
  Recording recording;
  recording.choose(test::kMica);
  recording.scan = [&] {
    const double way_nm = 4.0 * std::sin(2e-9 * static_cast<double>(recording.now_ns));
    return ScanLead{.apex_xy_m = {1e-9 * way_nm, 0.0}, .height_m = 2e-9, .hand = ScanHand::Led};
  };
  recording.arm();
  recording.aim(0.03, 0.4, true);
  recording.run(2500);
  auto scan = std::exchange(recording.scan, nullptr);
  recording.run(500);
  recording.scan = scan;
  recording.run(200);
  recording.aim(0.03, 0.1, false);
  recording.run(200);
  recording.aim(0.03, 0.1, true);
  recording.run(900);
  recording.scan = [] { return ScanLead{.apex_xy_m = {9e-9, 3e-9}, .hand = ScanHand::Led}; };
  recording.run(300);
  recording.scan = nullptr;
  recording.cycle();
  const RecordedSession session = saved_and_loaded(recording.sessions.front());
  const auto led = std::count_if(session.samples.begin(), session.samples.end(),
                                 [](const auto& sample) { return sample.scan.hand == ScanHand::Led; });
  EXPECT_GT(led, 3000);
  expect_same(session);
  RecordedSession without = session;
  for (auto& sample : without.samples) sample.scan = {};
  EXPECT_FALSE(replay(without)->identical());
}

TEST(Replay, GivesAHandThatScansAgain) {
  Recording recording(test::rough_model());
  recording.choose(test::kMica);
  double gain_per_s = 20.0;
  recording.scan = [&] { return ScanLead{.gain_per_s = gain_per_s, .hand = ScanHand::Scans, .feedback = 1}; };
  recording.arm();
  recording.aim(-0.004, 0.5);
  recording.run(900);
  for (const double x_m : {0.02, -0.02, 0.01}) {
    recording.aim(-0.004, 0.5, false, x_m);
    recording.run(700);
    gain_per_s *= 5.0;
  }
  recording.aim(0.065, 0.7);
  recording.run(900);
  recording.scan = nullptr;
  recording.cycle();
  RecordedSession session = recording.sessions.front();
  session.surface = test::rough_model().height_fields[0];
  session.parameters.height_field = 0;
  EXPECT_GT(strongest_n(session), 0.1);
  const RecordedSession loaded = saved_and_loaded(session);
  expect_same(loaded);
  RecordedSession without = loaded;
  for (auto& sample : without.samples) sample.scan = {};
  EXPECT_FALSE(replay(without)->identical());
}

}  // namespace replay_scan_test
}  // namespace afm::servo
