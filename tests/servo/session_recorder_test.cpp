// SPDX-License-Identifier: Apache-2.0
#include "servo/session_recorder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "servo/tip_stream.h"

namespace afm::servo {
namespace session_recorder_test {

using physics::Phase;
using scene::ServoState;
using scene::TipSample;
using scene::TipState;

constexpr double kRelease_m = 20e-9;

TipState state() {
  TipState tip;
  tip.material = 1;
  tip.active.release_z_m = kRelease_m;
  return tip;
}

TipSample sample(Phase phase, double z_m) {
  TipSample s;
  s.material = 1;
  s.servo_state = ServoState::Fault;
  s.phase = phase;
  s.tip.z_m = z_m;
  return s;
}

// A demonstration that a late tick released twice did not replay: its session began in the tick that dropped the force,
// in which the tip was free below Z_joc. A servo that starts there waits for the tip to be lifted.
TEST(SessionRecorder, BeginsWhereThePhaseFollowsFromThePlace) {
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, 0.5 * kRelease_m), state(), false));
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, kRelease_m), state(), false));
  EXPECT_TRUE(can_begin_with(sample(Phase::Free, 1.1 * kRelease_m), state(), false));
  EXPECT_TRUE(can_begin_with(sample(Phase::WaitForLift, 0.5 * kRelease_m), state(), false));
  EXPECT_FALSE(can_begin_with(sample(Phase::Attached, 0.5 * kRelease_m), state(), false));
}

TEST(SessionRecorder, BeginsWithALeverThatSwingsOnlyBeforeItIsLifted) {
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, 1.1 * kRelease_m), state(), true));
  EXPECT_TRUE(can_begin_with(sample(Phase::WaitForLift, 0.5 * kRelease_m), state(), true));
}

TEST(SessionRecorder, BeginsWithoutForceAlone) {
  TipSample pulled = sample(Phase::WaitForLift, 0.0);
  pulled.hand_force_n = 0.1;
  EXPECT_FALSE(can_begin_with(pulled, state(), false));
  TipSample running = sample(Phase::WaitForLift, 0.0);
  running.servo_state = ServoState::Running;
  EXPECT_FALSE(can_begin_with(running, state(), false));
}

// Z_joc is known only for the contact of the newest state.
TEST(SessionRecorder, WaitsForTheStateOfTheSampleItIsGiven) {
  TipState other = state();
  other.material = 2;
  EXPECT_FALSE(can_begin_with(sample(Phase::Free, 1.1 * kRelease_m), other, false));
}

TEST(SessionRecorder, KeepsNothingOfTheTimeBeforeASession) {
  SessionRecorder recorder;
  recorder.add(WallFrame{.time_ns = 1});
  recorder.add(scene::TipEvent{.time_ns = 1});
  EXPECT_TRUE(recorder.session().wall.empty());
  EXPECT_TRUE(recorder.session().events.empty());
}

// Order of a stream of these updates: "s" and "e" with their times.
std::string order_of(const std::vector<ServoClient::Update>& updates) {
  TipStream stream;
  std::string order;
  for (const auto& update : updates) {
    stream.consume(
        update, [&](const TipSample& s) { order += "s" + std::to_string(s.time_ns) + " "; },
        [&](const scene::TipEvent& e) { order += "e" + std::to_string(e.time_ns) + " "; });
  }
  return order;
}

TipSample at(std::int64_t time_ns, std::int32_t material = 1) {
  TipSample s;
  s.time_ns = time_ns;
  s.material = material;
  return s;
}

TEST(TipStream, GivesAnEventJustBeforeTheSampleAtOrAfterIt) {
  const auto event = [](std::int64_t time_ns, std::int32_t material = 1) {
    scene::TipEvent of;
    of.time_ns = time_ns;
    of.material = material;
    return of;
  };
  ServoClient::Update both;
  both.samples = {at(1), at(2), at(3)};
  both.events = {event(2), event(3)};
  EXPECT_EQ(order_of({both}), "s1 e2 s2 e3 s3 ");

  // an event that must wait for the sample of its tick
  ServoClient::Update early;
  early.samples = {at(1)};
  early.events = {event(3)};
  ServoClient::Update late;
  late.samples = {at(2), at(3)};
  EXPECT_EQ(order_of({early, late}), "s1 s2 e3 s3 ");
  EXPECT_EQ(order_of({early, {}, late}), "s1 s2 e3 s3 ");

  // a sample without a material
  ServoClient::Update none;
  none.samples = {at(1, -1), at(2)};
  none.events = {event(1, -1), event(2)};
  EXPECT_EQ(order_of({none}), "e2 s2 ");
}

}  // namespace session_recorder_test
}  // namespace afm::servo
