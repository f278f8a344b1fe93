// SPDX-License-Identifier: Apache-2.0
// The groove along the plan of a push: its field, its fades, and the chain of the servo behind it.
// Invariant: a groove that guides a hand gives at most 0.3 N, conserves energy, and changes no force while it is off
#include "haptics/felt_groove.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "haptics/contact_model.h"
#include "haptics/felt_particles.h"
#include "haptics/passivity_observer.h"
#include "servo_bench.h"
#include "support/particles/gold_particles.h"

namespace afm {
namespace felt_groove_test {

using haptics::FeltGroove;
using haptics::GroovePull;
using haptics::PassivityObserver;
using scene::PlannedPush;
using scene::ScaleMode;

const haptics::DeviceSpec kOmni = haptics::omni_like("hand");
constexpr double kScale = 2e5;   // metres of hand per metre
constexpr double kTickS = 1e-3;  // period of the servo

PlannedPush plan_to(double x_m, double y_m, bool guided = true) {
  return {.from_m = {-80e-9, 0.0}, .to_m = {x_m, y_m}, .particle = 0, .guided = guided ? 1U : 0U};
}

// A groove at full gain, on a slanting plan.
class FullGroove : public ::testing::Test {
 protected:
  FullGroove() {
    groove_.follow(plan_);
    for (int i = 0; i < 600; ++i) at(from_m_);
  }
  GroovePull at(const glm::dvec2& hand_m) { return groove_.step(hand_m / kScale, true, kTickS); }
  glm::dvec2 place(double along_m, double aside_m) const { return from_m_ + along_m * along_ + aside_m * across_; }

  PlannedPush plan_ = plan_to(90e-9, 110e-9);
  glm::dvec2 from_m_ = kScale * glm::dvec2(plan_.from_m[0], plan_.from_m[1]);
  glm::dvec2 to_m_ = kScale * glm::dvec2(plan_.to_m[0], plan_.to_m[1]);
  glm::dvec2 along_ = glm::normalize(to_m_ - from_m_), across_{-along_.y, along_.x};
  double length_m_ = glm::distance(from_m_, to_m_);
  FeltGroove groove_{haptics::groove_limits(kOmni), kScale};
};

TEST_F(FullGroove, PullsTowardsTheLineWithAtMostThreeTenthsOfANewton) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place_m(-0.12, 0.12);
  double most_n = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const double force_n = glm::length(at({place_m(random), place_m(random)}).force_n);
    ASSERT_LE(force_n, FeltGroove::kMostForceN);
    most_n = std::max(most_n, force_n);
  }
  EXPECT_GT(most_n, 0.999 * FeltGroove::kMostForceN);
  const double steepest_m = groove_.half_width_m() / std::sqrt(5.0);
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec2 force_n = at(place(0.5 * length_m_, side * steepest_m)).force_n;
    EXPECT_NEAR(glm::dot(force_n, across_), -side * FeltGroove::kMostForceN, 1e-6);
    EXPECT_NEAR(glm::dot(force_n, along_), 0.0, 1e-15) << "nothing along the line";
  }
  EXPECT_LT(glm::length(at(place(0.3 * length_m_, 0.0)).force_n), 1e-12) << "nothing on it";
}

TEST_F(FullGroove, IsExactlyNothingBeyondItsSidesAndItsEnds) {
  const double ramp_m = FeltGroove::kRampOverWidth * groove_.half_width_m();
  for (const glm::dvec2& off : {place(0.5 * length_m_, groove_.half_width_m() * 1.0001), place(-ramp_m * 1.0001, 0.001),
                                place(length_m_ + ramp_m * 1.0001, -0.001), place(-1.0, 0.0), place(0.0, -5.0)}) {
    const GroovePull pull = at(off);
    EXPECT_EQ(pull.force_n, glm::dvec2(0.0));
    EXPECT_EQ(pull.stored_j, 0.0);
  }
}

