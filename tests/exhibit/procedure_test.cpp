// SPDX-License-Identifier: Apache-2.0
// Invariant: an instruction stays for at least 3 s unless the force changes or is off; every cycle ends with its line
#include "exhibit/words/procedure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace afm::exhibit {
namespace procedure_test {

using State = scene::ServoState;
using physics::Phase;

constexpr std::int64_t kFrameNs = 16'000'000;

struct Shown {
  Hint hint;
  std::int64_t ns;
};

class ProcedureTest : public ::testing::Test {
 protected:
  void frame(State state, Phase phase, double z_m) {
    scene::TipState tip;
    tip.material = 0;
    tip.servo_state = state;
    tip.phase = phase;
    tip.tip.z_m = z_m;
    tip.active.scale.hand_m_per_m = 0.05 / kReleaseM;
    tip.active.release_z_m = kReleaseM;
    now_ns_ += kFrameNs;
    const Hint hint = procedure_.update(tip, progress_, now_ns_);
    if (shown_.empty() || shown_.back().hint != hint) shown_.push_back({hint, 0});
    shown_.back().ns += kFrameNs;
  }
  void stay(State state, Phase phase, double z_m, double seconds) {
    for (double s = 0; s < seconds; s += 1e-9 * kFrameNs) frame(state, phase, z_m);
  }
  // Down to a push and up again, with a trembling hand.
  void cycle(double seconds) {
    const int frames = static_cast<int>(seconds / (1e-9 * kFrameNs));
    bool attached = false;
    progress_.pressed = false;
    for (int i = 0; i <= frames; ++i) {
      const double z_m = kReleaseM * (0.5 + 0.9 * std::cos(6.283185 * i / frames));
      const bool was_attached = attached;
      attached = attached ? z_m < kReleaseM : z_m < 0.2 * kReleaseM;
      progress_.pressed = attached && (progress_.pressed || z_m <= 0.0);
      progress_.cycles += was_attached && !attached ? 1 : 0;
      progress_.ascending = (2 * i > frames) != (i % 5 == 0);
      frame(State::Running, attached ? Phase::Attached : Phase::Free, z_m);
    }
  }

  static constexpr double kReleaseM = 14e-9;
  Procedure procedure_;
  CycleProgress progress_;
  std::int64_t now_ns_ = 0;
  std::vector<Shown> shown_;
};

TEST_F(ProcedureTest, EveryHintCanBeReadAndTheRewardIsNeverMissed) {
  for (const double seconds : {0.5, 1.0, 2.7, 6.0, 20.0, 60.0}) {
    procedure_ = {};
    progress_ = {};
    shown_.clear();
    for (int i = 0; i < 3; ++i) {
      cycle(seconds);
      stay(State::Running, Phase::Free, 1.4 * kReleaseM, 20.0);
    }
    int rewards = 0;
    for (std::size_t i = 0; i + 1 < shown_.size(); ++i) {
      EXPECT_GE(shown_[i].ns, Procedure::kReadableNs) << seconds << " s, hint " << i;
      rewards += shown_[i].hint == Hint::LetGo ? 1 : 0;
    }
    rewards += shown_.back().hint == Hint::LetGo ? 1 : 0;
    EXPECT_EQ(rewards, 3) << seconds;
  }
}

TEST_F(ProcedureTest, TheOrderIsThatOfTheProcedure) {
  cycle(40.0);
  const std::vector<Hint> order{Hint::MoveDown, Hint::PressOn, Hint::Pressed, Hint::MoveUp, Hint::LetGo};
  ASSERT_GE(shown_.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(shown_[i].hint, order[i]) << i;
}

// Down until the sample has the whole swing, without a repulsive state, and up again, as with a small free amplitude.
TEST_F(ProcedureTest, ALeverThatTapsGivesItsSwingAndTakesItBack) {
  for (const double seconds : {2.0, 30.0}) {
    procedure_ = {};
    progress_ = {};
    shown_.clear();
    const auto frames = static_cast<int>(seconds / (1e-9 * kFrameNs));
    for (int i = 0; i <= frames; ++i) {
      const double way = 2.0 * i / frames;
      progress_.swing_share = std::min(1.0, 1.1 * std::abs(1.0 - way));
      progress_.ascending = way > 1.0;
      frame(State::Running, Phase::Free, 1.4 * kReleaseM * std::abs(1.0 - way));
    }
    stay(State::Running, Phase::Free, 1.4 * kReleaseM, 20.0);
    std::vector<Hint> hints;
    for (const Shown& shown : shown_) hints.push_back(shown.hint);
    EXPECT_EQ(std::count(hints.begin(), hints.end(), Hint::SwingsFree), 1) << seconds;
    EXPECT_EQ(hints.front(), Hint::TakeSwing) << seconds;
    if (seconds > 10.0) {
      EXPECT_EQ(hints, (std::vector<Hint>{Hint::TakeSwing, Hint::GiveSwing, Hint::SwingsFree})) << seconds;
    }
  }
}

TEST_F(ProcedureTest, WhatHappensToTheForceIsSaidAtOnce) {
  stay(State::Disarmed, Phase::Free, 1.4 * kReleaseM, 1.0);
  EXPECT_EQ(shown_.back().hint, Hint::TurnOn);
  frame(State::Arming, Phase::Free, 1.4 * kReleaseM);
  EXPECT_EQ(shown_.back().hint, Hint::ComingOn);
  frame(State::Running, Phase::Free, 1.4 * kReleaseM);
  EXPECT_EQ(shown_.back().hint, Hint::MoveDown);
  frame(State::Fading, Phase::Free, 1.4 * kReleaseM);
  EXPECT_EQ(shown_.back().hint, Hint::GoingOff);
  frame(State::Fault, Phase::WaitForLift, 0.5 * kReleaseM);
  EXPECT_EQ(shown_.back().hint, Hint::PressToGoOn);
  frame(State::Disarmed, Phase::WaitForLift, 0.5 * kReleaseM);
  EXPECT_EQ(shown_.back().hint, Hint::Lift);
}

TEST_F(ProcedureTest, AForceThatCameBackHasNotLetGoYet) {
  cycle(6.0);
  stay(State::Running, Phase::Free, 1.4 * kReleaseM, 5.0);
  frame(State::Fault, Phase::Free, 1.4 * kReleaseM);
  progress_.ascending = true;
  stay(State::Running, Phase::Free, 1.4 * kReleaseM, 1.0);
  EXPECT_EQ(shown_.back().hint, Hint::MoveDown);
}

}  // namespace procedure_test
}  // namespace afm::exhibit
