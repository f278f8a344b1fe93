// SPDX-License-Identifier: Apache-2.0
// The scale of particles under the hand, and rows of the table of cases through the servo's own code.
#include "haptics/particle_scale.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "haptics/felt_particles.h"
#include "support/particles/gold_particles.h"

namespace afm {
namespace particle_scale_test {

using haptics::FeltParticles;
using haptics::ParticlePush;
using haptics::ParticleScale;
using physics::EventKind;
using physics::PushState;
using scene::SharedParticles;
using test::constant_species;
using test::expect_relative;
using test::particles_at;
using test::touch_m;
using testing::HasSubstr;

const haptics::DeviceSpec kOmni = haptics::omni_like("hand");

// ---- scale

TEST(ParticleScale, OfOneParticleIsThatOfTheSpecification) {
  const SharedParticles particles = particles_at({{0.0, 0.0}});
  const ParticleScale scale = haptics::particle_scale(particles, kOmni).value();
  EXPECT_NEAR(scale.hand_m_per_m * 2.0 * test::kGoldRadiusM, 0.010, 1e-15);
  // a quarter of a nN: 0.54 N, at which the lever bends by a third of 8 mm
  EXPECT_NEAR(0.253e-9 * scale.hand_n_per_n, 0.537, 0.01);
  EXPECT_NEAR(10.0 / scale.softened_sideways * scale.hand_n_per_n / scale.hand_m_per_m, 200.0, 1e-9);
  EXPECT_NEAR(1.0 / scale.softened_upwards * scale.hand_n_per_n / scale.hand_m_per_m, 200.0, 1e-9);
  EXPECT_GT(scale.clear_z_m, 2.0 * test::kGoldRadiusM);
}

TEST(ParticleScale, LeavesASoftLeverAsItIs) {
  SharedParticles particles = particles_at({{0.0, 0.0}});
  particles.pusher.lateral_spring_n_per_m = particles.pusher.normal_spring_n_per_m = 1e-3;
  const ParticleScale scale = haptics::particle_scale(particles, kOmni).value();
  EXPECT_EQ(scale.softened_sideways, 1.0);
  EXPECT_EQ(scale.softened_upwards, 1.0);
}

TEST(ParticleScale, OfAWideSetFitsTheWorkspaceAndKeepsTheLeverFromRunningRound) {
  const SharedParticles particles = particles_at({{-400e-9, 0.0}, {0.0, 0.0}, {400e-9, 0.0}});
  const ParticleScale scale = haptics::particle_scale(particles, kOmni).value();
  EXPECT_NEAR(scale.hand_m_per_m * 800e-9, 0.6 * 0.160, 1e-12);
  const double bend_m = 0.25e-9 * scale.hand_n_per_n / 200.0 / scale.hand_m_per_m;
  EXPECT_LT(bend_m, 0.34 * touch_m(particles));
}

// A tip that holds gold pulls harder than the force that moves it: the device's limit applies to the pull.
TEST(ParticleScale, KeepsThePullOfATipThatSticksWithinTheDevice) {
  SharedParticles particles = particles_at({{0.0, 0.0}});
  const ParticleScale plain = haptics::particle_scale(particles, kOmni).value();
  particles.species[0].sticks = 1;
  const ParticleScale sticky = haptics::particle_scale(particles, kOmni).value();
  const double pull_n = 3.598997214e-09 / std::cos(std::numbers::pi / 12.0) * 0.02 / 0.05;
  EXPECT_GT(pull_n * plain.hand_n_per_n, haptics::force_cap_n(kOmni));
  EXPECT_LE(pull_n * sticky.hand_n_per_n, haptics::force_cap_n(kOmni) * (1.0 + 1e-6));
  particles.species[0].scatter_seed = 7;  // scatter by which some contacts hold more
  EXPECT_NEAR(haptics::particle_scale(particles, kOmni)->hand_n_per_n, 0.5 * sticky.hand_n_per_n,
              1e-9 * sticky.hand_n_per_n);
  EXPECT_GT(sticky.clear_z_m, plain.clear_z_m + pull_n * sticky.softened_upwards / 1.0);
}

TEST(ParticleScale, RefusesParticlesTooFaintOrTooFarApart) {
  const SharedParticles wide = particles_at({{-1e-5, 0.0}, {1e-5, 0.0}});
  const auto scale = haptics::particle_scale(wide, kOmni);
  ASSERT_FALSE(scale);
  EXPECT_THAT(scale.error().message, HasSubstr("too little to feel; put them closer together"));
  EXPECT_EQ(haptics::particle_scale(SharedParticles{}, kOmni).value().hand_m_per_m, 0.0);
}

// Rows N72 and N74, for particles so large in the hand that its grip holds 1 N.
TEST(ParticleScale, HasTheNumbersOfTheCases) {
  SharedParticles particles = particles_at({{0.0, 0.0}}, constant_species(20e-9, 0.5, 50e-9));
  particles.pusher.diameter_in_hand_m = 0.020;
  const ParticleScale scale = haptics::particle_scale(particles, kOmni).value();
  EXPECT_NEAR(scale.hand_m_per_m, 2e5, 1e-4);
  EXPECT_NEAR(scale.hand_n_per_n, 5e7, 1.0);
  EXPECT_NEAR(10.0 / scale.softened_sideways, 0.8, 1e-9);
  SharedParticles gold = particles_at({{0.0, 0.0}});
  gold.pusher.diameter_in_hand_m = 0.020;
  EXPECT_NEAR(haptics::particle_scale(gold, kOmni)->hand_n_per_n, 3955880544.0, 0.01 * 3.96e9);
}

// ---- rows of single spheres, at the rates of a servo; on a scale without softening

class AtRate : public testing::TestWithParam<double> {
 protected:
  // The hand's way at a speed, in ticks: along x at the height of the sample.
  struct Drag {
    double to_m;
    double speed_m_per_s;
  };

