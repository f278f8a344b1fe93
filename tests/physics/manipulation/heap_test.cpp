// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "physics/manipulation/pushed_particles.h"
#include "pushing.h"

// Many spheres pushed against one another.
namespace afm::physics {
namespace heap_test {

using test::base_at;
using test::drag;
using test::flank_tip;
using test::gold;

constexpr double kRadiusM = 25e-9, kDiameterM = 2.0 * kRadiusM;
constexpr Stiffness kContact{100.0};

PushSetup gold_setup() {
  ParticleSpecies species = gold();
  species.ageing = Time(0.1);
  species.tip_adhesion = SurfaceEnergy(0.02);
  return {flank_tip(Length(10e-9)), {Stiffness(10.0), Stiffness(1.0), kContact}, 0.3, {species}};
}

// Spheres on two fifths of a square, none over another.
std::vector<PlacedParticle> crowd(std::size_t count) {
  std::mt19937_64 random(3);
  const double half_side_m = 0.5 * std::sqrt(static_cast<double>(count) * 3.14159 * kRadiusM * kRadiusM / 0.4);
  std::uniform_real_distribution<double> place(-half_side_m, half_side_m);
  std::vector<PlacedParticle> placed;
  while (placed.size() < count) {
    const Sideways<Length> at{Length(place(random)), Length(place(random))};
    const bool free = std::none_of(placed.begin(), placed.end(), [&at](const PlacedParticle& other) {
      return magnitude(other.position - at).si < kDiameterM;
    });
    if (free) placed.push_back({0, at});
  }
  return placed;
}

// Thirty-seven that touch, six round each.
std::vector<PlacedParticle> hexagon() {
  std::vector<PlacedParticle> placed;
  for (int i = -3; i <= 3; ++i) {
    for (int j = -3; j <= 3; ++j) {
      if (std::abs(i + j) > 3) continue;
      placed.push_back({0, {Length((i + 0.5 * j) * kDiameterM), Length(j * kDiameterM * std::sqrt(0.75))}});
    }
  }
  return placed;
}

double deepest_overlap_m(const PushedParticles& particles) {
  double deepest_m = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      deepest_m = std::max(deepest_m, kDiameterM - magnitude(particles.position(i) - particles.position(j)).si);
    }
  }
  return deepest_m;
}

// A hand that crosses 200 spheres at 1 um/s meets heaps on most of its way.
TEST(Heap, IsFinishedInNearlyEveryTick) {
  PushedParticles particles(gold_setup(), crowd(200), base_at(-400e-9, 0.0, 5e-9));
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-400e-9, 400e-9);
  int ticks = 0;
  for (int line = 0; line < 12; ++line) {
    const double x_m = place(random);
    const LeverBase to = base_at(x_m, place(random), 5e-9);
    ticks += static_cast<int>(magnitude(to.position - particles.last().base.position).si / 1e-9);
    drag(particles, to, 1e-6, 1000.0);
  }
  ASSERT_GT(ticks, 3000);
  EXPECT_LT(static_cast<double>(particles.last().exhausted) / ticks, 0.03);
  EXPECT_GT(particles.last().lost.si, 0.0);
}

TEST(Heap, RestsWithoutOverlapsBeyondItsForces) {
  PushedParticles particles(gold_setup(), hexagon(), base_at(-215e-9, 3e-9, 5e-9));
  for (int push = 0; push < 10; ++push) {
    const LeverBase from = particles.last().base;
    drag(particles, base_at(from.position.x.si + 10e-9, 3e-9, 5e-9), 1e-6, 1000.0);
    for (int i = 0; i < 100; ++i) particles.move_to(particles.last().base, Time(1e-3));
    EXPECT_TRUE(particles.moved().empty()) << push;
    const Force carried = std::max(particles.last().normal, magnitude(particles.last().lateral));
    EXPECT_LT(deepest_overlap_m(particles), (carried / kContact).si + 1e-4 * kRadiusM) << push;
  }
}

// A replay begins where the tip is held over the places: nothing else may be left of what happened before.
TEST(Heap, LeavesNothingButItsPlacesOnceTheTipIsHeldOverIt) {
  const PushSetup setup = gold_setup();
  PushedParticles pushed(setup, hexagon(), base_at(-215e-9, 3e-9, 5e-9));
  for (int i = 0; i < 400 && pushed.last().exhausted == 0; ++i) {
    pushed.move_to(base_at(-215e-9 + 2e-9 * i, 3e-9, 5e-9), Time(1e-3));
  }
  ASSERT_GT(pushed.last().exhausted, 0U) << "the heap is at rest";
  std::vector<ParticlePlace> places;
  for (std::size_t i = 0; i < pushed.size(); ++i) places.push_back({pushed.position(i), pushed.turn(i)});
  const LeverBase over = base_at(-215e-9, 3e-9, 60e-9);
  pushed.hold_over(over);
  PushedParticles fresh(setup, hexagon(), over);
  fresh.put(places, over);
  const std::uint64_t before = pushed.last().exhausted;
  for (PushedParticles* particles : {&pushed, &fresh}) {
    drag(*particles, base_at(-215e-9, 3e-9, 5e-9), 1e-6, 1000.0);
    drag(*particles, base_at(-100e-9, 10e-9, 5e-9), 1e-6, 1000.0);
  }
  for (std::size_t i = 0; i < pushed.size(); ++i) EXPECT_EQ(pushed.position(i), fresh.position(i)) << i;
  EXPECT_EQ(pushed.last().lost, fresh.last().lost);
  EXPECT_EQ(pushed.last().exhausted - before, fresh.last().exhausted);
}

}  // namespace heap_test
}  // namespace afm::physics
