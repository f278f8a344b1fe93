// SPDX-License-Identifier: Apache-2.0
// Invariant: on every scale a material stays within the device's cap and stiffness
#include "haptics/scaling.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "haptics/simulated_device.h"
#include "physics/law_tables.h"

namespace scaling_test {

using namespace afm::haptics;
using afm::physics::build_law_tables;
using afm::physics::ContactParameters;
using afm::physics::Law;
using afm::physics::LawTables;
using afm::scene::ScaleMode;

constexpr double kRigid = std::numeric_limits<double>::infinity();

// R, k_c, k_s, A_H, sqrt(gamma_s gamma_t) of Liu & Peng, Table 1; a finite k_s in the last one.
ContactParameters interaction_of(double spring_constant, double sample_stiffness, double hamaker,
                                 double surface_energy) {
  return {.tip_radius = afm::physics::Length(50e-9),
          .spring_constant = afm::physics::Stiffness(spring_constant),
          .sample_stiffness = afm::physics::Stiffness(sample_stiffness),
          .hamaker = afm::physics::Energy(hamaker),
          .mean_surface_energy = afm::physics::SurfaceEnergy(surface_energy)};
}

ContactParameters mica(double spring_constant = 0.1) {
  ContactParameters in = interaction_of(spring_constant, kRigid, 24.5e-21, 2.228e-3);
  in.reduced_modulus.si = 51.5e9;
  return in;
}

// Soft and sticky: R = 1 um, E* = 2.7 MPa, W = 84 mJ/m^2.
ContactParameters pdms(double spring_constant) {
  ContactParameters in = interaction_of(spring_constant, kRigid, 86e-21, 42e-3);
  in.tip_radius.si = 1e-6;
  in.reduced_modulus.si = 2.7e6;
  return in;
}

class FitScalingOfThePapersLaw : public testing::TestWithParam<ContactParameters> {
 protected:
  const std::shared_ptr<const LawTables> tables_ = build_law_tables(Law::Paper, GetParam());
  const double f_ad_n_ = -tables_->figures.force_before_joc.si;
  const Scaling scaling_ = *Scaling::fit(*tables_, SimulatedDevice().spec());
};

TEST_P(FitScalingOfThePapersLaw, FillsTheStrokeAndTheForceAtPullOff) {
  const double z_joc_m = tables_->figures.z_joc.si;
  EXPECT_NEAR(scaling_.z_m(0.050), z_joc_m, 1e-9 * z_joc_m);
  EXPECT_NEAR(scaling_.hand_force_n(-f_ad_n_), -2.0, 1e-12);
}

TEST_P(FitScalingOfThePapersLaw, FeelsTheSameSpringWhateverTheMaterial) {
  const ContactParameters& in = GetParam();
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
  ContactParameters contact;
};

Scaling scaling_of(ScaleMode mode, const std::shared_ptr<const LawTables>& tables, const DeviceSpec& device) {
  if (mode == ScaleMode::Fit) return *Scaling::fit(*tables, device);
  if (mode == ScaleMode::Compressed) return *Scaling::compressed(std::array{tables}, device);
  if (mode == ScaleMode::Atoms) return *Scaling::atoms(std::array{tables}, device, 0.246e-9);
  return *Scaling::common(*tables, device, *Scaling::common_scale(std::vector{tables}, device));
}

std::string name_of(const testing::TestParamInfo<std::tuple<Felt, ScaleMode>>& test) {
  std::string mode = afm::scene::text_of(std::get<ScaleMode>(test.param)).word;
  mode.front() = static_cast<char>(mode.front() - 'a' + 'A');
  return std::get<Felt>(test.param).name + mode;
}

class ScalingOfAnyLaw : public testing::TestWithParam<std::tuple<Felt, ScaleMode>> {
 protected:
  const Felt felt_ = std::get<Felt>(GetParam());
  const DeviceSpec device_ = SimulatedDevice().spec();
  const std::shared_ptr<const LawTables> tables_ = build_law_tables(felt_.law, felt_.contact);
  const Scaling scaling_ = scaling_of(std::get<ScaleMode>(GetParam()), tables_, device_);

