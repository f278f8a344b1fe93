// SPDX-License-Identifier: Apache-2.0
// Invariant: snap-in, pull-off and loop energy of a recorded curve as a law equal those of its analysis within 1 %
#include "physics/measured_branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "physics/force_model.h"
#include "physics/law_tables.h"
#include "support/samples/recorded_cycles.h"

namespace afm::physics {
namespace measured_branches_test {

using namespace literals;

const Stiffness kRigid(std::numeric_limits<double>::infinity());
const ContactParameters kLever{50_nm, 1_N_per_m, kRigid, 24.5_zJ, 2.228_mJ_per_m2};

std::shared_ptr<const LawTables> felt(const std::vector<CurvePoint>& points) {
  const auto branches = measured_branches(points);
  return measured_law_tables(branches.approach, branches.retract, kLever, branches.jumps);
}

Force hardest_pull(const LawTables& tables) {
  Force hardest;
  const Length way = tables.figures.z_joc - tables.pressed_to;
  for (int i = 0; i <= 10000; ++i)
    hardest = std::min(hardest, tables.attached.force(tables.pressed_to + way * (i / 10000.0)));
  return hardest;
}

TEST(MeasuredCurve, KeepsSnapInPullOffAndEnergyOfAHardSample) {
  const auto points = test::hard_sample();
  const CurveFeatures recorded = analyse(points);
  ASSERT_TRUE(recorded.snap_in && recorded.pull_off && recorded.jumps_off);
  const CycleFigures figures = felt(points)->figures;
  EXPECT_NEAR(figures.force_after_jtc / recorded.snap_in->force_after, 1.0, 0.01);
  EXPECT_NEAR(figures.force_before_joc / recorded.pull_off->force, 1.0, 0.01);
  EXPECT_NEAR(figures.loop_energy / recorded.loop_energy, 1.0, 0.01);
  EXPECT_NEAR(figures.force_after_jtc.si, -0.55 * 6.6e-9, 0.1e-9);
  EXPECT_NEAR(figures.force_before_joc.si, -0.55 * 26e-9, 0.1e-9);
}

TEST(MeasuredCurve, OfASoftSampleIsFeltWithoutASnapIn) {
  const auto points = test::soft_sample();
  const CurveFeatures recorded = analyse(points);
  ASSERT_TRUE(recorded.pull_off);
  EXPECT_FALSE(recorded.snap_in);
  EXPECT_FALSE(recorded.jumps_off);
  const auto tables = felt(points);
  EXPECT_NEAR((tables->figures.force_after_jtc - tables->figures.force_before_jtc) / 1_nN, 0.0, 1e-9);
  EXPECT_NEAR(hardest_pull(*tables) / recorded.pull_off->force, 1.0, 0.01);
  EXPECT_NEAR(tables->figures.loop_energy / recorded.loop_energy, 1.0, 0.01);
}

TEST(MeasuredCurve, WithoutAdhesionIsNotRefusedForItsNoise) {
  const auto points = test::no_adhesion();
  const CurveFeatures recorded = analyse(points);
  EXPECT_FALSE(recorded.snap_in);
  EXPECT_FALSE(recorded.pull_off);
  EXPECT_NEAR(felt(points)->figures.loop_energy / recorded.loop_energy, 1.0, 0.01);
}

// A retract that was recorded more coarsely than the approach, and pulls weakly over a long way: what a bin's force is
// above or below the mean of its samples does not cancel between the branches.
TEST(MeasuredCurve, KeepsTheEnergyOfBranchesOfDifferentDensity) {
  const auto points = test::long_weak_pull();
  const CurveFeatures recorded = analyse(points);
  ASSERT_TRUE(recorded.jumps_off);
  const CycleFigures figures = felt(points)->figures;
  EXPECT_NEAR(figures.loop_energy / recorded.loop_energy, 1.0, 0.01);
  EXPECT_NEAR(figures.force_before_joc / recorded.pull_off->force, 1.0, 0.01);
}

// Neighbours of the pull-off are means of other samples, and with noise some are deeper than the pull-off's own median.
TEST(MeasuredCurve, KeepsAGradualPullOffThroughNoise) {
  for (const double noise : {0.01, 0.02, 0.03}) {
    for (const double range_m : {60e-9, 300e-9, 1e-6}) {
      for (unsigned seed = 0; seed < 6; ++seed) {
        const auto points = test::gradual_pull_off(range_m, noise, seed);
        const CurveFeatures recorded = analyse(points);
        ASSERT_TRUE(recorded.pull_off && !recorded.jumps_off) << noise << ", " << range_m << ", " << seed;
        const auto tables = felt(points);
        EXPECT_NEAR(hardest_pull(*tables) / recorded.pull_off->force, 1.0, 0.01)
            << noise << ", " << range_m << ", " << seed;
        EXPECT_NEAR(tables->figures.loop_energy / recorded.loop_energy, 1.0, 0.01)
            << noise << ", " << range_m << ", " << seed;
      }
    }
  }
}

// -integral of F dZ along the path from `from` to `to`.
Energy work(ApproachRetractModel& model, Length from, Length to) {
  constexpr int kSteps = 20000;
  Energy sum;
  TipResponse before = model.step(from);
  for (int i = 1; i <= kSteps; ++i) {
    const TipResponse here = model.step(from + (to - from) * (static_cast<double>(i) / kSteps));
    sum = sum - 0.5 * (before.force + here.force) * ((to - from) / kSteps);
    before = here;
  }
  return sum;
}

TEST(MeasuredCurve, CostsTheHandTheEnergyOfItsLoop) {
  for (const auto& points : {test::hard_sample(), test::soft_sample()}) {
    const auto tables = felt(points);
    ApproachRetractModel model(tables);
    const Length top = 1.2 * tables->figures.z_joc;
    model.step(top);
    const Energy down = work(model, top, tables->pressed_to), up = work(model, tables->pressed_to, top);
    // the turn at the deepest place takes some of it
    EXPECT_LE((down + up) / tables->figures.loop_energy, 1.0 + 1e-3);
    EXPECT_GE((down + up) / tables->figures.loop_energy, 0.85);
  }
}

TEST(MeasuredCurve, GivesNoWorkOnAWiggleInContact) {
  const auto tables = felt(test::hard_sample());
  ApproachRetractModel model(tables);
  model.step(1.2 * tables->figures.z_joc);
  work(model, 1.2 * tables->figures.z_joc, -10_nm);
  for (const Length top : {-9.5_nm, -5_nm, 3_nm}) {
    const Energy there = work(model, -10_nm, top), back = work(model, top, -10_nm);
    EXPECT_NEAR((there + back) / 1_aJ, 0.0, 1e-6) << top.si;
  }
}

TEST(MeasuredCurve, IsContinuousWhereTheHandTurns) {
  const auto tables = felt(test::hard_sample());
  ApproachRetractModel model(tables);
  model.step(1.2 * tables->figures.z_joc);
  work(model, 1.2 * tables->figures.z_joc, -10_nm);
  Force before = model.step(-10_nm).force;
  for (int i = 1; i < 3000; ++i) {
    const Force here = model.step(-10_nm + 0.01_nm * i).force;
    EXPECT_LT(abs(here - before), 0.02_nN);
    before = here;
  }
}

TEST(MeasuredCurve, RefusesAJumpOutsideOfItsBranch) {
  const auto branches = measured_branches(test::hard_sample());
  for (const MeasuredJumps jumps : {MeasuredJumps{1, 100}, MeasuredJumps{100, 100000}, MeasuredJumps{100000, 100}}) {
    EXPECT_THROW(measured_law_tables(branches.approach, branches.retract, kLever, jumps), std::invalid_argument);
  }
}

}  // namespace measured_branches_test
}  // namespace afm::physics