// The force is the gradient of the potential, whose curvature is at most the stiffness that the observer grants.
TEST_F(FullGroove, HasAPotential) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> along(-0.03, length_m_ + 0.03), aside(-0.012, 0.012), turn(0.0, 7.0);
  constexpr double kStepM = 1e-6;
  for (int i = 0; i < 20'000; ++i) {
    const double along_m = along(random);
    const glm::dvec2 hand_m = place(along_m, aside(random));
    const double angle = turn(random);
    const glm::dvec2 way(std::cos(angle), std::sin(angle));
    const GroovePull here = at(hand_m), before = at(hand_m - kStepM * way), after = at(hand_m + kStepM * way);
    ASSERT_NEAR(glm::dot(here.force_n, way), -(after.stored_j - before.stored_j) / (2.0 * kStepM), 2e-6) << i;
    const double curvature = -glm::dot(after.force_n - before.force_n, way) / (2.0 * kStepM);
    ASSERT_LE(curvature, here.stiffness_n_per_m * (1.0 + 1e-5)) << i;
  }
}

TEST_F(FullGroove, GivesNoEnergyOnAnyClosedPath) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> along(-0.05, length_m_ + 0.05), aside(-0.02, 0.02);
  const double depth_j = FeltGroove::kDepth * FeltGroove::kMostForceN * groove_.half_width_m();
  for (int path = 0; path < 50; ++path) {
    std::vector<glm::dvec2> corners;
    for (int i = 0; i < 5; ++i) {
      const double along_m = along(random);
      corners.push_back(place(along_m, aside(random)));
    }
    corners.push_back(corners.front());
    double work_j = 0.0;
    for (std::size_t i = 1; i < corners.size(); ++i) {
      constexpr int kSteps = 10'000;
      const glm::dvec2 step_m = (corners[i] - corners[i - 1]) / static_cast<double>(kSteps);
      for (int k = 0; k < kSteps; ++k) work_j += glm::dot(at(corners[i - 1] + (k + 0.5) * step_m).force_n, step_m);
    }
    ASSERT_NEAR(work_j, 0.0, 1e-5 * depth_j) << path;
  }
}

TEST_F(FullGroove, FadesWithoutAStepAndOnlyThenTakesAnotherLine) {
  const glm::dvec2 aside = place(0.5 * length_m_, groove_.half_width_m() / std::sqrt(5.0));
  double before_n = glm::length(at(aside).force_n);
  groove_.follow(plan_to(-10e-9, -200e-9));
  const double step_n = FeltGroove::kMostForceN * kTickS / FeltGroove::kFadeS * (1.0 + 1e-9);
  int ticks = 0;
  for (; before_n > 0.0 && ticks < 1000; ++ticks) {
    const GroovePull pull = at(aside);
    ASSERT_LE(before_n - glm::length(pull.force_n), step_n);
    ASSERT_NEAR(glm::dot(pull.force_n, along_), 0.0, 1e-12) << "still the line before";
    before_n = glm::length(pull.force_n);
  }
  EXPECT_NEAR(ticks, 500, 1);
  GroovePull other;
  for (int i = 0; i < 600; ++i) other = at(aside);
  EXPECT_TRUE(other.acts);
  EXPECT_GT(other.stiffness_n_per_m, 99.0);
  groove_.follow(plan_to(-10e-9, -200e-9, false));
  for (int i = 0; i < 499; ++i) EXPECT_TRUE(at(aside).acts);
  for (int i = 0; i < 3; ++i) at(aside);
  EXPECT_FALSE(at(aside).acts);
  groove_.follow({});
  EXPECT_FALSE(at(aside).acts);
}

