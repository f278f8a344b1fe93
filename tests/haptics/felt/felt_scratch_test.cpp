// SPDX-License-Identifier: Apache-2.0
// A soft sample under the hand: its force, its marks, and what a fast hand gets of it.
// Invariant: no contact with a soft sample gives a hand more energy than it took, however fast the hand moves
#include "haptics/contact/felt_scratch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "felt/marking_hand.h"
#include "haptics/device.h"
#include "haptics/safety.h"
#include "physics/manipulation/marking.h"
#include "scene/shared/tip_blocks.h"
#include "support/deep.h"
#include "support/particles/soft_sample.h"

namespace afm::haptics {
namespace felt_scratch_test {

using physics::EventKind;

constexpr double kTickS = test::MarkingHand::kTickS;
constexpr double kNm = test::MarkingHand::kNm;

class ScratchingHand final : public test::MarkingHand {
 public:
  explicit ScratchingHand(double held_j = 0.0)
      : MarkingHand(test::soft_pmma(), 40.0), felt_(particles(), scale(), kTickS, held_j) {}

  // Over the sample until all marks are published, and ready.
  void lift() {
    for (int i = 0; i < 300; ++i) at(place_nm().x, place_nm().y, 40.0);
  }

  FeltScratch& felt() { return felt_; }

 private:
  FeltMarks& marks() override { return felt_; }

  void check() override {
    const physics::ScratchTick& tick = felt_.last();
    EXPECT_GE((tick.given - tick.lost - tick.stored).si, -1e-12 * std::abs(tick.given.si) - 1e-30);
    EXPECT_FALSE(tick.lagging && felt_.push().rise_m == 0.0);
  }

