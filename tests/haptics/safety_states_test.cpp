// SPDX-License-Identifier: Apache-2.0
// Invariant: the governor takes exactly the transitions of its diagram
#include "haptics/safety_states.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace safety_states_test {

using namespace afm::haptics;
using afm::scene::FaultCode;
using afm::scene::RendererLink;
using afm::scene::ServoState;

using enum ServoState;

const char* name(ServoState state) {
  static constexpr std::array kNames = {"Disarmed", "Arming", "Running", "Fading", "Fault"};
  return kNames[static_cast<std::size_t>(state)];
}

// Every state that the servo can be in when a tick begins; what it remembers of an earlier fault differs from any that
// a tick could give.
constexpr FaultCode kEarlier{14};
std::vector<SafetyState> all_states() {
  return {{Disarmed, kEarlier, 0},         {Arming, FaultCode::None, 0},     {Running, FaultCode::None, 0},
          {Fading, kEarlier, kSlowFadeNs}, {Fading, kEarlier, kQuickFadeNs}, {Fault, kEarlier, 0}};
}

// Everything that a tick can find.
std::vector<SafetyConditions> all_conditions() {
  std::vector<SafetyConditions> all;
  for (const FaultCode cut : {FaultCode::None, FaultCode::DeviceError, FaultCode::NotFinite, FaultCode::StopPressed,
                              FaultCode::VelocityTrip}) {
    for (const RendererLink renderer : {RendererLink::Absent, RendererLink::Alive, RendererLink::Hung,
                                        RendererLink::Leaving, RendererLink::Died, RendererLink::Unseen}) {
      for (const auto& [edge, held] : {std::pair(false, false), std::pair(false, true), std::pair(true, true)}) {
        for (unsigned bits = 0; bits < 64; ++bits) {
          all.push_back({.cut = cut,
                         .renderer = renderer,
                         .turn_on_edge = edge,
                         .turn_on_held = held,
                         .interlock = (bits & 1U) != 0,
                         .dead_man = (bits & 2U) != 0,
                         .late = (bits & 4U) != 0,
                         .outside = (bits & 8U) != 0,
                         .hot = (bits & 16U) != 0,
                         .energy_exceeded = (bits & 32U) != 0});
        }
      }
    }
  }
  return all;
}

// What the manual promises, in its order: of the rows of a state the first that fits is taken, and where none fits
// nothing happens.
struct Row {
  std::set<ServoState> from;
  const char* when;
  bool (*fits)(const SafetyConditions&);
  ServoState to;
  FaultCode fault;
  std::int64_t fade_ns;
  int used = 0;
};

const std::set<ServoState> kAny = {Disarmed, Arming, Running, Fading, Fault};
const std::set<ServoState> kForce = {Arming, Running, Fading};

bool nothing_wrong(const SafetyConditions& f) {
  return f.cut == FaultCode::None && f.renderer == RendererLink::Alive && !f.late && !f.outside && !f.hot &&
         !f.energy_exceeded;
}

std::vector<Row> table() {
  return {
      {kAny, "device failed", [](const SafetyConditions& f) { return f.cut == FaultCode::DeviceError; }, Fault,
       FaultCode::DeviceError, 0},
      {kAny, "no number", [](const SafetyConditions& f) { return f.cut == FaultCode::NotFinite; }, Fault,
       FaultCode::NotFinite, 0},
      {kAny, "Stop", [](const SafetyConditions& f) { return f.cut == FaultCode::StopPressed; }, Fault,
       FaultCode::StopPressed, 0},
      {kForce, "too fast", [](const SafetyConditions& f) { return f.cut == FaultCode::VelocityTrip; }, Fault,
       FaultCode::VelocityTrip, 0},
      {{Disarmed},
       "Turn-On",
       [](const SafetyConditions& f) { return f.turn_on_edge && f.interlock && nothing_wrong(f); },
       Arming,
       FaultCode::None,
       0},
      {{Fault}, "Turn-On", [](const SafetyConditions& f) { return f.turn_on_edge; }, Disarmed, kEarlier, 0},
      {kForce, "late", [](const SafetyConditions& f) { return f.late; }, Fading, FaultCode::LateTick, kQuickFadeNs},
      {kForce, "energy", [](const SafetyConditions& f) { return f.energy_exceeded; }, Fading, FaultCode::EnergyExceeded,
       kQuickFadeNs},
      {kForce, "outside", [](const SafetyConditions& f) { return f.outside; }, Fading, FaultCode::OutOfWorkspace,
       kQuickFadeNs},
      {kForce, "renderer died", [](const SafetyConditions& f) { return f.renderer == RendererLink::Died; }, Fading,
       FaultCode::RendererDied, kQuickFadeNs},
      {kForce, "picture unseen", [](const SafetyConditions& f) { return f.renderer == RendererLink::Unseen; }, Fading,
       FaultCode::PictureUnseen, kQuickFadeNs},
      {kForce, "dead-man released", [](const SafetyConditions& f) { return f.dead_man && !f.turn_on_held; }, Fading,
       FaultCode::DeadManReleased, kQuickFadeNs},
      {{Arming, Running},
       "hot",
       [](const SafetyConditions& f) { return f.hot; },
       Fading,
       FaultCode::MotorsHot,
       kSlowFadeNs},
      {{Arming, Running},
       "renderer hung",
       [](const SafetyConditions& f) { return f.renderer == RendererLink::Hung; },
       Fading,
       FaultCode::RendererHung,
       kSlowFadeNs},
      {{Arming, Running},
       "renderer leaves",
       [](const SafetyConditions& f) { return f.renderer == RendererLink::Leaving; },
       Fading,
       FaultCode::None,
       kSlowFadeNs},
  };
}