TEST_F(FullGroove, FadesWhileItMayNotActAndIsGoneOnceDropped) {
  const glm::dvec2 aside = place(0.5 * length_m_, 0.004);
  const double full_n = glm::length(at(aside).force_n);
  const GroovePull less = groove_.step(aside / kScale, false, kTickS);
  EXPECT_NEAR(glm::length(less.force_n), full_n * (1.0 - kTickS / FeltGroove::kFadeS), 1e-9);
  EXPECT_GT(less.given_j, 0.0) << "what the fade takes out of the well is told";
  groove_.drop();
  EXPECT_EQ(groove_.force_n(), glm::dvec2(0.0));
  EXPECT_LT(glm::length(at(aside).force_n), 0.002) << "it begins anew from nothing";
}

// A hand that wanders while the groove is switched on and off, and replanned, never has energy without a source.
TEST(FeltGroove, SatisfiesTheObserverWhateverIsSwitched) {
  FeltGroove groove(haptics::groove_limits(kOmni), kScale);
  PassivityObserver observer;
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> share(0.0, 1.0), place_m(-0.03, 0.03);
  glm::dvec2 hand_m(0.0), to_m(0.0), velocity(0.0);
  GroovePull last;
  double most_j = 0.0, most_n = 0.0;
  for (int i = 0; i < 200'000; ++i) {
    if (share(random) < 0.003) {
      const double x_m = 1e-6 * (share(random) - 0.5);
      groove.follow(plan_to(x_m, 1e-6 * (share(random) - 0.5)));
    }
    if (share(random) < 0.002) groove.follow({});
    if (share(random) < 0.01) to_m = {place_m(random), place_m(random)};
    velocity += kTickS * (400.0 * (to_m - hand_m) - 25.0 * velocity);
    const glm::dvec2 step_m = kTickS * velocity;
    hand_m += step_m;
    const GroovePull now = groove.step(hand_m / kScale, share(random) < 0.999, kTickS);
    const glm::dvec3 force_n(last.force_n, 0.0);
    observer.integrate({.moved_m = glm::dvec3(step_m, 0.0),
                        .wanted_n = force_n,
                        .commanded_n = force_n,
                        .stored_rise_j = now.stored_j - now.given_j - last.stored_j,
                        .stiffness_n_per_m = last.stiffness_n_per_m});
    most_j = std::max(most_j, observer.excess_j());
    most_n = std::max(most_n, glm::length(now.force_n));
    last = now;
  }
  EXPECT_LT(most_j, 1e-12);
  EXPECT_GT(most_n, 0.2);
}

TEST(FeltGroove, LeavesADeviceMostOfItsForceAndStiffness) {
  const haptics::GrooveLimits omni = haptics::groove_limits(kOmni);
  EXPECT_EQ(omni.most_force_n, 0.3);
  EXPECT_EQ(omni.most_stiffness_n_per_m, 100.0);
  EXPECT_NEAR(haptics::groove_limits(haptics::limited_to(kOmni, 0.4)).most_force_n, 0.1, 1e-9);
  haptics::DeviceSpec soft = kOmni;
  soft.max_stiffness_n_per_m = 200.0;
  soft.max_continuous_force_n = 0.25;
  EXPECT_EQ(haptics::groove_limits(soft).most_stiffness_n_per_m, 50.0);
  EXPECT_EQ(haptics::groove_limits(soft).most_force_n, haptics::kUsableLimitShare * 0.25);
  FeltGroove none({}, kScale);
  none.follow(plan_to(90e-9, 0.0));
  EXPECT_FALSE(none.step({0.0, 0.0}, true, kTickS).acts);
}

// ---- on the hand

// Contact models of one material with the same particles, one without any groove.
struct Hand {
  Hand()
      : particles(test::particles_at({{-80e-9, 0.0}, {30e-9, 70e-9}})),
        scale(*haptics::particle_scale(particles, kOmni)),
        guided(particles, scale, haptics::groove_limits(kOmni)),
        plain(particles, scale) {
    const scene::SharedContact mica = test::paper_model().materials[test::kMica];
    const auto tables = test::required(haptics::build_tables(mica, {}));
    auto common = test::required(haptics::Scaling::common_scale(std::vector{tables}, kOmni));
    common.particles = scale;
    for (auto* model : {&with, &without}) {
      *model = test::required(haptics::ContactModel::create(mica, 0, tables, {}, common, kOmni, 1'000'000));
    }
    use(ScaleMode::Particles);
  }
  void use(ScaleMode mode) {
    with->use(mode, &guided);
    without->use(mode, &plain);
  }

