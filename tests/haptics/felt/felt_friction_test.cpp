// SPDX-License-Identifier: Apache-2.0
// Invariant: one count of an encoder's noise gives at most one slip a lattice step
// Invariant: without friction no bit of a force changes
#include "haptics/felt_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "haptics/contact_model.h"
#include "physics/friction/prandtl_tomlinson.h"
#include "servo_bench.h"
#include "support/no_alloc.h"
#include "support/samples/rough_surface.h"

namespace felt_friction_test {

using namespace afm;
using physics::FrictionLaw;
using scene::ScaleMode;
using test::model_of;

scene::SharedContact mica(FrictionLaw law) {
  scene::SharedContact material = test::paper_model().materials[test::kMica];
  material.law = physics::Law::Dmt;
  material.contact.reduced_modulus = physics::Pressure(5.15e10);
  material.friction = {.law = law,
                       .lattice = physics::LatticeKind::Hexagonal,
                       .coefficient = 0.1,
                       .shear_strength = physics::Pressure(1e8),
                       .period = physics::Length(0.52e-9),
                       .corrugation = physics::Length(5e-12),
                       .lateral_stiffness = physics::Stiffness(1.0)};
  return material;
}

constexpr std::array kLaws{FrictionLaw::Amontons, FrictionLaw::ContactArea, FrictionLaw::Lattice};

// Pressed by some 0.1 nN beyond the adhesion.
double on_sample(const haptics::ContactModel& model) { return model.scaling().hand_height_m(-1.1e-9); }

// Lifted, and put down at a place; the height of the hand there.
double put_down(haptics::ContactModel& model, const glm::dvec2& at_m = glm::dvec2(0.0)) {
  const double on_m = on_sample(model);
  for (double height_m = model.scaling().release_height_m() + 0.01; height_m > on_m; height_m -= 1e-4) {
    model.step({at_m, height_m});
  }
  model.step({at_m, on_m});
  EXPECT_EQ(model.phase(), physics::Phase::Attached);
  return on_m;
}

struct Drag {
  std::vector<glm::dvec3> force_n;  // at full milliseconds
  std::vector<glm::dvec2> slips_m;  // positions of the tip's holder
};

// Along x at a speed of the hand, in ticks of a rate; forces where the hand has gone a whole number of tenths of mm.
Drag drag(FrictionLaw law, double speed_m_per_s, double rate_hz, double way_m) {
  const auto model = model_of(mica(law));
  const double on_m = put_down(*model);
  Drag run;
  const auto ticks = static_cast<int>(std::llround(way_m / speed_m_per_s * rate_hz));
  int tenths = 0;
  for (int i = 1; i <= ticks; ++i) {
    const double x = way_m * i / ticks;
    const haptics::Touch touch = model->step({x, 0.2 * x, on_m});
    for (const auto& slip : touch.friction.events.slipped()) {
      run.slips_m.emplace_back(slip.support.x.si, slip.support.y.si);
    }
    if (std::abs(x - 1e-3 * (tenths + 1)) < 1e-9) {
      run.force_n.push_back(touch.hand_force_n);
      ++tenths;
    }
  }
  return run;
}

TEST(FeltFriction, IsTheSameAtEveryRateAndSpeed) {
  for (const FrictionLaw law : kLaws) {
    const Drag reference = drag(law, 0.001, 4000.0, 0.012);
    ASSERT_EQ(reference.force_n.size(), 12U);
    EXPECT_EQ(reference.slips_m.empty(), law != FrictionLaw::Lattice);
    for (const double speed : {0.001, 0.020, 0.050, 0.100, 0.200}) {
      for (const double rate : {1000.0, 2000.0, 4000.0}) {
        const Drag run = drag(law, speed, rate, 0.012);
        ASSERT_EQ(run.slips_m.size(), reference.slips_m.size()) << speed << " " << rate;
        for (std::size_t i = 0; i < run.slips_m.size(); ++i) {
          EXPECT_LT(glm::length(run.slips_m[i] - reference.slips_m[i]), 1e-16) << speed << " " << rate;
        }
        // a fast hand does not stop at every whole millimetre
        ASSERT_FALSE(run.force_n.empty());
        const glm::dvec3 last = run.force_n.back();
        EXPECT_LT(glm::length(last - reference.force_n.back()), 1e-7) << speed << " " << rate;
      }
    }
  }
}

// Every enumerator that chooses code in a tick: one without its code would end the servo here.
TEST(FeltFriction, StepsByEveryLawOnEveryLatticeUnderEveryLawOfForceAndScale) {
  std::size_t contacts = 0;
  for (const physics::LawTraits& law : physics::kLawTable) {
    for (const physics::FrictionLawText& friction : physics::kFrictionLaws) {
      scene::SharedContact material = mica(friction.law);
      material.law = law.law;
      if (!law.computed || law.law == physics::Law::Paper) continue;
      if (!scene::why_no_friction(friction.law, law.law, material.contact.reduced_modulus).empty()) continue;
      for (const physics::LatticeKindText& lattice : physics::kLatticeKinds) {
        if (friction.law != FrictionLaw::Lattice && lattice.kind != physics::LatticeKind::Rows) continue;
        material.friction.lattice = lattice.kind;
        const auto model = model_of(material);
        for (const scene::ScaleModeText& scale : scene::kScaleModes) {
          model->use(scale.mode);
          const double on_m = put_down(*model);
          const haptics::Touch touch = model->step({1e-3, 2e-3, on_m});
          ASSERT_TRUE(std::isfinite(glm::length(touch.hand_force_n))) << law.name << " " << friction.word;
          EXPECT_EQ(touch.friction.hand_force_n == glm::dvec3(0.0), friction.law == FrictionLaw::None) << friction.word;
          ++contacts;
        }
        model->use(ScaleMode::Fit);
      }
    }
  }
  EXPECT_GT(contacts, 80U);
}

// A hand over the lattice, read by an encoder of the Omni's resolution whose last count is noise.
class NoisyHand {
 public:
  explicit NoisyHand(std::uint64_t seed) : random_(seed) { model_->use(ScaleMode::Atoms); }