  double hand_n(const afm::physics::BranchTable& branch, double height_m) const {
    return scaling_.hand_force_n(branch.force(afm::physics::Length(scaling_.z_m(height_m))).si);
  }
};

TEST_P(ScalingOfAnyLaw, StaysWithinTheCapAndTheSteepestSlopeAtEveryHeight) {
  constexpr double kStepM = 37e-6;  // not a multiple of the step used by the fit
  const auto look = [&](const afm::physics::BranchTable& branch, double lowest_m, double highest_m) {
    for (double height_m = lowest_m; height_m + kStepM < highest_m; height_m += kStepM) {
      const double low_n = hand_n(branch, height_m), high_n = hand_n(branch, height_m + kStepM);
      ASSERT_LE(std::abs(low_n), force_cap_n(device_) * 1.001) << height_m;
      ASSERT_LE((low_n - high_n) / kStepM, Scaling::kMaxStiffnessNPerM * 1.01) << height_m;
    }
  };
  look(tables_->free, std::max(-0.040, scaling_.hand_height_m(tables_->figures.z_jtc.si)), 0.080);
  look(tables_->attached, -0.040, std::min(0.080, scaling_.hand_height_m(tables_->figures.z_joc.si)));
}

TEST_P(ScalingOfAnyLaw, LetsTheServoArmAboveTheStroke) {
  const double armed_m = scaling_.release_height_m() + 0.005;
  EXPECT_LE(armed_m, 0.070);
  EXPECT_LT(tables_->figures.z_joc.si, scaling_.z_m(armed_m));
  EXPECT_LT(std::abs(hand_n(tables_->free, armed_m)), 0.05);
}

TEST_P(ScalingOfAnyLaw, IsFelt) {
  double strongest_n = 0.0;
  for (double height_m = scaling_.hand_height_m(0.0) - 0.020; height_m < 0.050; height_m += 1e-4) {
    strongest_n = std::max({strongest_n, std::abs(hand_n(tables_->attached, height_m))});
  }
  EXPECT_GE(strongest_n, Scaling::kFaintestPullN);
}

TEST_P(ScalingOfAnyLaw, KeepsZeroIsMonotoneAndOddBelowTheKnee) {
  EXPECT_EQ(scaling_.hand_force_n(0.0), 0.0);
  const double pull_n = std::max(strongest_pull_n(*tables_), 1e-10);
  double last_n = scaling_.hand_force_n(-pull_n);
  for (double force_n = -pull_n; force_n < 5.0 * pull_n; force_n += 1e-3 * pull_n) {
    const double hand_n = scaling_.hand_force_n(force_n);
    ASSERT_GE(hand_n, last_n);
    if (std::abs(hand_n) < 0.74 * force_cap_n(device_)) {
      ASSERT_NEAR(scaling_.hand_force_n(-force_n), -hand_n, 1e-12);
    }
    last_n = hand_n;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, ScalingOfAnyLaw,
    testing::Combine(testing::ValuesIn(std::vector<Felt>{{"Paper", Law::Paper, mica()},
                                                         {"Hao", Law::Hao, mica()},
                                                         {"Dmt", Law::Dmt, mica()},
                                                         {"DmtOnAStiffLever", Law::Dmt, mica(3.0)},
                                                         {"DmtWithoutHysteresis", Law::Dmt, mica(40.0)},
                                                         {"Jkr", Law::Jkr, pdms(1.0)},
                                                         {"JkrOnASoftLever", Law::Jkr, pdms(0.1)},
                                                         {"HertzOnPdms", Law::Hertz, pdms(1.0)},
                                                         {"HertzOnMica", Law::Hertz, mica()},
                                                         {"LennardJones", Law::LennardJones, mica()}}),
                     testing::Values(ScaleMode::Common, ScaleMode::Fit, ScaleMode::Compressed, ScaleMode::Atoms)),
    name_of);

// ---- the paper's three materials on an Omni: Liu & Peng, Table 1, through (3.4) to (3.10) ----

struct FeltEvents {
  double hand_mm_per_nm, snap_n, snap_mm, pull_n, pull_mm;
};

class PapersMaterials : public testing::Test {
 protected:
  const DeviceSpec omni_ = omni_like("an Omni");
  const std::vector<std::shared_ptr<const LawTables>> tables_{
      build_law_tables(Law::Paper, mica()),
      build_law_tables(Law::Paper, interaction_of(0.1, kRigid, 120e-21, 15.915e-3)),
      build_law_tables(Law::Paper, interaction_of(0.036, kRigid, 10e-21, 0.955e-3))};
  const CommonScale common_ = *Scaling::common_scale(tables_, omni_);

  // Force on the hand just after the snap-in and just before the pull-off, and how far above Z = 0 that is.
  static FeltEvents felt(const LawTables& tables, const Scaling& scaling) {
    const auto& figures = tables.figures;
    return {.hand_mm_per_nm = 1e-6 * scaling.hand_m_per_m(),
            .snap_n = -scaling.hand_force_n(figures.force_after_jtc.si),
            .snap_mm = 1e3 * figures.z_jtc.si * scaling.hand_m_per_m(),
            .pull_n = -scaling.hand_force_n(figures.force_before_joc.si),
            .pull_mm = 1e3 * figures.z_joc.si * scaling.hand_m_per_m()};
  }

  static void expect(const FeltEvents& felt, const FeltEvents& expected) {
    EXPECT_NEAR(felt.hand_mm_per_nm, expected.hand_mm_per_nm, 1e-3 * expected.hand_mm_per_nm);
    EXPECT_NEAR(felt.snap_n, expected.snap_n, 1e-3 * expected.snap_n);
    EXPECT_NEAR(felt.snap_mm, expected.snap_mm, 1e-3 * expected.snap_mm);
    EXPECT_NEAR(felt.pull_n, expected.pull_n, 1e-3 * expected.pull_n);
    EXPECT_NEAR(felt.pull_mm, expected.pull_mm, 1e-3 * expected.pull_mm);
  }
};

TEST_F(PapersMaterials, OnTheCommonScaleAreEightTenthsOfAMillimetreAndTwoTenthsOfANewton) {
  EXPECT_NEAR(common_.hand_m_per_m, 0.8e6, 1e-3 * 0.8e6);
  EXPECT_NEAR(common_.hand_n_per_n, 0.20e9, 1e-3 * 0.20e9);
  // 0.8 mm and 0.20 N times the table of events
  const FeltEvents expected[] = {{0.8, 0.04796, 1.918, 0.2800, 11.199},
                                 {0.8, 0.08144, 3.257, 2.0000, 80.0},
                                 {0.8, 0.01800, 2.000, 0.1200, 13.334}};
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const Scaling scaling = *Scaling::common(*tables_[i], omni_, common_);
    expect(felt(*tables_[i], scaling), expected[i]);
    EXPECT_DOUBLE_EQ(scaling.hand_n_per_n(), common_.hand_n_per_n);
  }
}

TEST_F(PapersMaterials, OnTheCommonScaleFitTheWorkspaceWithRoomToPushAndToRecoil) {
  for (const auto& tables : tables_) {
    const Scaling scaling = *Scaling::common(*tables, omni_, common_);
    EXPECT_NEAR(scaling.hand_height_m(0.0), -0.020, 1e-12);
    EXPECT_LE(scaling.release_height_m(), 0.060 + 1e-12);
    EXPECT_NEAR(scaling.release_z_m(), tables->figures.z_joc.si, 1e-12 * tables->figures.z_joc.si);
  }
}

TEST_F(PapersMaterials, FittedAreFeltButForGoldsSnap) {
  const FeltEvents expected[] = {
      {3.5717, 0.34257, 8.563, 2.0, 50.0}, {0.50002, 0.08144, 2.0358, 2.0, 50.0}, {2.9998, 0.30000, 7.500, 2.0, 50.0}};
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const FeltEvents events = felt(*tables_[i], *Scaling::fit(*tables_[i], omni_));
    expect(events, expected[i]);
    if (i != 1) {
      EXPECT_GE(events.snap_n, 0.2999);
    }
  }
}