SafetyState expected(std::vector<Row>& rows, const SafetyState& before, const SafetyConditions& conditions) {
  for (Row& row : rows) {
    if (row.from.count(before.state) == 0 || !row.fits(conditions)) continue;
    const bool as_urgent = before.state == Fading && row.to == Fading && before.fade_ns <= row.fade_ns;
    if (as_urgent) return before;
    ++row.used;
    return {row.to, row.fault, row.fade_ns};
  }
  return before;
}

TEST(SafetyStates, FollowTheTableForEveryStateAndEverythingThatATickCanFind) {
  std::vector<Row> rows = table();
  int looked = 0;
  for (const SafetyState& before : all_states()) {
    for (const SafetyConditions& conditions : all_conditions()) {
      const SafetyState wanted = expected(rows, before, conditions);
      const SafetyState got = after_conditions(before, conditions);
      ASSERT_EQ(got.state, wanted.state) << "from " << name(before.state) << " to " << name(got.state);
      ASSERT_EQ(got.fault, wanted.fault) << "from " << name(before.state) << " to " << name(got.state);
      ASSERT_EQ(got.fade_ns, wanted.fade_ns);
      ++looked;
    }
  }
  EXPECT_EQ(looked, 6 * 5 * 6 * 3 * 64);
  for (const Row& row : rows) EXPECT_GT(row.used, 0) << "never taken: " << row.when;
}

TEST(SafetyStates, TakeEveryEdgeOfTheDiagramAndNoOther) {
  std::set<std::pair<ServoState, ServoState>> taken;
  for (const SafetyState& before : all_states()) {
    for (const SafetyConditions& conditions : all_conditions())
      taken.emplace(before.state, after_conditions(before, conditions).state);
    for (const double gain : {0.0, 0.5, 1.0}) {
      for (const bool silent : {false, true}) taken.emplace(before.state, after_output(before, gain, silent).state);
    }
    taken.emplace(before.state, begin_fade(before, kQuickFadeNs, FaultCode::None).state);
  }
  for (const ServoState state : kAny) EXPECT_EQ(taken.erase({state, state}), 1U) << name(state) << " cannot stay";
  const std::set<std::pair<ServoState, ServoState>> diagram = {
      {Disarmed, Arming}, {Arming, Running}, {Arming, Fading}, {Running, Fading}, {Fading, Disarmed},
      {Disarmed, Fault},  {Arming, Fault},   {Running, Fault}, {Fading, Fault},   {Fault, Disarmed}};
  EXPECT_EQ(taken, diagram);
}

TEST(SafetyStates, LeaveArmingOnlyWithTheWholeGainAndFadingOnlyWithoutForce) {
  for (const SafetyState& before : all_states()) {
    for (const double gain : {0.0, 0.001, 0.999, 1.0}) {
      for (const bool silent : {false, true}) {
        ServoState wanted = before.state;
        if (before.state == Arming && gain == 1.0) wanted = Running;
        if (before.state == Fading && gain == 0.0 && silent) wanted = Disarmed;
        const SafetyState got = after_output(before, gain, silent);
        EXPECT_EQ(got.state, wanted);
        EXPECT_EQ(got.fault, before.fault);
      }
    }
  }
}

// Whatever happened before, there is no force without a press of the button in a tick without a fault.
TEST(SafetyStates, GiveNoForceWithoutAPress) {
  for (const SafetyState& before : all_states()) {
    if (before.armed()) continue;
    for (const SafetyConditions& conditions : all_conditions()) {
      if (!after_conditions(before, conditions).armed()) continue;
      EXPECT_TRUE(conditions.turn_on_edge && conditions.interlock && nothing_wrong(conditions));
    }
  }
}

TEST(SafetyStates, FadeForAChangeOfMaterialOnlyWhereThereIsAForce) {
  for (const SafetyState& before : all_states()) {
    const SafetyState got = begin_fade(before, kQuickFadeNs, FaultCode::None);
    EXPECT_EQ(got.state, before.armed() ? Fading : before.state);
    EXPECT_LE(got.fade_ns, kQuickFadeNs);
  }
}

}  // namespace safety_states_test