  void drag(FeltParticles& felt, const Drag& way) {
    const double from_m = at_m_;
    const int ticks =
        std::max(1, static_cast<int>(std::ceil(std::abs(way.to_m - from_m) / way.speed_m_per_s * GetParam())));
    for (int i = 1; i <= ticks; ++i) {
      at_m_ = from_m + (way.to_m - from_m) * i / ticks;
      const ParticlePush step = felt.step({at_m_, 0.0}, 0.0, 1.0 / GetParam());
      for (const ParticlePush::Event& event : step.happened()) events_.push_back(event);
    }
  }

  // Lowers the tip at the origin.
  void put_down(FeltParticles& felt) {
    felt.step({0.0, 0.0}, 1.5 * felt.scale().clear_z_m, 1.0 / GetParam());
    do {
      felt.step({0.0, 0.0}, 0.0, 1.0 / GetParam());
    } while (felt.push().lagging != 0);
    at_m_ = 0.0;
  }

  double at_m_ = 0.0;
  std::vector<ParticlePush::Event> events_;
};
INSTANTIATE_TEST_SUITE_P(FeltParticles, AtRate, testing::Values(500.0, 1000.0, 4000.0));

ParticleScale unsoftened() { return {.hand_m_per_m = 1e5, .hand_n_per_n = 1e8, .clear_z_m = 110e-9}; }

double lateral_n(const FeltParticles& felt) {
  const scene::TipPush push = felt.push();
  return std::hypot(push.lateral_n[0], push.lateral_n[1]);
}

TEST_P(AtRate, N28HoldsGivesAndJumps) {
  scene::SharedSpecies species = constant_species(3e-9, 0.5, 50e-9);
  species.ageing_s = 1.0;
  SharedParticles particles = particles_at({{0.0, 0.0}}, species);
  const double rho = touch_m(particles), travel = 5.475442123e-10;
  particles.particles[0].x_m = rho;
  FeltParticles felt(particles, unsoftened());
  put_down(felt);
  drag(felt, {travel * (1.0 - 1e-7), 1e-8});
  EXPECT_EQ(felt.push().state, PushState::Holds);
  expect_relative(lateral_n(felt), 3e-9, 1e-6);
  drag(felt, {travel * (1.0 + 1e-9), 1.0});
  EXPECT_EQ(felt.push().yields, 1U);
  expect_relative(felt.pages()[0].poses[0].x_m - rho, 2.737721061e-10, 1e-6);
  expect_relative(lateral_n(felt), 1.5e-9, 1e-9);
  expect_relative(felt.push().lost_j, 6.159872388e-19, 1e-6);
  ASSERT_EQ(events_.size(), 2U);
  EXPECT_EQ(events_[0].kind, EventKind::ParticleTouched);
  EXPECT_EQ(events_[1].kind, EventKind::ParticleGave);
  expect_relative(events_[1].force_before_n, 3e-9, 1e-9);
  expect_relative(events_[1].force_after_n, 1.5e-9, 1e-9);
}

TEST_P(AtRate, N29TeethOfASaw) {
  scene::SharedSpecies species = constant_species(3e-9, 0.5, 50e-9);
  species.ageing_s = 0.0;
  SharedParticles particles = particles_at({{0.0, 0.0}}, species);
  particles.particles[0].x_m = touch_m(particles);
  FeltParticles felt(particles, unsoftened());
  put_down(felt);
  const double period_m = 0.002737721061 * 100e-9, first_m = 5.475442123e-10;
  drag(felt, {first_m + 0.5 * period_m, 100e-9});
  const scene::TipPush before = felt.push();
  drag(felt, {first_m + 100.5 * period_m, 100e-9});
  EXPECT_EQ(felt.push().yields - before.yields, 100U);
  expect_relative((felt.push().lost_j - before.lost_j) / (100.0 * period_m), 2.25e-09, 1e-6);
}

TEST_P(AtRate, N20SlidesByTheBalance) {
  scene::SharedSpecies species = test::gold_species();
  species.kinetic_ratio = 1.0;
  species.tip_adhesion_j_per_m2 = 0.05;
  species.reduced_modulus_pa = 38710783890.0;
  SharedParticles particles = particles_at({{0.0, 0.0}}, species);
  particles.particles[0].x_m = touch_m(particles);
  FeltParticles felt(particles, {.hand_m_per_m = 2e5, .hand_n_per_n = 4e9, .clear_z_m = 60e-9});
  put_down(felt);
  drag(felt, {5e-9, 1e-6});
  EXPECT_EQ(felt.push().state, PushState::Slides);
  expect_relative(lateral_n(felt), 2.532730344e-10, 1e-6);
  EXPECT_GT(felt.push().other_threshold_n, 10.0 * felt.push().threshold_n);  // Amontons, 14-fold
}

// Loss of a sphere beside the tip, and its event.
TEST_P(AtRate, N32LosesASphereBesideThePath) {
  const double offsets[] = {0.2, 0.05}, travels[] = {2.29243167, 3.688253867};
  for (int i = 0; i < 2; ++i) {
    SharedParticles particles = particles_at({{0.0, 0.0}}, constant_species(1e-12, 1.0));
    particles.pusher.lateral_spring_n_per_m = particles.pusher.normal_spring_n_per_m =
        particles.pusher.contact_stiffness_n_per_m = 1e3;
    const double rho = touch_m(particles), aside = offsets[i] * rho, ahead = std::sqrt(rho * rho - aside * aside);
    particles.particles[0] = {.x_m = ahead, .y_m = aside};
    FeltParticles felt(particles, {.hand_m_per_m = 2e5, .hand_n_per_n = 1e12, .clear_z_m = 60e-9});
    events_.clear();
    put_down(felt);
    drag(felt, {travels[i] * 0.999 * rho, 1e-6});
    EXPECT_GT(felt.pages()[0].poses[0].x_m, at_m_);
    drag(felt, {travels[i] * 1.001 * rho, 1e-6});
    EXPECT_LT(felt.pages()[0].poses[0].x_m, at_m_);
    drag(felt, {(travels[i] + 0.5) * rho, 1e-6});
    ASSERT_FALSE(events_.empty());
    EXPECT_EQ(events_.front().kind, EventKind::ParticleTouched);
    EXPECT_EQ(events_.back().kind, EventKind::ParticleLost);
    expect_relative(events_.back().force_before_n, 1e-12, 0.01);
    EXPECT_EQ(felt.push().particle, scene::kNoParticle);
  }
}

TEST_P(AtRate, N75AClosedPathTakesWork) {
  for (const double ratio : {1.0, 0.5}) {
    scene::SharedSpecies species = constant_species(3e-9, ratio, 50e-9);
    species.ageing_s = 1e6;
    SharedParticles particles = particles_at({{0.0, 0.0}}, species);
    const double rho = touch_m(particles);
    particles.particles[0].x_m = rho;
    FeltParticles felt(particles, unsoftened());
    events_.clear();
    put_down(felt);
    drag(felt, {20e-9, 1e-7});
    drag(felt, {0.0, 1e-7});
    expect_relative(felt.push().given_j, ratio == 1.0 ? 5.835736736e-17 : 2.979467092e-17, 1e-5);
    expect_relative(felt.pages()[0].poses[0].x_m - rho, ratio == 1.0 ? 1.945245579e-08 : 1.972622789e-08, 1e-5);
    // a hand that returns has lost nothing
    for (const ParticlePush::Event& event : events_) EXPECT_NE(event.kind, EventKind::ParticleLost);
  }
}

// Rows N55 and N56: a tip that goes back drags a sphere, and tears off one that is pinned.
TEST_P(AtRate, N55AndN56DragOrTear) {
  for (const bool pinned : {false, true}) {
    scene::SharedSpecies species = test::gold_species();
    species.tip_adhesion_j_per_m2 = 0.05;
    species.reduced_modulus_pa = 38710783890.0;
    species.ageing_s = 1e6;
    species.sticks = 1;
    SharedParticles particles = particles_at({{0.0, 0.0}}, species);
    const double rho = touch_m(particles);
    particles.particles[0].x_m = rho - 0.01e-9;
    particles.particles[0].pinned = pinned ? 1U : 0U;
    FeltParticles felt(particles, {.hand_m_per_m = 2e5, .hand_n_per_n = 4e9, .clear_z_m = 60e-9});
    events_.clear();
    put_down(felt);
    drag(felt, {0.02e-9, 1e-9});
    drag(felt, {-5e-9, 1e-9});
    const auto torn = std::find_if(events_.begin(), events_.end(),
                                   [](const auto& event) { return event.kind == EventKind::ParticleTorn; });
    const auto dragged = std::find_if(events_.begin(), events_.end(),
                                      [](const auto& event) { return event.kind == EventKind::ParticleDragged; });
    EXPECT_EQ(torn != events_.end(), pinned);
    EXPECT_EQ(dragged != events_.end(), !pinned);
    if (pinned) {
      expect_relative(torn->force_before_n, 3.598997214e-09 / std::cos(std::numbers::pi / 12.0), 1e-6);
      EXPECT_EQ(torn->force_after_n, 0.0);
      EXPECT_EQ(felt.push().particle, scene::kNoParticle);
      EXPECT_EQ(felt.push().lateral_n[0], 0.0);
    } else {
      EXPECT_LT(felt.pages()[0].poses[0].x_m, rho - 4.5e-9);
      EXPECT_LT(felt.push().normal_n, 0.0);
      EXPECT_GT(felt.push().lateral_n[0], 0.0) << "towards the sphere";
      EXPECT_EQ(felt.push().state, PushState::Slides);
    }
  }
}

TEST_P(AtRate, N79ASphereThatIsLostHasSpunAboutTheVertical) {
  SharedParticles particles = particles_at({{0.0, 0.0}}, test::constant_species(0.2e-9, 1.0));
  particles.pusher.lateral_spring_n_per_m = particles.pusher.normal_spring_n_per_m = 1000.0;
  particles.pusher.contact_stiffness_n_per_m = 1e5;
  const double rho = touch_m(particles), beside = 0.05 * rho;
  particles.particles[0] = {.x_m = rho * std::sqrt(1.0 - 0.05 * 0.05), .y_m = beside};
  FeltParticles felt(particles, {.hand_m_per_m = 2e5, .hand_n_per_n = 4e9, .clear_z_m = 60e-9});
  put_down(felt);
  drag(felt, {3.68 * rho, 1e-6});
  const scene::ParticlePose& pose = felt.pages()[0].poses[0];
  EXPECT_EQ(pose.moved, PushState::Slides);
  const glm::dvec2 away(pose.x_m - at_m_, pose.y_m);
  const double turned = 2.0 * std::atan2(pose.orientation[3], pose.orientation[0]) * 180.0 / std::numbers::pi;
  // all of the row's turn but the first tick and the rest of the way to 90 degrees
  const double rest = std::acos(away.y / glm::length(away)) * rho / (25e-9 * std::cos(std::numbers::pi / 12.0));
  EXPECT_NEAR(turned + rest * 180.0 / std::numbers::pi, 145.2485993, 0.3);
}

TEST_P(AtRate, N79ARollingSphereTurnsByItsTravel) {
  scene::SharedSpecies species = test::gold_species();
  species.radius_m = 250e-9;
  species.rolling_distance_m = 0.3e-9;
  SharedParticles particles = particles_at({{0.0, 0.0}}, species);
  particles.pusher.tip_friction = 0.01;
  particles.pusher.tip_radius_m = 20e-9;
  particles.species[0].shear_strength_pa = 100e6;
  const double rho = touch_m(particles);
  particles.particles[0].x_m = rho;
  FeltParticles felt(particles, {.hand_m_per_m = 2e4, .hand_n_per_n = 1e8, .clear_z_m = 600e-9});
  put_down(felt);
  drag(felt, {1e-6, 1e-5});
  EXPECT_EQ(felt.push().state, PushState::Rolls);
  const scene::ParticlePose& pose = felt.pages()[0].poses[0];
  EXPECT_EQ(pose.moved, PushState::Rolls);
  const double turned = 2.0 * std::atan2(pose.orientation[2], pose.orientation[0]);  // angle about y
  EXPECT_NEAR(turned, (pose.x_m - rho) / 250e-9, 1e-3);
}

}  // namespace particle_scale_test
}  // namespace afm