  FeltScratch felt_;
};

TEST(FeltScratch, ShowsATipAndItsForceInTheSizeOfAHand) {
  const ScratchingHand hand;
  EXPECT_LE(hand.scale().hand_m_per_m, 0.010 / 40e-9 * (1.0 + 1e-12));
  EXPECT_GT(hand.scale().hand_m_per_m, 1e5);
  const double load_n = 0.5 * std::numbers::pi * 0.3e9 * 1e-16;  // a groove as wide as the radius
  EXPECT_LE(hand.scale().hand_n_per_n * load_n, 1.0 + 1e-12);
  EXPECT_GT(hand.scale().hand_n_per_n * load_n, 0.3);
  EXPECT_GT(hand.scale().softened_sideways, 1.0);
}

TEST(FeltScratch, WaitsUntilTheTipHasBeenOverTheSample) {
  ScratchingHand hand;
  EXPECT_FALSE(hand.go(0.0, 0.0, -30.0, 1000.0).near) << "it has never been over the sample";
  hand.lift();
  EXPECT_EQ(hand.felt().phase(), physics::Phase::Free);
  EXPECT_GT(hand.go(0.0, 0.0, -30.0, 0.5).push_n.z, 20e-9);
  hand.felt().lift();
  EXPECT_EQ(hand.felt().phase(), physics::Phase::WaitForLift);
  EXPECT_FALSE(hand.go(20.0, 0.0, -30.0, 0.3).near);
  hand.lift();
  EXPECT_TRUE(hand.go(20.0, 0.0, -30.0, 0.5).near);
  EXPECT_FALSE(hand.go(2000.0, 0.0, -30.0, 4000.0).near) << "there is no sample";
}

TEST(FeltScratch, FeelsGrooveAndLoadOfTheFormula) {
  ScratchingHand hand;
  hand.lift();
  hand.go(-100.0, 0.0, 40.0, 0.5);
  const ParticlePush pressed = hand.go(-100.0, 0.0, -50.0, 0.3);
  EXPECT_NEAR(pressed.push_n.z, 50e-9, 3e-9);
  EXPECT_NEAR(pressed.push_n.x, 0.0, 1e-9);
  EXPECT_EQ(hand.count(EventKind::SurfaceMarked), 1U);
  double lateral_n = 0.0, load_n = 0.0, depth_m = 0.0;
  int ticks = 0;
  for (double x_nm = -100.0; x_nm < 100.0; x_nm += 0.2, ++ticks) {
    const ParticlePush push = hand.go(x_nm, 0.0, -50.0, 0.3);
    if (x_nm < 0.0) continue;
    lateral_n -= push.push_n.x;
    load_n += push.push_n.z;
    depth_m -= hand.felt().last().apex.z.si;
  }
  lateral_n /= 0.5 * ticks, load_n /= 0.5 * ticks, depth_m /= 0.5 * ticks;
  const physics::SphereCone tip{physics::Length(20e-9), std::numbers::pi / 9.0};
  const physics::SoftSurface pmma = scene::soft_surface(test::soft_pmma().soft);
  const physics::Length depth = physics::groove_depth(tip, pmma, physics::Force(load_n));
  EXPECT_NEAR(depth_m, depth.si, 0.08 * depth.si) << "5 % less along the squares, 2 % in steps";
  const double force_n = (pmma.hardness * physics::groove_section(tip, depth)).si;
  EXPECT_NEAR(lateral_n, force_n, 0.12 * force_n);
  EXPECT_EQ(hand.count(EventKind::HandTooFast), 0U);
  EXPECT_EQ(hand.felt().push().rise_m, 0.0);
}

// The lever is raised as the hand gets faster, and sinks again once it is slow, for which earlier losses pay.
TEST(FeltScratch, AFastHandPressesLessAndThenNothing) {
  ScratchingHand hand;
  hand.lift();
  hand.go(-100.0, 0.0, 40.0, 0.5);
  hand.go(-100.0, 0.0, -50.0, 0.3);
  hand.go(-60.0, 0.0, -50.0, 0.3);
  const double held_j = hand.felt().held_j();
  EXPECT_GT(held_j, 1e-4);
  const double spacing_nm = 20.0 / 8.0;
  const ParticlePush half = hand.go(-40.0, 0.0, -50.0, 0.30 * spacing_nm);
  EXPECT_LT(half.push_n.z, 35e-9);
  EXPECT_GT(half.push_n.z, 10e-9);
  EXPECT_EQ(hand.count(EventKind::HandTooFast), 1U);
  const ParticlePush fast = hand.go(-10.0, 0.0, -50.0, 0.40 * spacing_nm);
  EXPECT_LT(glm::length(fast.push_n), 1e-15);
  EXPECT_EQ(hand.felt().last().state, physics::ScratchState::Free);
  for (int i = 0; i < 500; ++i) hand.at(-10.0, 0.0, -50.0);
  EXPECT_GT(hand.felt().last().load.si, 10e-9) << "the tank has paid";
  EXPECT_LT(hand.felt().held_j(), held_j);
}

TEST(FeltScratch, WithoutLossesBeforeALeverStaysRaised) {
  ScratchingHand hand;
  hand.lift();
  hand.go(-100.0, 0.0, 1.0, 0.5);
  hand.go(-60.0, 0.0, -50.0, 1.7);  // motion down while the hand is too fast
  for (int i = 0; i < 500; ++i) hand.at(-60.0, 0.0, -50.0);
  EXPECT_EQ(hand.felt().last().load.si, 0.0);
  EXPECT_GT(hand.felt().push().rise_m, 40e-9);
}

// Largest energy, in J, that slow and fast closed paths give to a hand after the governor.
double most_given_j(double held_j, int paths) {
  ScratchingHand hand(held_j);
  hand.lift();
  SafetyGovernor governor({.release_height_m = 0.001});
  GovernorInput input;
  input.time_ns = 1'000'000'000;
  input.renderer = RendererLink::Alive;
  const double hand_m_per_nm = hand.scale().hand_m_per_m * kNm;
  glm::dvec3 force_n(0.0);
  double raised_m = 0.0;
  const auto tick = [&](const glm::dvec3& at_nm, double& given_j) {
    const glm::dvec3 before_m = input.hand_position_m;
    const ParticlePush push = hand.at(at_nm.x, at_nm.y, at_nm.z);
    input.time_ns += 1'000'000;
    input.hand_position_m = hand_m_per_nm * at_nm;
    input.hand_height_m = input.hand_position_m.z;
    input.wanted_force_n = hand.scale().hand_n_per_n * push.push_n;
    input.phase = hand.felt().phase();
    input.law_energy = {.stored_j = hand.felt().stored_j(),
                        .stiffness_n_per_m = hand.felt().stiffness_n_per_m(),
                        .given_j = push.given_j};
    const glm::dvec3 now_n = governor.step(input).command.force_n();
    // a lever is raised before the hand's motion, which has the force after it
    const double rise_m = hand.felt().push().rise_m;
    const glm::dvec3 mean_n = rise_m > raised_m ? now_n : 0.5 * (force_n + now_n);
    given_j += glm::dot(mean_n, input.hand_position_m - before_m);
    raised_m = rise_m;
    force_n = now_n;
  };
  double most_j = -HUGE_VAL, ignored_j = 0.0;
  const glm::dvec3 over_nm(0.0, 0.0, 40.0);
  for (int i = 0; i < 200; ++i) tick(over_nm, ignored_j);
  input.turn_on = true;
  tick(over_nm, ignored_j);
  input.turn_on = false;
  for (int i = 0; i < 700; ++i) tick(over_nm, ignored_j);
  EXPECT_EQ(governor.state(), scene::ServoState::Running);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place_nm(-12.0, 12.0), shallow_nm(-4.0, 3.0), deeper_nm(0.0, 16.0),
      share(0.0, 1.0);
  const glm::dvec3 start_nm(0.0, 0.0, 12.0);
  for (double z_nm = 40.0; z_nm > start_nm.z; z_nm -= 0.5) tick({0.0, 0.0, z_nm}, ignored_j);
  const auto go = [&](const glm::dvec3& to_nm, double nm_per_tick, double& given_j) {
    const glm::dvec3 from_nm = hand.place_nm(), way_nm = to_nm - from_nm;
    const int ticks = std::max(1, static_cast<int>(std::ceil(glm::length(way_nm) / nm_per_tick)));
    for (int k = 1; k <= ticks; ++k) tick(from_nm + way_nm * (static_cast<double>(k) / ticks), given_j);
  };
  // in fine steps: where a contact ends within a step, half a force too much is counted
  constexpr double kFineNm = 0.03, kOverNm = 0.4, kFastNm = 1.4;
  for (int path = 0; path < paths; ++path) {
    double given_j = 0.0;
    glm::dvec3 at_nm(place_nm(random), 0.0, 12.0);
    at_nm.y = place_nm(random);
    go(at_nm, kOverNm, given_j);
    at_nm.z = shallow_nm(random);
    go(at_nm, kFineNm, given_j);
    for (int leg = 0; leg < 2; ++leg) {
      at_nm.x = place_nm(random);
      at_nm.y = place_nm(random);
      if (leg == 0) at_nm.z -= deeper_nm(random);
      go(at_nm, share(random) < 0.5 ? kFineNm : kFastNm, given_j);
      // a rest, in which a lever that was raised can sink
      for (int k = 0; k < 60; ++k) tick(at_nm, given_j);
    }
    at_nm.z = 12.0;
    go(at_nm, kFineNm, given_j);
    go(start_nm, kOverNm, given_j);
    most_j = std::max(most_j, given_j);
  }
  EXPECT_EQ(governor.state(), scene::ServoState::Running);
  return most_j;
}

TEST(FeltScratch, NoneOfAThousandClosedPathsGivesAHandEnergy) {
  EXPECT_LE(most_given_j(0.0, support::draws(1000)), 1e-9);
  // the bound is the tank's: with one that is never empty a lever that sinks pushes the hand
  EXPECT_GT(most_given_j(1e3, 60), 1e-4);
}

TEST(FeltScratch, TakesScratchAfterScratchBackBitForBit) {
  ScratchingHand hand;
  const auto scratch = [&](double y_nm) {
    hand.lift();
    hand.go(-80.0, y_nm, 40.0, 5.0);
    hand.go(-80.0, y_nm, -50.0, 0.5);
    hand.go(80.0, y_nm, -50.0, 0.5);
    hand.go(80.0, y_nm, 40.0, 2.0);
    hand.lift();
    return hand.felt().push().digest;
  };
  const std::uint64_t level = hand.felt().push().digest;
  const std::uint64_t one = scratch(-20.0), two = scratch(20.0);
  EXPECT_NE(one, level);
  EXPECT_NE(two, one);
  EXPECT_EQ(hand.felt().push().strokes, 2U);
  EXPECT_EQ(scene::digest_of(hand.felt().tiles()), two);
  ASSERT_TRUE(hand.felt().take_back());
  hand.lift();
  EXPECT_EQ(hand.felt().push().digest, one);
  EXPECT_EQ(scratch(20.0), two) << "the same scratch again";
  ASSERT_TRUE(hand.felt().put_back());
  hand.lift();
  EXPECT_EQ(hand.felt().push().digest, level);
  EXPECT_FALSE(hand.felt().put_back());
  EXPECT_FALSE(hand.felt().take_back());
}

TEST(FeltScratch, ASuccessorFeelsTheSameBits) {
  ScratchingHand hand, successor;
  hand.lift();
  hand.go(-80.0, 0.0, -50.0, 0.5);
  hand.go(80.0, 0.0, -50.0, 0.5);
  hand.go(80.0, 0.0, 40.0, 2.0);
  hand.lift();
  successor.felt().resume(hand.felt().tiles());
  successor.go(80.0, 0.0, 40.0, 1000.0);
  successor.lift();
  EXPECT_EQ(successor.felt().push().digest, hand.felt().push().digest);
  for (int i = 0; i < 400; ++i) {
    const double x_nm = 60.0 - 0.3 * i, z_nm = 40.0 - 0.3 * i;
    const ParticlePush a = hand.at(x_nm, 0.05 * i, z_nm), b = successor.at(x_nm, 0.05 * i, z_nm);
    ASSERT_EQ(a.push_n, b.push_n) << i;
    ASSERT_EQ(hand.felt().sample().digest, successor.felt().sample().digest) << i;
  }
  EXPECT_EQ(hand.count(EventKind::SurfaceMarked), 2U);
}

}  // namespace felt_scratch_test
}  // namespace afm::haptics
