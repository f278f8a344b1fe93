// SPDX-License-Identifier: Apache-2.0
// A sphere that hangs on the tip: its forces, events and places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "haptics/felt_particles.h"
#include "scene/shared/tip_blocks.h"
#include "support/particles/gold_particles.h"

namespace afm {
namespace felt_carry_test {

using haptics::FeltParticles;
using haptics::ParticleScale;
using physics::EventKind;
using physics::PushState;
using scene::SharedParticles;

constexpr double kRadiusM = 15e-9, kAsideM = -45e-9;

const haptics::DeviceSpec kOmni = haptics::omni_like("hand");

// The tip comes down beside the first sphere, touches it and rises; the hand may wait, and then carry it on.
struct Hand {
  explicit Hand(const SharedParticles& set)
      : scale(*haptics::particle_scale(set, kOmni)), felt(set, scale), high_m(scale.clear_z_m + 20e-9) {}

  void go(double x_m, double y_m, double z_m) {
    const glm::dvec3 to(x_m, y_m, z_m), from = at;
    const int ticks = std::max(1, static_cast<int>(std::ceil(glm::length(to - from) / 0.1e-9)));
    for (int i = 1; i <= ticks; ++i) {
      at = from + (to - from) * (static_cast<double>(i) / ticks);
      const haptics::ParticlePush push = felt.step(glm::dvec2(at), at.z, 1e-3);
      for (const auto& event : push.happened()) events.push_back(event.kind);
      strongest_n = std::max(strongest_n, glm::length(push.push_n));
      felt.published();
    }
  }
  void pick_up() {
    go(kAsideM, 0.0, high_m);
    go(kAsideM, 0.0, 10e-9);
    go(-28e-9, 0.0, 10e-9);
    go(-28e-9, 0.0, high_m);
  }
  long count(EventKind kind) const { return std::count(events.begin(), events.end(), kind); }
  const scene::ParticlePose& pose(std::size_t i) const { return felt.pages()[0].poses[i]; }