TEST_F(PapersMaterials, CompressedAreAllFeltWithoutBeingTooStiff) {
  // mica and silicon nitride with F0 = F_attr / 2; gold with as much more as 400 N/m asks for
  const FeltEvents expected[] = {
      {3.5717, 0.9163, 8.563, 2.0, 50.0}, {0.50002, 0.6072, 2.0358, 2.0, 50.0}, {2.9998, 0.8794, 7.500, 2.0, 50.0}};
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const FeltEvents events = felt(*tables_[i], *Scaling::compressed(std::array{tables_[i]}, omni_));
    expect(events, expected[i]);
    EXPECT_GE(events.snap_n, 0.6);
    EXPECT_LE(events.pull_n, 2.0 * (1 + 1e-12));
  }
}

TEST_F(PapersMaterials, ShareAScaleThatTheSoftestDeviceTolerates) {
  DeviceSpec soft = omni_;
  soft.max_stiffness_n_per_m = 5.0;
  const CommonScale scale = *Scaling::common_scale(tables_, soft);
  // 0.1 N/m on mica and gold; 0.8 mm/nm
  EXPECT_NEAR(scale.hand_n_per_n, 5.0 * 0.8e6 / 0.1, 1e-3 * 4e7);
}

TEST_F(PapersMaterials, AMaterialThatWasChangedTakesLessOfTheScaleOnlyIfItMust) {
  ContactParameters sticky = interaction_of(0.1, kRigid, 120e-21, 15.915e-3);
  EXPECT_DOUBLE_EQ(Scaling::common(*build_law_tables(Law::Paper, mica(0.2)), omni_, common_)->hand_m_per_m(),
                   common_.hand_m_per_m);
  sticky.mean_surface_energy.si *= 2.0;
  const auto tables = build_law_tables(Law::Paper, sticky);
  const Scaling scaling = *Scaling::common(*tables, omni_, common_);
  EXPECT_NEAR(scaling.hand_m_per_m(), 0.4e6, 1e-3 * 0.4e6);
  EXPECT_NEAR(scaling.hand_force_n(tables->figures.force_before_joc.si), -2.0, 1e-9);
}

