// SPDX-License-Identifier: Apache-2.0
// A tip that is pressed on the sample while it pushes a sphere, in the servo: both rub (M83, row N76).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "servo_bench.h"
#include "support/particles/gold_particles.h"

namespace pressed_push_test {

using namespace afm;
using scene::ScaleMode;
using test::ServoBench;

constexpr double kClosed = 1e-6;
constexpr double kPressedN = 5e-9, kRubs = 0.2;
constexpr double kLowM = -0.004;  // height of the hand while it pushes

// Mica without adhesion under a tip with friction by Amontons, and one sphere of row N16 that needs the same force at
// rest and in motion.
scene::SharedModel pressed_model() {
  scene::SharedModel model = test::paper_model();
  scene::SharedContact& mica = model.materials[test::kMica];
  mica.law = physics::Law::Hertz;
  mica.contact.spring_constant = physics::Stiffness(1.0);
  mica.contact.reduced_modulus = physics::Pressure(5.15e10);
  mica.friction = {.law = physics::FrictionLaw::Amontons,
                   .lattice = physics::LatticeKind::Hexagonal,
                   .coefficient = kRubs,
                   .shear_strength = physics::Pressure(1e8),
                   .period = physics::Length(0.52e-9),
                   .corrugation = physics::Length(5e-12),
                   .lateral_stiffness = physics::Stiffness(1.0)};
  scene::SharedSpecies gold = test::gold_species();
  gold.law = physics::ParticleLaw::Amontons;
  gold.kinetic_ratio = 1.0;
  gold.rolling_distance_m = 0.0;
  gold.tip_adhesion_j_per_m2 = 0.0;
  model.particles = test::particles_at({{-80e-9, 0.0}, {80e-9, 100e-9}}, gold);
  model.particles.pusher.tip_friction = 0.0;
  return model;
}

// Tick in which tip and sphere slide.
struct Sliding {
  double pressed_n = 0, normal_n = 0, rubs_n = 0, pushes_n = 0;
};

Sliding slide(double rate_hz) {
  ServoBench bench(pressed_model(), rate_hz);
  const auto go = [&](double x_m, double height_m, double seconds) {
    bench.renderer.store(
        scene::HandScript{.target_m = {x_m, height_m, 0.0}, .duration_s = seconds, .revision = ++bench.script});
    while (bench.state().acknowledged.hand_script != bench.script) bench.tick();
  };
  bench.arm(test::kMica, ScaleMode::Particles);
  go(-0.032, 0.030, 0.4);
  go(-0.032, kLowM, 0.4);
  // halfway along, where the hand is fastest
  bench.renderer.store(
      scene::HandScript{.target_m = {0.020, kLowM, 0.0}, .duration_s = 3.0, .revision = ++bench.script});
  bench.run(1.8);
  const auto push = bench.renderer.tip_push();
  EXPECT_EQ(push->state, physics::PushState::Slides);
  return {.pressed_n = bench.state().tip.force_n,
          .normal_n = push->normal_n,
          .rubs_n = -bench.samples.back().lateral_force_n[0],
          .pushes_n = -push->lateral_n[0]};
}

TEST(PressedPush, N76RubsTheSampleLessInTheServo) {
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    const Sliding now = slide(rate_hz);
    ASSERT_GT(now.pressed_n, 0.5 * kPressedN);
    const double load_n = now.pressed_n - now.normal_n * std::sin(std::numbers::pi / 12.0);
    test::expect_relative(now.rubs_n, kRubs * load_n, kClosed);
    // the row is for another load, and both forces are linear in it
    const double off_n = now.pressed_n - kPressedN;
    test::expect_relative(load_n - off_n, 3.970209961e-09, kClosed);
    test::expect_relative(now.pushes_n + now.rubs_n - kRubs * off_n, 4.637270739e-09, kClosed);
  }
}

}  // namespace pressed_push_test
