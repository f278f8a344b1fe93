// SPDX-License-Identifier: Apache-2.0
#include "physics/force_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/curve_analysis.h"

namespace afm::physics {
namespace force_curve_test {

using namespace literals;
using testing::HasSubstr;

const Stiffness kRigid(std::numeric_limits<double>::infinity());
const ContactParameters kMica{50_nm, 0.1_N_per_m, kRigid, 24.5_zJ, 2.228_mJ_per_m2};
const ContactParameters kSoft{50_nm, 0.1_N_per_m, 0.2_N_per_m, 24.5_zJ, 2.228_mJ_per_m2};

TEST(Sweep, VisitsItsEndsAndEveryStep) {
  const SweepPlan plan{20_nm, -5_nm, 0.01_nm};
  ASSERT_EQ(sample_count(plan), 5001U);
  EXPECT_EQ(sample_z(plan, 0), 20_nm);
  EXPECT_EQ(sample_z(plan, 2500), -5_nm);
  EXPECT_EQ(sample_z(plan, 5000), 20_nm);
  EXPECT_EQ(sample_z(plan, 100), sample_z(plan, 4900));
}

TEST(Sweep, EndsExactlyEvenIfTheStepDoesNotFit) {
  const SweepPlan plan{10_nm, 0_nm, 3_nm};
  ASSERT_EQ(sample_count(plan), 9U);
  EXPECT_NEAR(sample_z(plan, 3).si, 1e-9, 1e-21);
  EXPECT_EQ(sample_z(plan, 4), 0_nm);
}

TEST(Sweep, HasThreeSamplesIfTheStepIsLongerThanItself) { EXPECT_EQ(sample_count({10_nm, 0_nm, 1_um}), 3U); }

// the range is smaller than the tolerated rounding error of so long a step
TEST(Sweep, HasItsEndsHoweverLongTheStepIs) { EXPECT_EQ(sample_count({10_nm, 0_nm, Length(1e3)}), 3U); }

std::string refusal(const SweepPlan& plan) {
  try {
    sample_count(plan);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Sweep, RefusesWhatCannotBeSwept) {
  EXPECT_THAT(refusal({1_nm, 2_nm, 1_pm}), HasSubstr("its end 2 nm is not below its start 1 nm"));
  EXPECT_THAT(refusal({1_nm, 1_nm, 1_pm}), HasSubstr("is not below"));
  EXPECT_THAT(refusal({2_nm, 1_nm, 0_pm}), HasSubstr("is not positive"));
  EXPECT_THAT(refusal({2_nm, 1_nm, -1_pm}), HasSubstr("is not positive"));
  EXPECT_THAT(refusal({2_nm, 1_nm, Length(std::nan(""))}), HasSubstr("is not finite"));
  EXPECT_THAT(refusal({Length(HUGE_VAL), 1_nm, 1_pm}), HasSubstr("is not finite"));
  EXPECT_THAT(refusal({20_nm, -5_nm, Length(5e-17)}), HasSubstr("more than 10000000 samples: take a larger step"));
  EXPECT_THAT(refusal({20_nm, -5_nm, Length(5e-324)}), HasSubstr("take a larger step"));
}

class Step : public testing::TestWithParam<double> {};

TEST_P(Step, DoesNotChangeExtremesAndLoopEnergy) {
  for (const ContactParameters& contact : {kMica, kSoft}) {
    const ApproachRetractModel model(contact);
    const CycleFigures& figures = model.figures();
    const auto curve = record_curve(model, {1.1 * figures.z_joc, -5_nm, Length(GetParam() * 1e-9)});
    const CurveSummary summary = summarise(curve.samples);
    EXPECT_NEAR(summary.approach.force / figures.force_after_jtc, 1.0, 1e-12);
    EXPECT_NEAR(summary.approach.z / figures.z_jtc, 1.0, 1e-12);
    EXPECT_NEAR(summary.retract.force / figures.force_before_joc, 1.0, 1e-12);
    EXPECT_NEAR(summary.retract.z / figures.z_joc, 1.0, 1e-12);
    EXPECT_NEAR(summary.loop_energy / figures.loop_energy, 1.0, 1e-9);
    EXPECT_EQ(curve.events.size(), 2U);
  }
}

// For a nonlinear law the area of a curve is as accurate as its step; its extremes are exact.
TEST(ForceCurve, OfAnyLawHoldsItsFigures) {
  ContactParameters contact = kMica;
  contact.reduced_modulus = 51.5_GPa;
  for (const Law law : {Law::Hao, Law::Dmt, Law::MaugisDugdale, Law::Jkr}) {
    const ApproachRetractModel model(build_law_tables(law, contact));
    const CycleFigures& figures = model.figures();
    const auto curve = record_curve(model, {1.1 * figures.z_joc, -5_nm, 0.005_nm});
    const CurveSummary summary = summarise(curve.samples);
    ASSERT_EQ(curve.events.size(), 2U) << name_of(law);
    EXPECT_NEAR(summary.approach.force / figures.force_after_jtc, 1.0, 1e-12) << name_of(law);
    EXPECT_NEAR(summary.retract.force / figures.force_before_joc, 1.0, 1e-4) << name_of(law);
    EXPECT_NEAR(summary.loop_energy / figures.loop_energy, 1.0, 1e-4) << name_of(law);
  }
}

INSTANTIATE_TEST_SUITE_P(ForceCurve, Step, testing::Values(0.001, 0.01, 0.37, 1.0, 7.0, 1000.0),
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

TEST(ForceCurve, ShowsEachJumpAsTwoRowsAtOnePlace) {
  const auto curve = record_curve(ApproachRetractModel(kMica), {20_nm, -5_nm, 1_nm});
  std::vector<CurveSample> jumps;
  std::copy_if(curve.samples.begin(), curve.samples.end(), std::back_inserter(jumps),
               [](const CurveSample& sample) { return sample.event.has_value(); });
  ASSERT_EQ(jumps.size(), 4U);
  EXPECT_EQ(jumps[0].z, jumps[1].z);
  EXPECT_EQ(jumps[0].force, 0_nN);
  EXPECT_NEAR(jumps[1].force.si, -2.39752348708e-10, 1e-20);
  EXPECT_EQ(jumps[1].branch, Branch::Approach);
  EXPECT_EQ(jumps[2].z, jumps[3].z);
  EXPECT_NEAR(jumps[2].force.si, -1.39989368644e-9, 1e-19);
  EXPECT_EQ(jumps[3].force, 0_nN);
  EXPECT_EQ(jumps[3].branch, Branch::Retract);
}

TEST(ForceCurve, BeginsFreeWhereTheTipHasNeverTouched) {
  // 10 nm lies inside the band of mica: the tip comes from above, so it is free there, and still holds on the way back
  const auto curve = record_curve(ApproachRetractModel(kMica), {10_nm, -5_nm, 0.1_nm});
  EXPECT_EQ(curve.samples.front().phase, Phase::Free);
  EXPECT_EQ(curve.samples.back().phase, Phase::Attached);
  ASSERT_EQ(curve.events.size(), 1U);
}

TEST(ForceCurve, RefusesToBeginInContact) {
  EXPECT_THROW(record_curve(ApproachRetractModel(kMica), {2_nm, -5_nm, 0.1_nm}), std::invalid_argument);
}

TEST(ForceCurve, NeedsNoJumpAtAll) {
  const auto curve = record_curve(ApproachRetractModel(kMica), {20_nm, 3_nm, 0.1_nm});
  const CurveSummary summary = summarise(curve.samples);
  EXPECT_TRUE(curve.events.empty());
  EXPECT_EQ(summary.loop_energy.si, 0.0);
  EXPECT_EQ(summary.approach.force, 0_nN);
}

TEST(ForceCurve, OfTheDirectionRuleLooksRightAndEndsOneStepEarly) {
  const DirectionRuleModel rule(kMica);
  const auto curve = record_curve(rule, {20_nm, -5_nm, 0.5_nm});
  ASSERT_EQ(curve.events.size(), 2U);
  // jumps lie at samples, so that the extremes fall short: the defect of the paper's simulation column
  const CurveSummary summary = summarise(curve.samples);
  EXPECT_LT(abs(summary.approach.force), abs(rule.figures().force_after_jtc));
}

}  // namespace force_curve_test
}  // namespace afm::physics