  ParticleScale scale;
  FeltParticles felt;
  double high_m;
  glm::dvec3 at{kAsideM, 0.0, 1e-6};
  std::vector<EventKind> events;
  double strongest_n = 0.0;
};

TEST(FeltCarry, ASphereIsPickedUpCarriedHighAndReleasedOnAPad) {
  const auto set = std::make_unique<const SharedParticles>(test::particles_to_lift({{0.0, 0.0}, {120e-9, 0.0}}));
  Hand hand(*set);
  hand.pick_up();
  EXPECT_EQ(hand.count(EventKind::ParticleLifted), 1);
  EXPECT_EQ(hand.felt.push().state, PushState::Carried);
  EXPECT_EQ(hand.felt.push().particle, 0);
  EXPECT_EQ(hand.felt.sample().state, PushState::Carried);
  EXPECT_EQ(hand.pose(0).moved, PushState::Carried);

  // higher than a free tip, over the other sphere: no force, and the sphere follows
  const glm::dvec2 hangs = glm::dvec2(hand.pose(0).x_m, hand.pose(0).y_m) - glm::dvec2(hand.at);
  hand.strongest_n = 0.0;
  hand.go(200e-9, 50e-9, hand.high_m);
  EXPECT_EQ(hand.strongest_n, 0.0);
  EXPECT_NEAR(hand.felt.stored_j(), 0.0, 1e-12);
  EXPECT_NEAR(hand.pose(0).x_m, 200e-9 + hangs.x, 1e-18);
  EXPECT_NEAR(hand.pose(0).y_m, 50e-9 + hangs.y, 1e-18);
  EXPECT_EQ(hand.pose(1).x_m, 120e-9);
  EXPECT_EQ(hand.felt.push().digest, scene::digest_of(hand.felt.pages(), 2));

  hand.go(200e-9, 50e-9, 2.0 * kRadiusM - 3e-9);
  EXPECT_EQ(hand.count(EventKind::ParticleSetDown), 1);
  EXPECT_EQ(hand.pose(0).moved, PushState::Several);
  EXPECT_EQ(hand.count(EventKind::ParticleTorn), 0);
  hand.go(200e-9, 50e-9, hand.high_m);
  EXPECT_EQ(hand.count(EventKind::ParticleTorn), 1);
  EXPECT_EQ(hand.count(EventKind::ParticleLifted), 1);
  EXPECT_EQ(hand.count(EventKind::ParticleRiddenOver), 0);
  EXPECT_EQ(hand.count(EventKind::ParticleLost), 0);
  EXPECT_NEAR(hand.pose(0).x_m, 200e-9, 4e-9);
  EXPECT_NEAR(hand.pose(0).y_m, 50e-9, 4e-9);
  EXPECT_EQ(hand.felt.push().particle, scene::kNoParticle);

  // all of this is one push, which can be taken back
  EXPECT_EQ(hand.felt.push().strokes, 1U);
  EXPECT_TRUE(hand.felt.take_back());
  EXPECT_EQ(hand.pose(0).x_m, 0.0);
  EXPECT_EQ(hand.pose(0).y_m, 0.0);
}

TEST(FeltCarry, AForceThatIsRemovedLeavesTheSphereWhereItWasLifted) {
  const auto set = std::make_unique<const SharedParticles>(test::particles_to_lift({{0.0, 0.0}, {120e-9, 0.0}}));
  Hand hand(*set);
  hand.pick_up();
  ASSERT_EQ(hand.felt.push().state, PushState::Carried);
  const double lifted_m = hand.pose(0).x_m;  // place to which the tip rose straight up
  hand.go(300e-9, 0.0, hand.high_m);
  EXPECT_FALSE(hand.felt.take_back()) << "not while it hangs";
  hand.felt.lift();
  EXPECT_NEAR(hand.pose(0).x_m, lifted_m, 3e-9);
  EXPECT_EQ(hand.pose(0).moved, PushState::Several);
  EXPECT_EQ(hand.felt.changed_pages().size(), 1U);
  EXPECT_EQ(hand.felt.push().digest, scene::digest_of(hand.felt.pages(), 2));
  EXPECT_EQ(hand.felt.push().particle, scene::kNoParticle);
  // it was drawn below the tip before, which is taken back
  EXPECT_TRUE(hand.felt.take_back());
  EXPECT_EQ(hand.pose(0).x_m, 0.0);
}

TEST(FeltCarry, AServoThatGoesOnLaysASphereThatHungWhereThereIsRoom) {
  const auto set = std::make_unique<const SharedParticles>(test::particles_to_lift({{0.0, 0.0}, {120e-9, 0.0}}));
  Hand hand(*set);
  hand.pick_up();
  hand.go(118e-9, 3e-9, hand.high_m);  // place over the other sphere
  std::vector<scene::ParticlePage> pages(hand.felt.pages().begin(), hand.felt.pages().end());
  FeltParticles next(*set, hand.scale);
  next.resume(pages);
  const auto& poses = next.pages()[0].poses;
  EXPECT_EQ(poses[1], pages[0].poses[1]);
  EXPECT_EQ(poses[0].moved, PushState::Several);
  const double apart_m = std::hypot(poses[0].x_m - poses[1].x_m, poses[0].y_m - poses[1].y_m);
  EXPECT_GE(apart_m, 2.0 * kRadiusM);
  EXPECT_LE(apart_m, 2.5 * kRadiusM) << "near where it hung";
  EXPECT_EQ(next.push().digest, scene::digest_of(next.pages(), 2));

  // with enough room, the sphere lies where it hung
  hand.go(300e-9, 0.0, hand.high_m);
  pages.assign(hand.felt.pages().begin(), hand.felt.pages().end());
  next.resume(pages);
  EXPECT_EQ(next.pages()[0].poses[0].x_m, pages[0].poses[0].x_m);
}

}  // namespace felt_carry_test
}  // namespace afm
