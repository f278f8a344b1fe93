// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/curve_player.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace afm::exhibit {
namespace curve_player_test {

std::shared_ptr<const physics::ForceCurve> curve_of(std::size_t points) {
  auto curve = std::make_shared<physics::ForceCurve>();
  for (std::size_t i = 0; i < points; ++i) {
    physics::CurveSample sample;
    sample.z = physics::Length(1e-9 * static_cast<double>(2 * i < points ? points - 2 * i : 2 * i - points));
    sample.branch = 2 * i < points ? physics::Branch::Approach : physics::Branch::Retract;
    curve->samples.push_back(sample);
  }
  return curve;
}

TEST(CurvePlayer, MovesTheTipAlongTheCurveInItsTime) {
  CurvePlayer player;
  EXPECT_FALSE(player.playing());
  const auto curve = curve_of(1000);
  player.begin(curve);
  EXPECT_EQ(player.tip().z_m, curve->samples.front().z.si);
  player.advance(0.5 * CurvePlayer::kSeconds);
  EXPECT_TRUE(player.playing());
  EXPECT_EQ(player.drawn().points().size(), 500U);
  EXPECT_FALSE(player.retracting());
  player.advance(0.25 * CurvePlayer::kSeconds);
  EXPECT_TRUE(player.retracting());
  player.advance(CurvePlayer::kSeconds);
  EXPECT_FALSE(player.playing());
  EXPECT_EQ(player.tip().z_m, curve->samples.back().z.si);
}

TEST(CurvePlayer, DrawsALongCurveWithFewPointsAndEveryJump) {
  auto curve = std::make_shared<physics::ForceCurve>(*curve_of(100'000));
  curve->samples[12'345].event = physics::EventKind::JumpToContact;
  CurvePlayer player;
  player.begin(curve);
  player.advance(CurvePlayer::kSeconds);
  EXPECT_LE(player.drawn().points().size(), 2003U);
  const double jump_nm = curve->samples[12'345].z.si * 1e9;
  bool drawn = false;
  for (const auto& [z_nm, force_nn] : player.drawn().points()) drawn = drawn || std::abs(z_nm - jump_nm) < 1e-9;
  EXPECT_TRUE(drawn);
}

}  // namespace curve_player_test
}  // namespace afm::exhibit
