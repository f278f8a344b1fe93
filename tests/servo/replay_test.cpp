// SPDX-License-Identifier: Apache-2.0
// Invariant: a session replays bit for bit, even if it was truncated
#include "servo/replay.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "servo/recorded_servo.h"
#include "support/paper_model.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_test {

using scene::FaultCode;
using scene::ServoState;
using scene::TipSample;
using testing::HasSubstr;

TEST(Replay, GivesEveryBitOfEveryMaterialAgainWhateverWasFeltBefore) {
  Recording recording;
  for (const int material : {test::kMica, test::kGold, test::kMica}) {
    recording.choose(material);
    recording.cycle();
    recording.cycle();
  }
  ASSERT_EQ(recording.sessions.size(), 3U);
  for (const RecordedSession& session : recording.sessions) {
    EXPECT_GT(strongest_n(session), 1.0);
    EXPECT_GE(session.events.size(), 4U);
    expect_same(session);
  }
}

TEST(Replay, TurnsTheSampleAgainAsTheWandTurnedIt) {
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  for (const double angle_rad : {0.1, 0.35, -0.2}) {
    recording.turn(angle_rad);
    recording.cycle();
  }
  ASSERT_EQ(recording.sessions.size(), 1U);
  RecordedSession session = recording.sessions.front();
  EXPECT_NE(session.samples.front().sample_normal, session.samples.back().sample_normal);
  expect_same(session);
  session.wall.clear();  // no wall left: only the frames can be the cause
  EXPECT_FALSE(replay(session)->identical());
}

TEST(Replay, ComparesTheRequestedPart) {
  Recording recording;
  recording.choose(test::kGold);
  recording.cycle();
  RecordedSession session = recording.sessions.front();
  const std::size_t wrong = session.samples.size() / 2;
  session.samples[wrong].hand_force_n += 1e-12;
  const double wrong_s = session.seconds_since_start(session.samples[wrong].time_ns);
  const Replay whole = replay(session).value();
  EXPECT_EQ(whole.different_ticks, 1U);
  const Replay before = replay(session, {.to_s = wrong_s - 0.01}).value();
  const Replay after = replay(session, {.from_s = wrong_s + 0.01}).value();
  EXPECT_TRUE(before.identical());
  EXPECT_TRUE(after.identical());
  EXPECT_EQ(before.events + after.events, session.events.size());
  EXPECT_LT(before.ticks + after.ticks, whole.ticks);
  EXPECT_FALSE(replay(session, {.from_s = wrong_s - 0.01, .to_s = wrong_s + 0.01})->identical());
}

// Recorded with g++ 12 on x86-64 (tests/formats/README.md): the same bits from every later version.
TEST(Replay, OfASessionOfAnEarlierVersionIsTheSameBitForBit) {
  for (const char* const file : {"0.1.0/session-gold.afms", "0.2.0/session-mica.afms"}) {
    SCOPED_TRACE(file);
    const auto session = load_session(support::source(std::string("tests/formats/") + file));
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_GT(strongest_n(*session), 0.5);
    expect_same(*session);
  }
}

TEST(Replay, GivesTheNoiseOfALeverAgain) {
  scene::SharedModel model = test::paper_model();
  scene::SharedContact& mica = model.materials[test::kMica];
  mica.law = physics::Law::Dmt;
  mica.contact.reduced_modulus = physics::Pressure(51.5e9);
  mica.dynamic = 1;
  mica.lever = {physics::Frequency(12e3), 2.5, physics::Temperature(298.0)};
  Recording recording(model);
  recording.choose(test::kMica);
  recording.cycle();
  recording.choose(test::kGold);
  recording.cycle();
  recording.choose(test::kMica);
  recording.cycle();
  ASSERT_EQ(recording.sessions.size(), 3U);
  EXPECT_GT(strongest_n(recording.sessions[2]), 0.3);
  expect_same(recording.sessions[0]);
  expect_same(recording.sessions[2]);
}

