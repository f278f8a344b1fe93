// SPDX-License-Identifier: Apache-2.0
#include "physics/curve_analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "physics/contact.h"
#include "physics/law_tables.h"
#include "physics/measured_branches.h"

namespace afm::physics {
namespace curve_analysis_test {

using namespace literals;
using testing::HasSubstr;

const Stiffness kRigid(std::numeric_limits<double>::infinity());
const ContactParameters kMica{50_nm, 0.1_N_per_m, kRigid, 24.5_zJ, 2.228_mJ_per_m2};
const ContactParameters kGold{50_nm, 0.1_N_per_m, kRigid, 120_zJ, 15.915_mJ_per_m2};
const ContactParameters kSiliconNitride{50_nm, 0.036_N_per_m, kRigid, 10_zJ, 0.955_mJ_per_m2};
const ContactParameters kSoft{50_nm, 0.1_N_per_m, 0.2_N_per_m, 24.5_zJ, 2.228_mJ_per_m2};

std::vector<CurvePoint> simulated(const ContactParameters& contact, Length step) {
  const Length z_joc = approach_retract_events(contact).z_joc;
  return points_of(record_curve(ApproachRetractModel(contact), {1.5 * z_joc, -0.4 * z_joc, step}).samples);
}

// A sphere on an elastic half-space without adhesion, on a lever: Z = -delta - F/k_c, F = coefficient delta^1.5.
std::vector<CurvePoint> hertz(double coefficient, Stiffness lever, Length deepest, Length far, std::size_t count) {
  std::vector<CurvePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    const Length indentation = deepest - share * (deepest + far);
    if (indentation.si < 0) {
      points.push_back({-indentation, Force(), Branch::Retract});
    } else {
      const Force force(coefficient * std::pow(indentation.si, 1.5));
      points.push_back({-indentation - force / lever, force, Branch::Retract});
    }
  }
  std::vector<CurvePoint> cycle(points.rbegin(), points.rend());
  for (CurvePoint& point : cycle) point.branch = Branch::Approach;
  cycle.insert(cycle.end(), points.begin(), points.end());
  return cycle;
}

// Points with an instrument's errors: an unknown zero of the height, an offset and a drift of the force, and noise.
std::vector<CurvePoint> as_measured(std::vector<CurvePoint> points, Length shift, Force offset, Stiffness tilt,
                                    Force noise) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (CurvePoint& point : points) {
    point.force = point.force + offset + tilt * point.z + normal(random) * noise;
    point.z = point.z + shift;
  }
  return points;
}

class PaperCurve : public testing::TestWithParam<ContactParameters> {};

TEST_P(PaperCurve, GivesTheFiguresOfItsModelBack) {
  const auto expected = approach_retract_events(GetParam());
  const CurveFeatures found = analyse(simulated(GetParam(), 0.01_nm));
  ASSERT_TRUE(found.contact_point && found.snap_in && found.pull_off && found.contact_slope);
  EXPECT_EQ(found.baseline.level, Force());
  EXPECT_NEAR(found.contact_point->si / expected.z_jtc.si, 0.0, 1e-9);
  EXPECT_NEAR(found.snap_in->z / expected.z_jtc, 1.0, 1e-9);
  EXPECT_EQ(found.snap_in->force_before, Force());
  EXPECT_NEAR(found.snap_in->force_after / expected.f_attr, -1.0, 1e-9);
  EXPECT_NEAR(found.pull_off->z / expected.z_joc, 1.0, 1e-9);
  EXPECT_NEAR(found.pull_off->force / expected.f_ad, -1.0, 1e-9);
  EXPECT_NEAR(*found.contact_slope / expected.effective_stiffness, 1.0, 1e-9);
  EXPECT_NEAR(found.loop_energy / expected.loop_energy, 1.0, 1e-9);
  // whole area below the zero line: the triangle under the contact line
  EXPECT_NEAR(found.adhesion_energy / (0.5 * expected.f_ad * expected.z_joc), 1.0, 1e-6);
}

// Van der Waals reaches so far that a line through the outermost fifth would lean on it.
TEST(CurveAnalysis, TakesNoAttractionForTiltWhereTheZeroIsTrue) {
  ContactParameters mica = kMica;
  mica.reduced_modulus = 60_GPa;
  const ApproachRetractModel model(build_law_tables(Law::Dmt, mica));
  const auto points = points_of(record_curve(model, {20_nm, -5_nm, 0.01_nm}).samples);
  const CurveFeatures found = analyse(points, ForceZero::True);
  ASSERT_TRUE(found.snap_in && found.pull_off);
  const Force deepest = std::min_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
                          return a.force < b.force;
                        })->force;
  EXPECT_EQ(found.pull_off->force, deepest);
  const CycleFigures& figures = model.figures();
  EXPECT_NEAR(found.snap_in->z / figures.z_jtc, 1.0, 0.005);
  EXPECT_NEAR(found.snap_in->force_before / figures.force_before_jtc, 1.0, 0.05);
  // same curve with another zero of the instrument
  const auto leaning = analyse(points);
  EXPECT_GT(abs(leaning.snap_in->force_after - found.snap_in->force_after), 0.005 * abs(found.snap_in->force_after));
}

