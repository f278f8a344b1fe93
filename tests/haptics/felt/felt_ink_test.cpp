// SPDX-License-Identifier: Apache-2.0
// Ink under the hand: the pull of the liquid, the area that is covered, and what can be taken back.
// Invariant: no contact with ink gives a hand more energy than it took
#include "haptics/contact/felt_ink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "felt/marking_hand.h"
#include "haptics/device.h"
#include "scene/shared/tip_blocks.h"
#include "support/particles/ink_sample.h"

namespace afm::haptics {
namespace felt_ink_test {

using physics::EventKind;

constexpr double kNm = test::MarkingHand::kNm;
constexpr double kPullN = 4.0 * std::numbers::pi * 20e-9 * 0.0728;  // 4 pi R gamma: 18.3 nN

class WritingHand final : public test::MarkingHand {
 public:
  WritingHand() : MarkingHand(test::thiol_ink(), 300.0) {}

  // Lifts the tip, and waits until everything is published.
  void lift() {
    go(place_nm().x, place_nm().y, tears_nm() + 20.0, 20.0);
    wait(300);
  }

  double tears_nm() const { return scale().clear_z_m / kNm; }
  double covered_m2() const { return felt_.push().ink.covered_m2; }
  FeltInk& felt() { return felt_; }

 private:
  FeltMarks& marks() override { return felt_; }