  void put_down() { on_m_ = felt_friction_test::put_down(*model_); }

  // The hand is at x for one tick; how often the tip slips.
  int read_at(double x_m, bool noise) {
    const double read_m = kCountM * (std::floor(x_m / kCountM) + (noise ? count_(random_) : 0));
    return static_cast<int>(model_->step({read_m, 0.0, on_m_}).friction.events.slip_count);
  }

 private:
  static constexpr double kCountM = 5.5e-5;
  std::unique_ptr<haptics::ContactModel> model_ = model_of(mica(FrictionLaw::Lattice));
  std::mt19937_64 random_;
  std::uniform_int_distribution<int> count_{-1, 0};
  double on_m_ = 0;
};

constexpr double kStrokeM = 0.038, kTickM = 2e-5;

// Places at which a hand without noise feels the slips.
std::vector<double> clean_slips_m() {
  NoisyHand hand(1);
  hand.put_down();
  std::vector<double> slips_m;
  for (double x = 0.0; x < kStrokeM; x += kTickM) {
    if (hand.read_at(x, false) > 0) slips_m.push_back(x);
  }
  return slips_m;
}

TEST(FeltFriction, SlipsOnceInEveryLatticeStepUnderOneCountOfNoise) {
  const std::vector<double> clean_m = clean_slips_m();
  ASSERT_GE(clean_m.size(), 15U);
  for (std::size_t i = 1; i < clean_m.size(); ++i) {
    ASSERT_NEAR(clean_m[i] - clean_m[i - 1], haptics::Scaling::kAtomM, 1.5e-4) << "a step of the lattice";
  }
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    NoisyHand hand(seed);
    hand.put_down();
    // a step goes from halfway between two slips to the next such place
    std::vector<int> slips(clean_m.size(), 0);
    for (double x = 0.0; x < clean_m.back() + 0.4 * haptics::Scaling::kAtomM; x += kTickM) {
      const auto steps = std::llround((x - clean_m.front()) / haptics::Scaling::kAtomM);
      slips[static_cast<std::size_t>(std::clamp<long long>(steps, 0, std::ssize(slips) - 1))] += hand.read_at(x, true);
    }
    for (std::size_t step = 0; step < slips.size(); ++step) EXPECT_EQ(slips[step], 1) << seed << ", step " << step;
  }
}

// Wherever it rests, also where one more count makes the tip slip: it does not chatter.
TEST(FeltFriction, SlipsAtMostOnceUnderAHandAtRestWithOneCountOfNoise) {
  const double from_m = clean_slips_m().at(4) - 0.5 * haptics::Scaling::kAtomM;
  for (int place = 0; place <= 40; ++place) {
    const double rest_m = from_m + haptics::Scaling::kAtomM * place / 40.0;
    NoisyHand hand(static_cast<std::uint64_t>(place));
    hand.put_down();
    for (double x = 0.0; x < rest_m; x += kTickM) hand.read_at(x, false);
    int slips = 0;
    for (int tick = 0; tick < 2000; ++tick) slips += hand.read_at(rest_m, true);
    EXPECT_LE(slips, 1) << place;
  }
}