TEST(Replay, GivesFaultsHangsAndLateTicksAgain) {
  Recording recording;
  recording.choose(test::kGold);
  recording.cycle();

  recording.arm();
  recording.aim(0.020, 0.5);
  recording.run(400);
  recording.heartbeats = false;  // beginning of a hang of the picture, which recovers later
  recording.run(700);
  EXPECT_EQ(recording.state().fault, FaultCode::RendererHung);
  recording.heartbeats = true;
  recording.run(100);

  recording.arm();
  recording.now_ns += 60'000'000;
  recording.run(200);
  EXPECT_EQ(recording.state().fault, FaultCode::LateTick);

  for (bool FaultyDevice::* member : {&FaultyDevice::healthy, &FaultyDevice::lost}) {
    recording.arm();
    recording.aim(0.010, 0.3);
    recording.run(400);
    std::exchange(recording.device.*member, !(recording.device.*member));
    recording.run(50);
    EXPECT_EQ(recording.state().servo_state, ServoState::Fault);
    recording.device.*member = !(recording.device.*member);
    recording.aim(0.062, 0.3, true);  // acknowledgement of the fault
    recording.run(500);
  }
  recording.arm();
  recording.aim(0.010, 0.3);
  recording.run(400);
  recording.stop = true;
  recording.run(250);
  EXPECT_EQ(recording.state().fault, FaultCode::StopPressed);
  recording.stop = false;
  recording.run(50);
  recording.aim(0.062, 0.3, true);
  recording.run(500);
  // a headset is taken off, whose runtime then hangs
  recording.arm();
  recording.aim(0.010, 0.3);
  recording.run(400);
  recording.unseen = true;
  recording.run(300);
  EXPECT_EQ(recording.state().fault, FaultCode::PictureUnseen);
  recording.heartbeats = false;
  recording.run(400);
  recording.heartbeats = true;
  recording.run(30);
  recording.unseen = false;
  recording.run(50);
  recording.aim(0.062, 0.3);
  recording.run(500);
  // a material that is chosen in a fault
  recording.device.healthy = false;
  recording.run(10);
  recording.choose(test::kMica);
  recording.run(10);
  recording.device.healthy = true;
  recording.run(200);
  recording.aim(0.062, 0.1, true);
  recording.run(200);
  recording.cycle();

  ASSERT_EQ(recording.sessions.size(), 2U);
  for (const RecordedSession& session : recording.sessions) expect_same(session);
}

TEST(Replay, ReproducesAForceThatTheWallRemoved) {
  Recording recording;
  recording.choose(test::kGold);
  recording.cycle();
  recording.arm();
  recording.release(test::kGold);  // release at the top
  recording.run(300);
  recording.arm();
  recording.aim(-0.010, 0.7);
  recording.run(1200);
  ASSERT_EQ(recording.state().phase, physics::Phase::Attached);
  recording.release(test::kGold);  // in contact
  recording.run(300);
  EXPECT_EQ(recording.state().servo_state, scene::ServoState::Disarmed);
  recording.cycle();
  ASSERT_EQ(recording.sessions.size(), 1U);
  expect_same(recording.sessions[0]);
}

TEST(Replay, OfASessionThatBeginsInAFaultBeginsInIt) {
  const auto recording = std::make_unique<Recording>();
  recording->choose(test::kMica);
  recording->run(50);
  recording->device.healthy = false;
  recording->run(20);
  recording->device.healthy = true;  // recovery that does not end a fault
  recording->choose(test::kGold);
  recording->run(100);
  ASSERT_EQ(recording->sessions.size(), 2U);
  const RecordedSession& session = recording->sessions.back();
  ASSERT_EQ(session.samples.front().servo_state, scene::ServoState::Fault);
  expect_same(session);
}