TEST_P(PaperCurve, GivesThemBackThroughOffsetDriftAndNoise) {
  const auto expected = approach_retract_events(GetParam());
  const Force noise = 0.01 * expected.f_ad;
  const Length shift = 12.3_um;
  const auto found = analyse(as_measured(simulated(GetParam(), 0.01 * expected.z_jtc), shift, 3_nN,
                                         0.02 * expected.effective_stiffness, noise));
  ASSERT_TRUE(found.contact_point && found.snap_in && found.pull_off && found.contact_slope);
  EXPECT_NEAR(found.baseline.tilt / expected.effective_stiffness, 0.02, 0.001);
  EXPECT_NEAR(found.baseline.noise / noise, 1.0, 0.1);
  // lever's displacement that exceeds the noise
  const Length blur = noise / expected.effective_stiffness;
  EXPECT_NEAR((*found.contact_point - shift) / blur, 0.0, 3.0);
  EXPECT_NEAR((found.snap_in->z - shift - expected.z_jtc) / blur, 0.0, 3.0);
  EXPECT_NEAR((found.snap_in->force_after + expected.f_attr) / noise, 0.0, 5.0);
  EXPECT_NEAR((found.pull_off->force + expected.f_ad) / noise, 0.0, 5.0);
  EXPECT_NEAR((found.pull_off->z - shift - expected.z_joc) / blur, 0.0, 6.0);
  EXPECT_NEAR(*found.contact_slope / expected.effective_stiffness, 1.0, 0.02);
  EXPECT_NEAR(found.loop_energy / expected.loop_energy, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(CurveAnalysis, PaperCurve, testing::Values(kMica, kGold, kSiliconNitride, kSoft),
                         [](const auto& test) { return "Material" + std::to_string(test.index); });

TEST(CurveAnalysis, FindsNeitherSnapInNorPullOffWithoutAdhesion) {
  const auto found = analyse(hertz(12.0, 0.05_N_per_m, 500_nm, 2_um, 1000));
  ASSERT_TRUE(found.contact_point);
  EXPECT_NEAR(found.contact_point->si, 0.0, 15e-9);  // tolerance of 3 % of the indentation
  EXPECT_FALSE(found.contact_doubtful);
  EXPECT_FALSE(found.snap_in);
  EXPECT_FALSE(found.pull_off);
  EXPECT_NEAR(found.loop_energy / (found.greatest_push * 500_nm), 0.0, 1e-9);
  EXPECT_EQ(found.adhesion_energy, Energy());
}

// A stiff lever jumps off far beyond the hardest pull: `curve --json` and analyse() mean the same place and force.
TEST(CurveAnalysis, HasThePullOffOfTheModelWhereThatIsNotTheHardestPull) {
  const ContactParameters stiff{50_nm, 5_N_per_m, kRigid, 100_zJ, 50_mJ_per_m2, 1_GPa};
  const ApproachRetractModel model(build_law_tables(Law::Jkr, stiff));
  const CycleFigures& figures = model.figures();
  ASSERT_TRUE(figures.hysteretic);
  const Length far = 2.0 * figures.z_joc;
  const auto found = analyse(points_of(record_curve(model, {far, -far, 0.001 * far}).samples), ForceZero::True);
  ASSERT_TRUE(found.pull_off && found.adhesion);
  EXPECT_NEAR(found.pull_off->force / figures.force_before_joc, 1.0, 1e-9);
  EXPECT_NEAR(found.pull_off->z / figures.z_joc, 1.0, 1e-9);
  EXPECT_LT(found.adhesion->force, 1.003 * found.pull_off->force);
}

TEST(CurveAnalysis, HasThePullOffWhereTheLastOfSeveralBondsBreaks) {
  std::vector<CurvePoint> points;
  for (int i = 0; i <= 1000; ++i)
    points.push_back({Length(500e-9 - 1e-9 * i), std::max(Force(), Force(1e-11 * (i - 500))), Branch::Approach});
  for (int i = 1000; i >= 0; --i) {
    const double up_nm = 500 - i;
    const Force pull(up_nm < -100 ? 1e-11 * -up_nm : up_nm < 100 ? -5e-9 : up_nm < 200 ? -2e-9 : 0.0);
    points.push_back({Length(1e-9 * up_nm), pull, Branch::Retract});
  }
  const auto found = analyse(points);
  ASSERT_TRUE(found.pull_off && found.adhesion);
  EXPECT_NEAR(found.pull_off->force / 1_nN, -2.0, 1e-3);
  EXPECT_NEAR(found.pull_off->z / 1_nm, 199.0, 1.5);
  EXPECT_NEAR(found.adhesion->force / 1_nN, -5.0, 1e-3);
}

TEST(CurveAnalysis, FindsNoFeatureInNoise) {
  std::vector<CurvePoint> flat;
  for (int i = 0; i < 1000; ++i) {
    const double height = i < 500 ? 500 - i : i - 500;
    flat.push_back({Length(height * 1e-9), Force(), i < 500 ? Branch::Approach : Branch::Retract});
  }
  const auto found = analyse(as_measured(flat, 0_nm, 1_nN, 0.001_N_per_m, 0.01_nN));
  EXPECT_FALSE(found.contact_point);
  EXPECT_FALSE(found.snap_in);
  EXPECT_FALSE(found.pull_off);
  EXPECT_FALSE(found.contact_slope);
}

TEST(CurveAnalysis, DoesWithoutARetract) {
  auto points = simulated(kMica, 0.1_nm);
  std::erase_if(points, [](const CurvePoint& point) { return point.branch == Branch::Retract; });
  const auto found = analyse(points);
  EXPECT_TRUE(found.snap_in);
  EXPECT_FALSE(found.pull_off);
  EXPECT_EQ(found.loop_energy, Energy());
}

TEST(CurveAnalysis, IntegratesOnlyWhereBothBranchesAre) {
  const auto whole = simulated(kMica, 0.01_nm);
  auto cut = whole;
  // the retract continues beyond all forces, where an offset must not count
  for (int i = 1; i < 100; ++i) cut.push_back({cut.back().z + 1_nm, cut.back().force, Branch::Retract});
  EXPECT_NEAR(analyse(cut).loop_energy / analyse(whole).loop_energy, 1.0, 1e-12);
}

std::string refusal(const std::vector<CurvePoint>& points) {
  try {
    analyse(points);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CurveAnalysis, RefusesWhatIsNoCurve) {
  EXPECT_THAT(refusal({}), HasSubstr("has 0 points; an analysis needs at least 10"));
  EXPECT_THAT(refusal(std::vector<CurvePoint>(20, {1_nm, 1_nN, Branch::Approach})), HasSubstr("the same height"));
  auto points = simulated(kMica, 0.1_nm);
  points[7].force = Force(std::nan(""));
  EXPECT_THAT(refusal(points), HasSubstr("not finite"));
}

TEST(MeasuredBranches, AreShortRisingAndKeepTheJumps) {
  const auto expected = approach_retract_events(kMica);
  const auto branches =
      measured_branches(as_measured(simulated(kMica, 0.005_nm), -3_um, 1_nN, 0.001_N_per_m, 0.002_nN));
  for (const auto* branch : {&branches.approach, &branches.retract}) {
    EXPECT_LE(branch->size(), 512U);
    EXPECT_GT(branch->size(), 400U);
    EXPECT_TRUE(std::is_sorted(branch->begin(), branch->end(), [](auto& a, auto& b) { return a.z < b.z; }));
  }
  const auto lowest = [](const std::vector<MeasuredPoint>& branch) {
    return *std::min_element(branch.begin(), branch.end(), [](auto& a, auto& b) { return a.force < b.force; });
  };
  const Length bin = (1.5 * expected.z_joc + 0.4 * expected.z_joc) / 512.0;
  EXPECT_NEAR((lowest(branches.approach).force + expected.f_attr) / 0.01_nN, 0.0, 1.0);
  EXPECT_NEAR((lowest(branches.approach).z - expected.z_jtc) / bin, 0.0, 3.0);
  EXPECT_NEAR((lowest(branches.retract).force + expected.f_ad) / 0.01_nN, 0.0, 1.0);
  EXPECT_NEAR((lowest(branches.retract).z - expected.z_joc) / bin, 0.0, 3.0);
  // beyond the jumps no force is left
  EXPECT_NEAR(branches.retract.back().force / 0.01_nN, 0.0, 1.0);
}

TEST(MeasuredBranches, AreFeltWithTheJumpsThatWereRecorded) {
  for (const ContactParameters& contact : {kMica, kGold, kSiliconNitride}) {
    const auto expected = approach_retract_events(contact);
    const Length step = 0.005 * expected.z_jtc;
    const auto recording =
        as_measured(simulated(contact, step), 2_um, -3_nN, 0.01 * expected.effective_stiffness, 0.002 * expected.f_ad);
    const auto branches = measured_branches(recording);
    const auto tables = measured_law_tables(branches.approach, branches.retract, contact);
    // a jump may lie anywhere in one of the bins, and the medians anywhere in the two next to it
    const Length bin = 1.9 * expected.z_joc / static_cast<double>(branches.approach.size());
    EXPECT_NEAR((tables->figures.z_jtc - expected.z_jtc) / bin, 0.0, 2.0);
    EXPECT_NEAR((tables->figures.z_joc - expected.z_joc) / bin, 0.0, 2.0);
    EXPECT_NEAR(tables->figures.force_before_joc / expected.f_ad, -1.0, 0.02);
    EXPECT_NEAR(tables->figures.loop_energy / expected.loop_energy, 1.0, 0.02);
  }
}

TEST(MeasuredBranches, RefuseACurveThatTouchesNothing) {
  std::vector<CurvePoint> flat;
  for (int i = 0; i < 100; ++i) flat.push_back({Length(-i * 1e-9), Force(), Branch::Approach});
  EXPECT_THROW(measured_branches(flat), std::invalid_argument);
}

}  // namespace curve_analysis_test
}  // namespace afm::physics