TEST(FeltFriction, GoesWithTheLoad) {
  // less load than keeps eta above 1: the tip is pulled up nearly to where it lets go
  const auto model = model_of(mica(FrictionLaw::Lattice));
  const double on_m = put_down(*model);
  const double pull_off_m = model->scaling().hand_height_m(
      physics::build_law_tables(physics::Law::Dmt, mica(FrictionLaw::Lattice).contact)->figures.z_joc.si);
  const auto slips_at = [&](double height_m) {
    for (int i = 0; i <= 200; ++i) model->step({0.0, 0.0, on_m + (height_m - on_m) * i / 200.0});
    std::uint32_t slips = 0;
    for (int i = 1; i <= 800; ++i) slips += model->step({2.5e-5 * i, 0.0, height_m}).friction.events.slip_count;
    for (int i = 799; i >= 0; --i) model->step({2.5e-5 * i, 0.0, height_m});
    for (int i = 200; i >= 0; --i) model->step({0.0, 0.0, on_m + (height_m - on_m) * i / 200.0});
    return slips;
  };
  EXPECT_GE(slips_at(on_m), 8U);
  EXPECT_EQ(slips_at(pull_off_m - 0.10 * (pull_off_m - on_m)), 0U);
}

TEST(FeltFriction, IsNothingOffTheSampleAndBeginsAnewOnIt) {
  for (const FrictionLaw law : kLaws) {
    const auto model = model_of(mica(law));
    const double on_m = put_down(*model);
    for (int i = 1; i <= 100; ++i) model->step({1e-4 * i, 0.0, on_m});
    EXPECT_LT(model->step({0.0101, 0.0, on_m}).hand_force_n.x, -0.01);
    const haptics::Touch off = model->step({0.0101, 0.0, (model->scaling().release_height_m() + 0.01)});
    EXPECT_EQ(off.hand_force_n.x, 0.0);
    EXPECT_EQ(off.friction.lateral, physics::Sideways<physics::Force>{});
    put_down(*model, {0.0101, 0.0});
    const haptics::Touch again = model->step({0.0101, 0.0, on_m});
    if (law != FrictionLaw::Lattice) {
      EXPECT_NEAR(again.hand_force_n.x, 0.0, 1e-9);
    }
  }
}

TEST(FeltFriction, IsNoStifferThanItsShareOfTheDevice) {
  for (const FrictionLaw law : kLaws) {
    for (const double stiffness : {0.1, 1.0, 80.0}) {
      scene::SharedContact material = mica(law);
      material.friction.lateral_stiffness = physics::Stiffness(stiffness);
      for (const auto& row : scene::kScaleModes) {
        const auto model = model_of(material);
        model->use(row.mode);
        const double on_m = put_down(*model);
        const double before = model->step({0.0, 0.0, on_m}).hand_force_n.x;
        const double after = model->step({1e-7, 0.0, on_m}).hand_force_n.x;
        EXPECT_LE((before - after) / 1e-7, 0.5 * haptics::Scaling::kMaxStiffnessNPerM * 1.001) << row.word;
      }
    }
  }
}

// Without friction the force is that of the law along the gradient of the surface, and nothing is added to it: the same
// bits as by the formula that was here before friction was.
TEST(FeltFriction, OffLeavesEveryBitOfTheForce) {
  const auto rough = test::rough_model();
  const scene::SharedContact& material = rough.materials[test::kMica];
  const auto* drawn = &rough.height_fields[material.height_field];
  for (const ScaleMode mode : {ScaleMode::Common, ScaleMode::Fit, ScaleMode::Compressed}) {
    const auto model = model_of(material, drawn);
    model->use(mode);
    const haptics::Scaling& scale = model->scaling();
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> sideways(-0.03, 0.03), height(-0.01, 0.065);
    for (int i = 0; i < 5000; ++i) {
      const glm::dvec3 hand{sideways(random), sideways(random), height(random)};
      const haptics::Touch touch = model->step(hand);
      const auto below = model->surface().at(glm::dvec2(hand) / scale.hand_m_per_m());
      const glm::dvec3 force = scale.hand_force_n(touch.response.force.si) * glm::dvec3(-below.slope, 1.0);
      ASSERT_EQ(std::memcmp(&touch.hand_force_n, &force, sizeof force), 0) << i;
      ASSERT_EQ(touch.friction.lateral, physics::Sideways<physics::Force>{});
      ASSERT_EQ(std::bit_cast<std::uint64_t>(model->energy(touch).given_j), 0U);
    }
  }
}

