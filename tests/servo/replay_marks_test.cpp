// SPDX-License-Identifier: Apache-2.0
// Sessions whose sample keeps marks, scratches or ink: recorded, stored, and replayed bit for bit.
// Invariant: a replay makes every mark and stroke of its session again, bit for bit
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/whole_file.h"
#include "servo/recorded_servo.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "support/particles/ink_sample.h"
#include "support/particles/soft_sample.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_marks_test {

using physics::EventKind;
using scene::ScaleMode;
using testing::HasSubstr;

// Lifts, presses, scratches, and lifts again.
void scratch(Recording& recording, double y_m) {
  recording.arm();
  recording.go({-0.015, y_m}, 0.03, 0.3);
  recording.run(500);
  recording.go({-0.015, y_m}, -0.010, 0.5);
  recording.run(700);
  recording.go({0.015, y_m}, -0.010, 0.8);
  recording.run(1000);
  recording.go({-0.015, y_m}, -0.010, 0.1);  // motion that is too fast
  recording.run(300);
  recording.go({-0.015, y_m}, 0.06, 0.3);
  recording.run(700);
}

// Touches, writes a line with a dot at its end, and tears off.
void write(Recording& recording, double y_m) {
  recording.arm();
  recording.go({-0.015, y_m}, 0.03, 0.3);
  recording.run(500);
  recording.go({-0.015, y_m}, -0.003, 0.5);
  recording.run(700);
  recording.go({0.015, y_m}, -0.002, 1.5);
  recording.run(2200);
  recording.go({0.015, y_m}, 0.06, 0.5);
  recording.run(900);
}

// One kind of mark: its sample, a stroke that leaves one, the events of a stroke, and a value that no file may hold.
struct Marks {
  const char* name;
  decltype(&test::ink_model) model;
  void (*stroke)(Recording&, double y_m);
  EventKind once;           // event that occurs exactly once per stroke
  EventKind at_least_once;  // event that occurs at least once per stroke
  void (*damage)(scene::SharedParticles&);
  const char* named;  // name of the damaged part, in the error
};

const Marks kMarks[] = {
    {"Scratches", &test::soft_model, &scratch, EventKind::SurfaceMarked, EventKind::HandTooFast,
     [](scene::SharedParticles& set) { set.soft.pile_up_share = 7.0; }, "soft sample"},
    {"Ink", &test::ink_model, &write, EventKind::InkFlows, EventKind::LiquidTorn,
     [](scene::SharedParticles& set) { set.ink.footprint_m2 = 7.0; }, "ink"},
};

class ReplayOfMarks : public testing::TestWithParam<Marks> {
 protected:
  ReplayOfMarks() { recording.choose(test::kMica, ScaleMode::Particles); }
  Recording recording{GetParam().model()};
  const support::ScratchFolder folder;
};

INSTANTIATE_TEST_SUITE_P(Of, ReplayOfMarks, testing::ValuesIn(kMarks),
                         [](const auto& which) { return std::string(which.param.name); });

std::size_t count(const RecordedSession& session, EventKind kind) {
  return static_cast<std::size_t>(std::count_if(session.events.begin(), session.events.end(),
                                                [&](const scene::TipEvent& event) { return event.kind == kind; }));
}

TEST_P(ReplayOfMarks, GivesEveryBitAgainOnBareAndOnMarkedSamples) {
  GetParam().stroke(recording, 0.0);
  recording.choose(test::kGold, ScaleMode::Particles);  // another session, on the same marks
  GetParam().stroke(recording, 0.001);
  ASSERT_EQ(recording.sessions.size(), 2U);
  for (const RecordedSession& session : recording.sessions) {
    EXPECT_EQ(count(session, GetParam().once), 1U);
    EXPECT_GE(count(session, GetParam().at_least_once), 1U);
    EXPECT_EQ(scene::digest_of(session.particles->tiles), session.samples.front().push.digest);
    EXPECT_GT(strongest_n(session), 0.1);
    expect_same(session);
    RecordedSession stored = session;
    stored.hand_m_per_m = stored.hand_n_per_n = 1.0;
    ASSERT_TRUE(save_session(stored, folder.file("marks.afms")));
    const auto loaded = load_session(folder.file("marks.afms"));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->particles->tiles, session.particles->tiles);
    EXPECT_EQ(loaded->particles->set.soft, session.particles->set.soft);
    EXPECT_EQ(loaded->particles->set.ink, session.particles->set.ink);
    expect_same(*loaded);
    const auto then = replay_particles(*loaded, loaded->samples.back().time_ns);
    ASSERT_TRUE(then) << then.error().message;
    EXPECT_EQ(scene::digest_of(then->tiles), session.samples.back().push.digest);
  }
  EXPECT_NE(recording.sessions[0].samples.front().push.digest, recording.sessions[1].samples.front().push.digest);
}

TEST_P(ReplayOfMarks, FindsWhatWasTakenBack) {
  GetParam().stroke(recording, 0.0);
  recording.release(test::kMica, ScaleMode::Particles);
  recording.run(300);
  ++recording.taken_back;
  recording.run(300);
  GetParam().stroke(recording, 0.003);
  recording.release(test::kMica, ScaleMode::Particles);
  recording.run(300);
  ++recording.put_back;
  recording.run(300);
  const RecordedSession& session = recording.sessions.front();
  EXPECT_EQ(count(session, EventKind::PushTakenBack), 1U);
  EXPECT_EQ(count(session, EventKind::ParticlesPutBack), 1U);
  EXPECT_EQ(session.samples.back().push.digest, scene::kSoftDigest);
  expect_same(session);
}

TEST_P(ReplayOfMarks, RefusesASampleThatCannotBe) {
  GetParam().stroke(recording, 0.0);
  RecordedSession session = recording.sessions.front();
  session.hand_m_per_m = session.hand_n_per_n = 1.0;
  GetParam().damage(session.particles->set);
  ASSERT_TRUE(save_session(session, folder.file("bad.afms")));
  const auto loaded = load_session(folder.file("bad.afms"));
  ASSERT_FALSE(loaded);
  EXPECT_THAT(loaded.error().message, HasSubstr(GetParam().named));
}

}  // namespace replay_marks_test
}  // namespace afm::servo
