// SPDX-License-Identifier: Apache-2.0
#include "haptics/scaling.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "haptics/simulated_device.h"
#include "physics/law_tables.h"

namespace {

using namespace afm::haptics;
using afm::physics::build_law_tables;
using afm::physics::Interaction;
using afm::physics::Law;
using afm::physics::LawTables;

constexpr double kRigid = std::numeric_limits<double>::infinity();

// R, k_c, k_s, A_H, sqrt(gamma_s gamma_t) of Liu & Peng, Table 1; a finite k_s in the last one.
Interaction interaction_of(double spring_constant, double sample_stiffness, double hamaker, double surface_energy) {
  return {.tip_radius = afm::physics::Length(50e-9),
          .spring_constant = afm::physics::Stiffness(spring_constant),
          .sample_stiffness = afm::physics::Stiffness(sample_stiffness),
          .hamaker = afm::physics::Energy(hamaker),
          .mean_surface_energy = afm::physics::SurfaceEnergy(surface_energy)};
}

Interaction mica(double spring_constant = 0.1) {
  Interaction in = interaction_of(spring_constant, kRigid, 24.5e-21, 2.228e-3);
  in.reduced_modulus.si = 51.5e9;
  return in;
}

// Soft and sticky: R = 1 um, E* = 2.7 MPa, W = 84 mJ/m^2.
Interaction pdms(double spring_constant) {
  Interaction in = interaction_of(spring_constant, kRigid, 86e-21, 42e-3);
  in.tip_radius.si = 1e-6;
  in.reduced_modulus.si = 2.7e6;
  return in;
}

class FitScalingOfThePapersLaw : public testing::TestWithParam<Interaction> {
 protected:
  const std::shared_ptr<const LawTables> tables_ = build_law_tables(Law::Paper, GetParam());
  const double f_ad_n_ = -tables_->figures.force_before_joc.si;
  const FitScaling scaling_ = *FitScaling::create(*tables_, SimulatedDevice().spec());
};

TEST_P(FitScalingOfThePapersLaw, FillsTheStrokeAndTheForceAtPullOff) {
  const double z_joc_m = tables_->figures.z_joc.si;
  EXPECT_NEAR(scaling_.z_m(0.050), z_joc_m, 1e-9 * z_joc_m);
  EXPECT_NEAR(scaling_.hand_force_n(-f_ad_n_), -2.0, 1e-12);
}

TEST_P(FitScalingOfThePapersLaw, FeelsTheSameSpringWhateverTheMaterial) {
  const Interaction& in = GetParam();
  const double series = 1.0 / (1.0 / in.spring_constant.si + 1.0 / in.sample_stiffness.si);  // (3.1)
  EXPECT_NEAR(series * scaling_.hand_n_per_n() / scaling_.hand_m_per_m(), 40.0, 1e-9);
}

TEST_P(FitScalingOfThePapersLaw, KeepsZeroAndSigns) {
  EXPECT_EQ(scaling_.hand_force_n(0.0), 0.0);
  EXPECT_EQ(scaling_.z_m(0.0), 0.0);
  EXPECT_LT(scaling_.hand_force_n(-1e-12), 0.0);
  EXPECT_GT(scaling_.hand_force_n(1e-12), 0.0);
}

TEST_P(FitScalingOfThePapersLaw, PushesMonotonelyNeverSteeperThanTheSpringAndBelowTheCap) {
  const double step_n = 1e-3 * f_ad_n_;
  double last_n = scaling_.hand_force_n(-f_ad_n_);
  for (double force_n = -f_ad_n_ + step_n; force_n < 20.0 * f_ad_n_; force_n += step_n) {
    const double hand_n = scaling_.hand_force_n(force_n);
    EXPECT_GE(hand_n, last_n);
    EXPECT_LE(hand_n - last_n, step_n * scaling_.hand_n_per_n() * (1 + 1e-6));
    EXPECT_LE(hand_n, 2.0);
    last_n = hand_n;
  }
  EXPECT_LE(scaling_.hand_force_n(1e30), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Materials, FitScalingOfThePapersLaw,
                         testing::Values(interaction_of(0.1, kRigid, 24.5e-21, 2.228e-3),
                                         interaction_of(0.1, kRigid, 120e-21, 15.915e-3),
                                         interaction_of(0.036, kRigid, 10e-21, 0.955e-3),
                                         interaction_of(0.1, 0.5, 24.5e-21, 2.228e-3)));

struct Felt {
  std::string name;
  Law law;
  Interaction interaction;
};

class FitScalingOfAnyLaw : public testing::TestWithParam<Felt> {
 protected:
  const DeviceSpec device_ = SimulatedDevice().spec();
  const std::shared_ptr<const LawTables> tables_ = build_law_tables(GetParam().law, GetParam().interaction);
  const FitScaling scaling_ = *FitScaling::create(*tables_, device_);

  double hand_n(const afm::physics::BranchTable& branch, double height_m) const {
    return scaling_.hand_force_n(branch.force(afm::physics::Length(scaling_.z_m(height_m))).si);
  }
};

TEST_P(FitScalingOfAnyLaw, StaysWithinTheCapAndTheSteepestSlopeAtEveryHeight) {
  constexpr double kStepM = 37e-6;  // no multiple of the step that the fit looks with
  const auto look = [&](const afm::physics::BranchTable& branch, double lowest_m, double highest_m) {
    for (double height_m = lowest_m; height_m + kStepM < highest_m; height_m += kStepM) {
      const double low_n = hand_n(branch, height_m), high_n = hand_n(branch, height_m + kStepM);
      ASSERT_LE(std::abs(low_n), force_cap_n(device_) * 1.001) << height_m;
      ASSERT_LE((low_n - high_n) / kStepM, FitScaling::kMaxStiffnessNPerM * 1.01) << height_m;
    }
  };
  look(tables_->free, std::max(-0.040, tables_->figures.z_jtc.si * scaling_.hand_m_per_m()), 0.080);
  look(tables_->attached, -0.040, std::min(0.080, tables_->figures.z_joc.si * scaling_.hand_m_per_m()));
}

TEST_P(FitScalingOfAnyLaw, LetsTheServoArmAboveTheStroke) {
  const double armed_m = FitScaling::kStrokeM + 0.005;
  EXPECT_LT(tables_->figures.z_joc.si, scaling_.z_m(armed_m));
  EXPECT_LT(std::abs(hand_n(tables_->free, armed_m)), 0.05);
}

TEST_P(FitScalingOfAnyLaw, IsFelt) {
  double strongest_n = 0.0;
  for (double height_m = -0.020; height_m < 0.050; height_m += 1e-4) {
    strongest_n = std::max({strongest_n, std::abs(hand_n(tables_->attached, height_m))});
  }
  EXPECT_GE(strongest_n, FitScaling::kFaintestPullN);
}

INSTANTIATE_TEST_SUITE_P(Laws, FitScalingOfAnyLaw,
                         testing::ValuesIn(std::vector<Felt>{{"Hao", Law::Hao, mica()},
                                                             {"Dmt", Law::Dmt, mica()},
                                                             {"DmtOnAStiffLever", Law::Dmt, mica(3.0)},
                                                             {"DmtWithoutHysteresis", Law::Dmt, mica(40.0)},
                                                             {"Jkr", Law::Jkr, pdms(1.0)},
                                                             {"JkrOnASoftLever", Law::Jkr, pdms(0.1)},
                                                             {"HertzOnPdms", Law::Hertz, pdms(1.0)},
                                                             {"HertzOnMica", Law::Hertz, mica()},
                                                             {"LennardJones", Law::LennardJones, mica()}}),
                         [](const auto& test) { return test.param.name; });

TEST(FitScaling, WithoutAPullGivesATenthOfTheRadiusTwentyMillimetres) {
  const auto tables = build_law_tables(Law::Hertz, pdms(1.0));
  const auto scaling = FitScaling::create(*tables, SimulatedDevice().spec());
  ASSERT_TRUE(scaling) << scaling.error().message;
  EXPECT_NEAR(scaling->z_m(-0.020), -100e-9, 1e-15);
  EXPECT_NEAR(scaling->hand_force_n(tables->attached.force(afm::physics::Length(-100e-9)).si), 1.5, 1e-9);
}

TEST(FitScaling, PullsLessOnADeviceWithLessForce) {
  DeviceSpec weak = SimulatedDevice().spec();
  weak.max_force_n = 1.0;
  const auto tables = build_law_tables(Law::Paper, mica());
  EXPECT_NEAR(FitScaling::create(*tables, weak)->hand_force_n(tables->figures.force_before_joc.si), -0.9, 1e-12);
  EXPECT_DOUBLE_EQ(force_cap_n(weak), 0.9);
}

TEST(FitScaling, PullsLessOnADeviceThatIsLessStiff) {
  DeviceSpec soft = SimulatedDevice().spec();
  soft.max_stiffness_n_per_m = 30.0;
  const auto tables = build_law_tables(Law::Paper, mica());
  // 30 N/m over 50 mm
  EXPECT_NEAR(FitScaling::create(*tables, soft)->hand_force_n(tables->figures.force_before_joc.si), -1.5, 1e-6);
}

TEST(FitScaling, RefusesADeviceThatCannotShowIt) {
  const auto tables = build_law_tables(Law::Paper, mica());
  DeviceSpec low = SimulatedDevice().spec();
  low.workspace_max_m.y = 0.049;
  EXPECT_THAT(FitScaling::create(*tables, low).error().message, testing::HasSubstr("reaches 49 mm"));
  DeviceSpec feeble = SimulatedDevice().spec();
  feeble.max_force_n = 0.01;
  EXPECT_THAT(FitScaling::create(*tables, feeble).error().message, testing::HasSubstr("too little to feel"));
}

TEST(FitScaling, RefusesAContactThatIsTooStiffToBeFelt) {
  DeviceSpec soft = SimulatedDevice().spec();
  soft.max_stiffness_n_per_m = 0.5;
  const auto tables = build_law_tables(Law::Paper, mica());
  EXPECT_THAT(FitScaling::create(*tables, soft).error().message, testing::HasSubstr("use a softer lever"));
}

}  // namespace