// The energy of a thousand random walks of the hand in contact, up and down and sideways, on every scale: over a closed
// path the hand never gets more than the sampling of a spring gives.
TEST(FeltFriction, NeverGivesMoreThanASampledSpring) {
  std::mt19937_64 random(23);
  std::normal_distribution<double> gauss;
  for (const FrictionLaw law : kLaws) {
    for (const auto& row : scene::kScaleModes) {
      const auto rough = test::rough_model();
      const auto model = model_of(mica(law), &rough.height_fields[0]);
      model->use(row.mode);
      const double on_m = put_down(*model);
      haptics::PassivityObserver observer;
      glm::dvec3 hand(0.0, 0.0, on_m), velocity(0.0);
      haptics::Touch touch = model->step(hand);
      auto before = model->energy(touch);
      double lost = 0.0, largest = 0.0;
      for (int i = 0; i < 40'000; ++i) {
        velocity = 0.98 * velocity + 1e-5 * glm::dvec3{gauss(random), gauss(random), 0.3 * gauss(random)};
        glm::dvec3 next = hand + velocity;
        next.z = std::clamp(next.z, -0.010, 0.020);
        const glm::dvec3 force = touch.hand_force_n, moved = next - hand;
        touch = model->step(next);
        if (touch.response.phase != physics::Phase::Attached) break;
        const auto after = model->energy(touch);
        observer.integrate({.moved_m = moved,
                            .wanted_n = force,
                            .commanded_n = force,
                            .stored_rise_j = after.stored_j - after.given_j - before.stored_j,
                            .stiffness_n_per_m = before.stiffness_n_per_m});
        lost -= glm::dot(force, moved) + after.stored_j - before.stored_j;
        largest = std::max(largest, observer.excess_j());
        before = after;
        hand = next;
      }
      EXPECT_LT(largest, haptics::PassivityObserver::kToleranceJ) << row.word << " " << static_cast<int>(law);
      EXPECT_GT(lost, 0.0) << row.word;
    }
  }
}

TEST(FeltFriction, AllocatesNothingInATick) {
  for (const FrictionLaw law : kLaws) {
    const auto model = model_of(mica(law));
    const double on_m = put_down(*model);
    const test::NoAllocation none;
    for (int i = 0; i < 2000; ++i)
      model->step({1e-5 * i, 3e-6 * i, on_m + (i % 500 == 0 ? (model->scaling().release_height_m() + 0.01) : 0.0)});
  }
}

TEST(FeltFriction, ReportsItsSlipsAndForcesAndStaysPassive) {
  auto scene = test::paper_model();
  scene.materials[test::kMica] = mica(FrictionLaw::Lattice);
  test::ServoBench bench(scene);
  bench.arm(test::kMica, ScaleMode::Atoms);
  constexpr double kOnSample = -0.004;
  bench.move(kOnSample, 0.5);
  bench.run(0.2);
  const auto aim = [&](double x) {
    bench.renderer.store(
        scene::HandScript{.target_m = {x, kOnSample, 0.0}, .duration_s = 0.6, .revision = ++bench.script});
    bench.run(0.8);
  };
  aim(0.020);
  aim(-0.010);
  aim(0.020);
  const auto slips = std::count_if(bench.events.begin(), bench.events.end(),
                                   [](const auto& e) { return e.kind == physics::EventKind::Slip; });
  EXPECT_GE(slips, 20);
  EXPECT_EQ(bench.state().servo_state, scene::ServoState::Running);
  EXPECT_LT(bench.state().safety.excess_energy_j, haptics::PassivityObserver::kToleranceJ);
  double strongest = 0.0;
  for (const auto& sample : bench.samples) strongest = std::max(strongest, std::abs(sample.lateral_force_n[0]));
  EXPECT_GT(strongest, 1e-10);
  for (const auto& event : bench.events) {
    if (event.kind != physics::EventKind::Slip) continue;
    EXPECT_GT(event.force_before_n, 0.0);
    EXPECT_TRUE(std::isfinite(event.force_after_n));
  }
}

TEST(FeltFriction, IsRefusedForThePapersLawAndWhereThereIsNoArea) {
  scene::SharedContact paper = mica(FrictionLaw::Amontons);
  paper.law = physics::Law::Paper;
  EXPECT_FALSE(haptics::build_tables(paper, {}));
  scene::SharedContact hao = mica(FrictionLaw::ContactArea);
  hao.law = physics::Law::Hao;
  EXPECT_FALSE(haptics::build_tables(hao, {}));
  hao.friction.law = FrictionLaw::Lattice;
  EXPECT_TRUE(haptics::build_tables(hao, {}));
  scene::SharedContact rigid = mica(FrictionLaw::ContactArea);
  rigid.contact.reduced_modulus = physics::Pressure(HUGE_VAL);
  EXPECT_FALSE(haptics::build_tables(rigid, {}));
  scene::SharedContact unknown = mica(static_cast<FrictionLaw>(9));
  EXPECT_FALSE(haptics::build_tables(unknown, {}));
}

}  // namespace felt_friction_test
