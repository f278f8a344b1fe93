// SPDX-License-Identifier: Apache-2.0
// A sample that drifts below the tip (level 2), as the hand feels it.
// Invariant: a sample that drifts pushes a tip that rests, and the hand gets no energy that the drift did not give
#include "haptics/felt_drift.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "haptics/felt_particles.h"
#include "servo_bench.h"
#include "support/particles/gold_particles.h"

namespace afm {
namespace felt_drift_test {

using haptics::FeltParticles;

constexpr std::uint32_t kSeed = 7;
constexpr std::int64_t kTickNs = 1'000'000;

scene::SharedParticles set_at(std::uint32_t level) {
  scene::SharedParticles set = test::particles_at({{0.0, 0.0}}, test::constant_species(3e-9, 0.5));
  set.level = {.level = level, .seed = kSeed};
  return set;
}

glm::dvec2 direction() {
  const auto way = physics::SampleDrift(physics::kUsualDrift, kSeed).after(physics::Time(1.0));
  return glm::normalize(glm::dvec2(way.x.si, way.y.si));
}

// A tip that rests for a time beside the particle, where the drift brings it, 0.5 nm away at first.
struct RestingTip {
  explicit RestingTip(std::uint32_t level)
      : set(set_at(level)), scale(*haptics::particle_scale(set, haptics::omni_like("hand"))), felt(set, scale) {
    at_m = (test::touch_m(set) + 0.5e-9) * direction();
    step(scale.clear_z_m);
  }
  void step(double z_m) {
    now_ns += kTickNs;
    felt.drift_to(now_ns);
    newest = felt.step(at_m, z_m, 1e-9 * static_cast<double>(kTickNs));
    given_j += newest.given_j;
  }
  void rest(int ticks) {
    for (int i = 0; i < ticks; ++i) step(0.0);
  }

  scene::SharedParticles set;
  haptics::ParticleScale scale;
  FeltParticles felt;
  glm::dvec2 at_m{0.0};
  std::int64_t now_ns = 5'000'000'000;
  haptics::ParticlePush newest;
  double given_j = 0;
};

TEST(FeltDrift, BringsAParticleToATipThatRests) {
  RestingTip tip(2);
  tip.rest(9'000);
  EXPECT_FALSE(tip.newest.touches);
  tip.rest(3'000);
  ASSERT_TRUE(tip.newest.touches) << "0.05 nm/s for 12 s";
  const glm::dvec2 force_n(tip.newest.push_n);
  EXPECT_GT(glm::dot(force_n, direction()), 0.99 * glm::length(force_n)) << "the tip is pushed along the drift";
  const scene::TipPush push = tip.felt.push();
  EXPECT_NEAR(push.base_m[0], tip.at_m.x, 1e-15) << "in the scanner's frame";
  EXPECT_NEAR(push.base_m[1], tip.at_m.y, 1e-15);
  EXPECT_EQ(tip.felt.pages()[0].poses[0].x_m, 0.0) << "in the sample's frame, where it has not moved yet";
  // the hand rested: all energy is the drift's
  EXPECT_GT(tip.felt.stored_j(), 0.0);
  EXPECT_NEAR(tip.given_j, tip.felt.stored_j(), 0.01 * tip.felt.stored_j());
  tip.rest(600'000);
  EXPECT_NE(tip.felt.pages()[0].poses[0].x_m, 0.0) << "the tip holds it against the drift";
  EXPECT_GE(tip.given_j, tip.felt.stored_j());
}

TEST(FeltDrift, LeavesATipAboveInTheScannersFrame) {
  RestingTip tip(2);
  tip.rest(1'000);
  tip.at_m.x += 50e-9;
  tip.step(tip.scale.clear_z_m);
  EXPECT_NEAR(tip.felt.push().apex_m[0], tip.at_m.x, 1e-15);
  EXPECT_NEAR(tip.felt.push().apex_m[1], tip.at_m.y, 1e-15);
}

TEST(FeltDrift, IsNoneBelowLevelTwo) {
  RestingTip one(1), none(0);
  one.rest(12'000);
  none.rest(12'000);
  EXPECT_FALSE(one.newest.touches);
  EXPECT_EQ(one.felt.level().since_ns, 0);
  EXPECT_EQ(one.felt.level().met, 1U);
  EXPECT_EQ(none.felt.level().met, 0U);
  EXPECT_FALSE(none.felt.may_look()) << "level 0 has no picture";
  EXPECT_FALSE(one.felt.may_look()) << "the tip is among the particles";
  one.step(one.scale.clear_z_m);
  EXPECT_TRUE(one.felt.may_look());
}

TEST(FeltDrift, StartsAgainWhenTheParticlesArePutBack) {
  RestingTip tip(2);
  tip.rest(20'000);
  tip.step(tip.scale.clear_z_m);
  EXPECT_TRUE(tip.felt.put_back()) << "the sample has moved";
  EXPECT_EQ(tip.felt.level().since_ns, tip.now_ns);
  tip.step(tip.scale.clear_z_m);
  tip.rest(9'000);
  EXPECT_FALSE(tip.newest.touches);
}

}  // namespace felt_drift_test
}  // namespace afm