  scene::SharedParticles particles;
  haptics::ParticleScale scale;
  haptics::FeltParticles guided, plain;
  std::unique_ptr<haptics::ContactModel> with, without;
};

// Wanders over and among the particles; number of ticks that differ in force or energy.
int different_ticks(Hand& hand) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> place(-0.03, 0.03), height(-0.002, 0.03);
  glm::dvec3 at(0.0, 0.0, 0.06), to = at;
  int different = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (i % 200 == 0) to = {place(random), place(random), height(random)};
    if (i % 1000 == 900) to.z = 0.06;
    at += 0.02 * (to - at);
    const haptics::ScanFeedback feedback{.elapsed_s = kTickS, .without_force = i % 5000 < 100};
    const haptics::Touch a = hand.with->step(at, feedback), b = hand.without->step(at, feedback);
    const auto law = hand.with->energy(a), bare = hand.without->energy(b);
    const bool same = std::memcmp(&a.hand_force_n, &b.hand_force_n, sizeof(glm::dvec3)) == 0 &&
                      std::memcmp(&law.stored_j, &bare.stored_j, sizeof(double)) == 0 &&
                      std::memcmp(&law.given_j, &bare.given_j, sizeof(double)) == 0 &&
                      law.stiffness_n_per_m == bare.stiffness_n_per_m;
    different += same ? 0 : 1;
  }
  return different;
}

TEST(GrooveOfAPlan, ChangesNoBitOfAnyForceWhileItIsOffOrOnAnotherScale) {
  Hand hand;
  EXPECT_EQ(different_ticks(hand), 0) << "no plan";
  hand.guided.groove().follow(plan_to(90e-9, 0.0, false));
  EXPECT_EQ(different_ticks(hand), 0) << "a plan without a groove";
  hand.guided.groove().follow(plan_to(90e-9, 0.0));
  EXPECT_GT(different_ticks(hand), 1000);
  hand.guided.drop();
  for (const ScaleMode mode : {ScaleMode::Common, ScaleMode::Fit, ScaleMode::Compressed, ScaleMode::Atoms}) {
    hand.use(mode);
    EXPECT_EQ(different_ticks(hand), 0);
  }
}

class GroovedBench : public test::ServoBench {
 public:
  GroovedBench() : ServoBench(model()) {}
  static scene::SharedModel model() {
    scene::SharedModel model = test::paper_model();
    model.particles = test::particles_at({{-80e-9, 0.0}, {80e-9, 100e-9}});
    return model;
  }
  void go(double x_m, double y_m, double height_m, double seconds) {
    renderer.store(scene::HandScript{.target_m = {x_m, height_m, -y_m}, .duration_s = seconds, .revision = ++script});
    do {
      checked_tick();
    } while (state().acknowledged.hand_script != script);
  }
  // Expects the force of a tick to differ from the previous one by no more than the governor allows.
  void checked_tick() {
    const auto before = renderer.tip_state().value_or(scene::TipState{}).hand.force_n;
    tick();
    const auto now = state().hand.force_n;
    const double step_n = std::hypot(now[0] - before[0], now[1] - before[1], now[2] - before[2]);
    ASSERT_LE(step_n, state().safety.slew_limit_n_per_s * 1e-9 * static_cast<double>(loop->period_ns()) * 1.000001);
  }
  void hold(double seconds) {
    for (int i = 0; i < std::lround(1e3 * seconds); ++i) checked_tick();
  }
  double aside_m() { return -state().hand.position_m[2]; }  // y of the sample
};