TEST(Replay, GivesForcesThatWerePutDownForHotMotorsAgain) {
  Recording recording;
  recording.choose(test::kMica);
  recording.arm();
  recording.aim(-0.030, 0.5);  // place that exceeds the motors' continuous force
  recording.run(60'000);
  EXPECT_LT(recording.state().safety.thermal_gain, 1.0);
  recording.aim(0.065, 0.7);
  recording.run(1500);
  recording.choose(test::kGold);
  recording.cycle();
  ASSERT_EQ(recording.sessions.size(), 2U);
  for (const RecordedSession& session : recording.sessions) expect_same(session);
}

TEST(Replay, FindsOneBitThatIsNotTheSame) {
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  RecordedSession session = recording.sessions.front();
  double& force_n = session.samples[2000].hand_force_n;
  force_n = std::nextafter(force_n, 1.0);
  const auto one_tick = replay(session);
  ASSERT_TRUE(one_tick);
  EXPECT_FALSE(one_tick->identical());
  EXPECT_EQ(one_tick->different_ticks, 1U);
  EXPECT_EQ(one_tick->first->index, 2000U);
  EXPECT_EQ(one_tick->first->quantity, "hand_force_N");

  session = recording.sessions.front();
  session.events.pop_back();
  EXPECT_EQ(replay(session)->first_event->quantity, "count");
}

// Offsets of the numbers in a record that the servo computes.
template <class Record>
std::vector<std::pair<std::string, std::ptrdiff_t>> results_of(const Record& record) {
  std::vector<std::pair<std::string, std::ptrdiff_t>> results;
  const auto* begin = reinterpret_cast<const std::byte*>(&record);
  const auto add = [&](const char* name, const auto& value) {
    results.emplace_back(name, reinterpret_cast<const std::byte*>(&value) - begin);
  };
  for_each_result(
      [&]<class Value>(const char* name, const Value& value) {
        if constexpr (scene::Described<Value>) {
          for_each_leaf(add, value);
        } else {
          add(name, value);
        }
      },
      record);
  return results;
}

template <class Record>
void flip_bit(Record& record, std::ptrdiff_t offset) {
  reinterpret_cast<std::byte*>(&record)[offset] ^= std::byte{1};
}

TEST(Replay, ComparesEveryNumberThatTheServoComputed) {
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  const RecordedSession original = recording.sessions.front();
  std::vector<std::string> quantities;
  for (const auto& [name, offset] : results_of(original.samples[2000])) {
    RecordedSession session = original;
    flip_bit(session.samples[2000], offset);
    EXPECT_EQ(replay(session, {.from_s = 2.0})->first.value_or(Difference{}).quantity, name);
    quantities.push_back(name);
  }
  for (const auto& [name, offset] : results_of(original.events[1])) {
    RecordedSession session = original;
    flip_bit(session.events[1], offset);
    EXPECT_EQ(replay(session)->first_event.value_or(Difference{}).quantity, name);
    quantities.push_back(name);
  }
  EXPECT_THAT(quantities,
              testing::ElementsAre("z_m", "force_N", "tip_height_m", "deflection_m", "sample_deformation_m",
                                   "hand_height_m", "hand_force_N", "servo_state", "phase", "tip_x_m", "tip_y_m",
                                   "surface_height_m", "lateral_x_N", "lateral_y_N", "particle_digest", "push_x_N",
                                   "push_y_N", "push_lift_N", "push_normal_N", "pushed_particle", "push_state",
                                   "amplitude_m", "phase_rad", "guide_x_N", "guide_y_N", "drift_since_ns", "met",
                                   "kind", "time_ns", "z_m", "force_before_N", "force_after_N"));
}

TEST(Replay, IsTheSameFromAFile) {
  const support::ScratchFolder folder;
  Recording recording;
  recording.choose(test::kMica);
  recording.cycle();
  ASSERT_TRUE(save_session(recording.sessions.front(), folder.file("s.afms")));
  const auto loaded = load_session(folder.file("s.afms"));
  ASSERT_TRUE(loaded) << loaded.error().message;
  expect_same(*loaded);
}

}  // namespace replay_test
}  // namespace afm::servo
