// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
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
using test::constant;
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
  const auto most_overlap_m = [&particles] {
    const Force carried = std::max(particles.last().normal, magnitude(particles.last().lateral));
    return (carried / kContact).si + 1e-4 * kRadiusM;
  };
  int at_once = 0;
  for (int push = 0; push < 10; ++push) {
    const LeverBase from = particles.last().base;
    drag(particles, base_at(from.position.x.si + 10e-9, 3e-9, 5e-9), 1e-6, 1000.0);
    for (int i = 0; i < 4; ++i) particles.move_to(particles.last().base, Time(1e-3));
    const std::uint64_t before = particles.last().exhausted;
    particles.move_to(particles.last().base, Time(1e-3));
    if (particles.last().exhausted == before) {  // rest within five ticks, unless the budget has ended
      EXPECT_LT(deepest_overlap_m(particles), most_overlap_m()) << push;
      ++at_once;
    }
    for (int i = 0; i < 95; ++i) particles.move_to(particles.last().base, Time(1e-3));
    EXPECT_TRUE(particles.moved().empty()) << push;
    EXPECT_LT(deepest_overlap_m(particles), most_overlap_m()) << push;
  }
  EXPECT_GE(at_once, 5);
}

// A replay begins with the tip held above the places: no other trace of earlier events may remain.
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

// Bits of all places after a path, added up with their numbers: the same from every compiler (GCC in the release, Clang
// under the sanitizers), since products and sums are never fused.
std::uint64_t digest_of(const PushedParticles& particles) {
  std::uint64_t digest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Sideways<Length> at = particles.position(i);
    for (const double value : {at.x.si, at.y.si, particles.turn(i).w, particles.turn(i).z}) {
      digest = 1099511628211U * (digest ^ std::bit_cast<std::uint64_t>(value));  // FNV-1a, by whole numbers
    }
  }
  return digest;
}

TEST(Heap, HasTheSameDigestFromEveryCompiler) {
  PushSetup setup{.tip = flank_tip(Length(10e-9)),
                  .springs = {Stiffness(10.0), Stiffness(1.0), Stiffness(100.0)},
                  .tip_friction = 0.3,
                  .species = {gold(), constant(Force(1e-9), 0.5)}};
  std::vector<PlacedParticle> placed;
  for (std::size_t i = 0; i < 25; ++i) {
    placed.push_back({i % 2, {Length(53e-9 * static_cast<double>(i % 5)), Length(53e-9 * static_cast<double>(i / 5))}});
  }
  PushedParticles particles(setup, placed, base_at(-60e-9, 20e-9, 120e-9));
  const std::uint64_t before = digest_of(particles);
  for (int row = 0; row < 4; ++row) {
    const double y_m = 20e-9 + 53e-9 * row;
    drag(particles, base_at(-60e-9, y_m, 120e-9), 1e-6, 1000.0);
    drag(particles, base_at(-60e-9, y_m, 0.0), 1e-6, 1000.0);
    drag(particles, base_at(200e-9, y_m + 9e-9, 0.0), 1e-6, 1000.0);
    drag(particles, base_at(200e-9, y_m, 120e-9), 1e-6, 1000.0);
  }
  EXPECT_NE(digest_of(particles), before);
  EXPECT_EQ(digest_of(particles), 10439619574331411661U);
}

}  // namespace heap_test
}  // namespace afm::physics