  FeltInk felt_{particles(), scale()};
};

TEST(FeltInk, ShowsDotsAndPullInTheSizeOfAHand) {
  const WritingHand hand;
  const double dot_m = 2.0 * std::sqrt(1e5 * 0.216e-18 / std::numbers::pi);
  EXPECT_LE(hand.scale().hand_m_per_m, 0.010 / dot_m * (1.0 + 1e-12));
  EXPECT_GT(hand.scale().hand_m_per_m, 0.003 / dot_m);
  EXPECT_NEAR(hand.scale().hand_n_per_n * kPullN, std::min(1.0, 0.5 * force_cap_n(omni_like("hand"))), 1e-9);
}

TEST(FeltInk, TheLiquidHoldsTheTipUntilTheLeverPullsAsMuch) {
  WritingHand hand;
  EXPECT_FALSE(hand.go(0.0, 0.0, -20.0, 1000.0).near) << "it has never been over the sample";
  hand.lift();
  EXPECT_EQ(hand.felt().phase(), physics::Phase::Free);
  EXPECT_FALSE(hand.go(0.0, 0.0, 0.5, 1.0).near) << "nothing pulls before the touch";
  const double felt_n_per_m = 0.1 / hand.scale().softened_upwards;
  EXPECT_NEAR(hand.go(0.0, 0.0, -50.0, 1.0).push_n.z, felt_n_per_m * 50e-9, 1e-15);
  EXPECT_EQ(hand.count(EventKind::InkFlows), 1U);
  const ParticlePush held = hand.go(0.0, 0.0, hand.tears_nm() - 0.1, 1.0);
  EXPECT_NEAR(held.push_n.z, -kPullN, 0.01 * kPullN);
  EXPECT_EQ(held.push_n.x, 0.0);
  EXPECT_EQ(hand.felt().phase(), physics::Phase::Attached);
  const double stored_j = hand.felt().push().stored_j;
  EXPECT_FALSE(hand.at(0.0, 0.0, hand.tears_nm() + 0.1).near);
  EXPECT_EQ(hand.count(EventKind::LiquidTorn), 1U);
  EXPECT_NEAR(hand.felt().push().lost_j, stored_j, 1e-12 * stored_j);
  EXPECT_EQ(hand.felt().stored_j(), 0.0);
}

// N67, under a hand that presses and pulls.
TEST(FeltInk, CoversTheAreaOfTheFormulaWhateverTheLoad) {
  for (const double z_nm : {-60.0, 0.0, 60.0}) {
    WritingHand hand;
    hand.lift();
    hand.go(100.0, -50.0, 5.0, 2.0);
    hand.at(100.0, -50.0, 0.0);
    const double before_m2 = hand.covered_m2();
    hand.go(100.0, -50.0, z_nm, 1.0);
    hand.wait(2000 - static_cast<int>(std::abs(z_nm)));
    const double square_m2 = std::pow(hand.felt().surface().spacing().si, 2.0);
    EXPECT_NEAR(hand.covered_m2() - before_m2, 1e5 * 0.216e-18 * 2.0, 2.0 * square_m2) << z_nm;
  }
}

TEST(FeltInk, DrawsALineOfTheFormulasWidth) {
  WritingHand hand;
  hand.go(-400.0, 0.0, 300.0, 10.0);
  hand.lift();
  hand.go(-400.0, 0.0, 0.0, 20.0);
  hand.go(400.0, 0.0, 0.0, 0.2);  // 200 nm/s
  EXPECT_NEAR(hand.felt().push().ink.speed_m_per_s, 200e-9, 2e-9);
  const double width_m =
      hand.felt()
          .surface()
          .width({physics::Length(-400e-9), physics::Length(0.0)}, {physics::Length(400e-9), physics::Length(0.0)})
          .si;
  EXPECT_NEAR(width_m, 108e-9, 0.08 * 108e-9);
}

TEST(FeltInk, TakesStrokesBackTileByTile) {
  WritingHand hand;
  hand.lift();
  const std::uint64_t bare = hand.felt().sample().digest;
  EXPECT_EQ(bare, scene::kSoftDigest);
  EXPECT_FALSE(hand.felt().take_back());
  hand.lift();
  hand.go(0.0, 0.0, -10.0, 20.0);
  EXPECT_FALSE(hand.felt().take_back()) << "the tip writes";
  hand.wait(500);
  hand.lift();
  const std::uint64_t first = hand.felt().sample().digest;
  const double first_m2 = hand.covered_m2();
  EXPECT_NE(first, bare);
  hand.go(60.0, 20.0, -10.0, 20.0);
  hand.wait(900);
  hand.go(60.0, 20.0, 300.0, 200.0);  // lift before everything is published
  EXPECT_EQ(hand.felt().push().strokes, 2U);
  EXPECT_TRUE(hand.felt().take_back());
  hand.lift();
  EXPECT_EQ(hand.felt().sample().digest, first) << "what the first stroke covered is covered still";
  EXPECT_EQ(hand.covered_m2(), first_m2);
  EXPECT_TRUE(hand.felt().take_back());
  hand.lift();
  EXPECT_EQ(hand.felt().sample().digest, bare);
  hand.go(0.0, 0.0, -10.0, 20.0);
  hand.wait(100);
  hand.lift();
  EXPECT_TRUE(hand.felt().put_back());
  hand.lift();
  EXPECT_EQ(hand.felt().sample().digest, bare);
  EXPECT_FALSE(hand.felt().put_back());
}

TEST(FeltInk, GoesOnWhereAPredecessorLeftIt) {
  WritingHand hand, other;
  hand.lift();
  hand.go(0.0, 0.0, -10.0, 20.0);
  hand.wait(700);
  hand.lift();
  const std::vector<scene::MarkTile> tiles(hand.felt().tiles().begin(), hand.felt().tiles().end());
  other.felt().resume(tiles);
  other.lift();
  EXPECT_EQ(other.felt().sample().digest, hand.felt().sample().digest);
  for (WritingHand* each : {&hand, &other}) {
    each->go(30.0, 10.0, 300.0, 20.0);
    each->go(30.0, 10.0, -10.0, 20.0);
    each->go(200.0, 90.0, -10.0, 0.5);
    each->lift();
  }
  EXPECT_EQ(other.felt().sample().digest, hand.felt().sample().digest);
  EXPECT_THROW(other.felt().resume(std::span(tiles).first(3)), std::invalid_argument);
}

TEST(FeltInk, NothingIsFeltBeyondTheSquareOrAtAnImpossiblePlace) {
  WritingHand hand;
  hand.lift();
  EXPECT_TRUE(hand.go(0.0, 0.0, -10.0, 20.0).near);
  EXPECT_FALSE(hand.at(900.0, 0.0, -10.0).near);
  EXPECT_EQ(hand.felt().phase(), physics::Phase::WaitForLift);
  EXPECT_FALSE(hand.at(0.0, 0.0, -10.0).near) << "it has to be lifted first";
  hand.lift();
  EXPECT_TRUE(hand.go(0.0, 0.0, -10.0, 20.0).near);
  EXPECT_FALSE(hand.at(std::numeric_limits<double>::quiet_NaN(), 0.0, -10.0).near);
  EXPECT_FALSE(hand.at(0.0, 0.0, std::numeric_limits<double>::infinity()).near);
}

// The force is that of a spring, zero at the touch; the energy stored when the liquid tears is lost.
TEST(FeltInk, ClosedPathsGiveTheHandNoEnergy) {
  std::mt19937 random(36);
  std::uniform_real_distribution<double> place_nm(-300.0, 300.0), height_nm(-100.0, 350.0), step_nm(0.5, 20.0);
  std::size_t touches = 0;
  for (int path = 0; path < 50; ++path) {
    WritingHand hand;
    hand.lift();
    double work_j = 0.0, before_n = 0.0, z_nm = hand.tears_nm() + 20.0, x_nm = 0.0, y_nm = 0.0;
    const double start_nm = z_nm;
    for (int leg = 0; leg <= 6; ++leg) {
      const double to_x_nm = place_nm(random);
      const double to_y_nm = place_nm(random);
      const double drawn_nm = height_nm(random);
      const double each_nm = step_nm(random);
      const glm::dvec3 from{x_nm, y_nm, z_nm}, to{to_x_nm, to_y_nm, leg == 6 ? start_nm : drawn_nm};
      const int ticks = std::max(1, static_cast<int>(glm::length(to - from) / each_nm));
      for (int i = 1; i <= ticks; ++i) {
        const glm::dvec3 at = from + (to - from) * (static_cast<double>(i) / ticks);
        const double force_n = hand.at(at.x, at.y, at.z).push_n.z;
        work_j -= 0.5 * (force_n + before_n) * (at.z - z_nm) * kNm;  // work of the hand
        before_n = force_n;
        x_nm = at.x, y_nm = at.y, z_nm = at.z;
      }
    }
    EXPECT_GE(work_j, 0.0) << path;
    touches += hand.count(EventKind::InkFlows);
    const scene::TipPush push = hand.felt().push();
    EXPECT_GE(push.given_j, push.lost_j + push.stored_j);
  }
  EXPECT_GT(touches, 30U);
}

}  // namespace felt_ink_test
}  // namespace afm::haptics
