// SPDX-License-Identifier: Apache-2.0
// The bars of selection (design, section 6; research, powerwall.md, section 4.4): a simulated user whose hand jitters
// by 0.5 degrees RMS and trembles at 8 to 12 Hz chooses among three swatches 3 degrees apart from 2.5 m.
// Invariant: a simulated hand with tremor selects the wrong target in at most one of a hundred attempts
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "input/selection.h"

namespace afm::input {
namespace simulated_user_test {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDistanceM = 2.5;
constexpr double kSpacingRad = 3.0 * kDegree;
constexpr double kJitterRad = 0.5 * kDegree;
constexpr double kTremorRad = 0.15 * kDegree;
constexpr double kFrameS = 1.0 / 60.0;
constexpr glm::dvec3 kHand(0.3, 1.1, 0.0);
constexpr glm::dvec3 kEye(0.0, 1.65, 0.1);

class User {
 public:
  explicit User(unsigned seed) : random_(seed) {
    for (const int i : {-1, 0, 1}) {
      targets_.push_back({kHand + kDistanceM * direction(kSpacingRad * i, 0.0), kDistanceM * std::sin(1.0 * kDegree)});
    }
    tremor_hz_ = std::uniform_real_distribution<double>(8.0, 12.0)(random_);
  }

  const std::vector<Target>& targets() const { return targets_; }

  // The wand of one frame later, aimed `aim` targets from the middle one.
  WandState frame(double aim, bool pressed) {
    time_s_ += kFrameS;
    const double phase = 2.0 * std::numbers::pi * tremor_hz_ * time_s_;
    const double yaw = kSpacingRad * aim + kJitterRad * normal_(random_) + kTremorRad * std::sin(phase);
    const double pitch = kJitterRad * normal_(random_) + kTremorRad * std::cos(1.13 * phase);
    WandState wand;
    wand.position_m = kHand;
    wand.room_from_wand = glm::angleAxis(-yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(pitch, glm::dvec3(1, 0, 0));
    wand.orientation_valid = true;
    if (pressed) wand.buttons = bit(WandButton::Select);
    return wand;
  }

 private:
  static glm::dvec3 direction(double yaw, double pitch) {
    return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::vector<Target> targets_;
  double tremor_hz_ = 0.0;
  double time_s_ = 0.0;
};

TEST(SimulatedUser, ChoosesWronglyAtMostOnceInAHundredTimes) {
  User user(20261121);
  Selector selector;
  std::mt19937 random(7);
  int wrong = 0;
  int from = 1;
  constexpr int kChoices = 3000;
  for (int choice = 0; choice < kChoices; ++choice) {
    const int to = std::uniform_int_distribution<int>(0, 2)(random);
    std::optional<std::size_t> chosen;
    // a third of a second on the way, as long at rest, then the press
    for (int frame = 0; frame < 42; ++frame) {
      const double way = std::min(1.0, frame / 20.0);
      const double smooth = way * way * (3.0 - 2.0 * way);
      const double aim = from - 1 + smooth * (to - from);
      const Selector::Result result = selector.update(user.frame(aim, frame == 40), kEye, user.targets());
      if (result.chosen) chosen = result.chosen;
    }
    if (chosen != static_cast<std::size_t>(to)) ++wrong;
    from = to;
  }
  EXPECT_LE(wrong, kChoices / 100);
}

TEST(SimulatedUser, HoversOneTargetWhileHoldingStillWithAtMostAFlipInTenSeconds) {
  constexpr int kSeconds = 600;
  for (const int target : {0, 1, 2}) {
    User user(static_cast<unsigned>(99 + target));
    Selector selector;
    std::optional<std::size_t> hovered;
    int flips = 0;
    for (int frame = 0; frame < kSeconds * 60; ++frame) {
      const auto now = selector.update(user.frame(target - 1, false), kEye, user.targets()).hovered;
      if (frame > 0 && now != hovered) ++flips;
      hovered = now;
    }
    EXPECT_LE(flips, kSeconds / 10) << "target " << target;
  }
}

TEST(SimulatedUser, SeesAHoverInTheFrameInWhichTheRayArrives) {
  User user(3);
  Selector selector;
  WandState wand = user.frame(0.0, false);
  for (const std::size_t target : {0U, 2U, 1U}) {
    wand.room_from_wand = glm::angleAxis(kSpacingRad * (1.0 - static_cast<double>(target)), glm::dvec3(0, 1, 0));
    EXPECT_EQ(selector.update(wand, kEye, user.targets()).hovered, target);
  }
}

}  // namespace simulated_user_test
}  // namespace afm::input