TEST(GrooveOfAPlan, DrawsAHandToTheLineAndLetsGo) {
  GroovedBench bench;
  bench.arm(test::kMica, ScaleMode::Particles);
  bench.go(-0.010, 0.003, 0.040, 0.4);
  bench.hold(0.5);
  const double unguided_m = bench.aside_m();
  EXPECT_NEAR(unguided_m, 0.003, 2e-4);
  EXPECT_EQ(bench.samples.back().guide_n, (std::array<double, 2>{}));
  bench.renderer.store(plan_to(90e-9, 0.0));
  bench.hold(1.0);
  EXPECT_EQ(bench.samples.back().plan, plan_to(90e-9, 0.0));
  EXPECT_LT(bench.samples.back().guide_n[1], -0.05);
  EXPECT_NEAR(bench.samples.back().guide_n[0], 0.0, 1e-12);
  const double guided_m = bench.aside_m();
  EXPECT_LT(guided_m, 0.8 * unguided_m) << "a grip of 200 N/m gives way";
  bench.go(0.010, 0.003, 0.040, 1.0);
  EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
  bench.renderer.store(plan_to(90e-9, 0.0, false));
  bench.hold(1.0);
  EXPECT_NEAR(bench.aside_m(), unguided_m, 2e-4);
  EXPECT_EQ(bench.samples.back().guide_n, (std::array<double, 2>{}));
  EXPECT_EQ(bench.state().safety.excess_energy_j, 0.0);
}

TEST(GrooveOfAPlan, IsGoneWithTheForceAndBeginsAnewWithIt) {
  GroovedBench bench;
  bench.renderer.store(plan_to(90e-9, 0.0));
  bench.choose(test::kMica, ScaleMode::Particles);
  bench.go(-0.020, 0.003, 0.060, 0.4);
  bench.hold(1.0);
  EXPECT_EQ(bench.hand_force_n(), 0.0) << "without Turn-On";
  EXPECT_EQ(bench.samples.back().guide_n, (std::array<double, 2>{}));
  bench.arm(test::kMica, ScaleMode::Particles);
  bench.go(-0.020, 0.003, 0.040, 0.4);
  bench.hold(0.6);
  EXPECT_LT(bench.samples.back().guide_n[1], -0.05);
  bench.renderer.store(scene::Selection{
      .material = test::kMica, .revision = ++bench.selection, .scale_mode = ScaleMode::Particles, .release = 1});
  bench.hold(0.3);
  EXPECT_EQ(bench.hand_force_n(), 0.0);
  EXPECT_EQ(bench.samples.back().guide_n, (std::array<double, 2>{}));
  EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
}

TEST(GrooveOfAPlan, OfAnImpossiblePlanIsRefusedWhereItEnters) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  GroovedBench bench;
  bench.arm(test::kMica, ScaleMode::Particles);
  bench.go(-0.020, 0.003, 0.040, 0.4);
  PlannedPush of_none = plan_to(90e-9, 0.0);
  of_none.particle = 2;
  PlannedPush doubly = plan_to(90e-9, 0.0);
  doubly.guided = 2;
  PlannedPush headless;
  headless.guided = 1;
  const std::vector<PlannedPush> bad{plan_to(kNan, 0.0),
                                     plan_to(0.0, kInfinity),
                                     plan_to(-80e-9, 0.0),
                                     plan_to(2e-3, 0.0),
                                     plan_to(0.0, -1.0),
                                     of_none,
                                     doubly,
                                     headless};
  const std::uint32_t before = bench.state().garbage_blocks;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    bench.renderer.store(bad[i]);
    bench.hold(0.1);
    EXPECT_EQ(bench.state().garbage_blocks, before + i + 1) << i;
    EXPECT_EQ(bench.samples.back().plan, PlannedPush{}) << i;
    EXPECT_EQ(bench.samples.back().guide_n, (std::array<double, 2>{})) << i;
  }
  EXPECT_EQ(bench.state().fault, scene::FaultCode::None);
}

}  // namespace felt_groove_test
}  // namespace afm