TEST(FitScaling, WithoutAPullGivesATenthOfTheRadiusTwentyMillimetres) {
  const auto tables = build_law_tables(Law::Hertz, pdms(1.0));
  const auto scaling = Scaling::fit(*tables, SimulatedDevice().spec());
  ASSERT_TRUE(scaling) << scaling.error().message;
  EXPECT_NEAR(scaling->z_m(-0.020), -100e-9, 1e-15);
  EXPECT_NEAR(scaling->hand_force_n(tables->attached.force(afm::physics::Length(-100e-9)).si), 1.5, 1e-9);
}

TEST(FitScaling, PullsLessOnADeviceWithLessForce) {
  DeviceSpec weak = SimulatedDevice().spec();
  weak.max_force_n = 1.0;
  const auto tables = build_law_tables(Law::Paper, mica());
  EXPECT_NEAR(Scaling::fit(*tables, weak)->hand_force_n(tables->figures.force_before_joc.si), -0.9, 1e-12);
  EXPECT_DOUBLE_EQ(force_cap_n(weak), 0.9);
}

TEST(FitScaling, PullsLessOnADeviceThatIsLessStiff) {
  DeviceSpec soft = SimulatedDevice().spec();
  soft.max_stiffness_n_per_m = 30.0;
  const auto tables = build_law_tables(Law::Paper, mica());
  // 30 N/m over 50 mm
  EXPECT_NEAR(Scaling::fit(*tables, soft)->hand_force_n(tables->figures.force_before_joc.si), -1.5, 1e-6);
}

TEST(FitScaling, RefusesADeviceThatCannotShowIt) {
  const auto tables = build_law_tables(Law::Paper, mica());
  DeviceSpec low = SimulatedDevice().spec();
  low.workspace_max_m.y = 0.049;
  EXPECT_THAT(Scaling::fit(*tables, low).error().message, testing::HasSubstr("its reach is 49 mm"));
  DeviceSpec feeble = SimulatedDevice().spec();
  feeble.max_force_n = 0.01;
  EXPECT_THAT(Scaling::fit(*tables, feeble).error().message, testing::HasSubstr("too little to feel"));
}

TEST(FitScaling, RefusesAContactThatIsTooStiffToBeFelt) {
  DeviceSpec soft = SimulatedDevice().spec();
  soft.max_stiffness_n_per_m = 0.5;
  const auto tables = build_law_tables(Law::Paper, mica());
  EXPECT_THAT(Scaling::fit(*tables, soft).error().message, testing::HasSubstr("use a softer lever"));
}

TEST(AtomsScaling, GivesAnAtomTheSameWidthInTheHandWhateverTheMaterial) {
  const DeviceSpec device = SimulatedDevice().spec();
  for (const double period_m : {0.246e-9, 0.288e-9, 0.52e-9}) {
    const auto tables = build_law_tables(Law::Dmt, mica(0.02));
    const Scaling fit = *Scaling::fit(*tables, device), atoms = *Scaling::atoms(std::array{tables}, device, period_m);
    EXPECT_NEAR(atoms.lateral_m_per_m() * period_m, 0.0019, 1e-12);
    EXPECT_EQ(atoms.hand_m_per_m(), fit.hand_m_per_m());
    EXPECT_EQ(atoms.hand_n_per_n(), fit.hand_n_per_n());
    EXPECT_NEAR(atoms.flattening(), fit.hand_m_per_m() / atoms.lateral_m_per_m(), 1e-15);
    EXPECT_EQ(fit.flattening(), 1.0);
  }
  // a scale that is larger already stays
  const auto tables = build_law_tables(Law::Dmt, mica(3.0));
  EXPECT_EQ(Scaling::atoms(std::array{tables}, device, 5e-9)->lateral_m_per_m(),
            Scaling::fit(*tables, device)->hand_m_per_m());
}

}  // namespace scaling_test
