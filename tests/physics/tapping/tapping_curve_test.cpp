// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tapping_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "physics/tapping/frequency_shift.h"
#include "physics/tapping/tapped_sample.h"
#include "support/deep.h"

namespace afm::physics {
namespace tapping_curve_test {

using namespace literals;
using support::deep;

TappingCurve curve_of(const TappedSample& sample, const TapPath& path, TapMethod method = TapMethod::Averaged) {
  return record_tapping_curve(sample.surface(), sample.lever(), path, method);
}

std::optional<TapJump> jump_on(const TappingCurve& curve, Branch branch) {
  for (const TapJump& jump : curve.jumps) {
    if (jump.branch == branch) return jump;
  }
  return std::nullopt;
}

TEST(TappingCurve, JumpsAtItsFolds) {
  const TappingCurve curve = curve_of({}, {{22_nm, 2_nm, 0.1_nm}, {}});
  ASSERT_EQ(curve.jumps.size(), 2u);
  const TapJump &in = curve.jumps[0], &out = curve.jumps[1];
  EXPECT_EQ(in.branch, Branch::Approach);
  EXPECT_EQ(out.branch, Branch::Retract);
  EXPECT_NEAR(nm_of(in.z), 16.568, 3e-3 * 16.6);
  EXPECT_NEAR(nm_of(in.before.amplitude), 16.9, 3e-3 * 16.9);
  EXPECT_NEAR(nm_of(in.after.amplitude), 18.07, 3e-3 * 18.1);
  EXPECT_NEAR(nm_of(out.z), 18.826, 3e-3 * 18.8);
  EXPECT_NEAR(nm_of(out.before.amplitude), 20.0, 3e-3 * 20.0);
  EXPECT_NEAR(nm_of(out.after.amplitude), 18.72, 3e-3 * 18.7);
  EXPECT_NEAR(curve.work_on_hand.si * 1e18, 1.63, 0.05 * 1.63);
  EXPECT_NEAR(curve.reduction_loop.si * 1e18, -3.04, 0.05 * 3.04);
}

TEST(TappingCurve, HasFoldsThatDoNotDependOnTheStep) {
  const TappingCurve coarse = curve_of({}, {{22_nm, 14_nm, 1_nm}, {}}),
                     fine = curve_of({}, {{22_nm, 14_nm, 0.037_nm}, {}});
  ASSERT_EQ(coarse.jumps.size(), 2u);
  ASSERT_EQ(fine.jumps.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(nm_of(coarse.jumps[i].z), nm_of(fine.jumps[i].z), 1e-6);
}

// Far from the resonance the flow turned faster than its steps; the curve had phases of 1e11 degrees
TEST(TappingCurve, LosesItsAveragesWhereTheFlowTurnsOnAndOn) {
  const TappedSample soft{
      .k = 0.872, .q = 403.5, .ratio = 13.75 / 12.97, .a0_nm = 95.4, .r_nm = 50, .h_zj = 60, .e_gpa = 80};
  const TappingCurve curve =
      record_tapping_curve(soft.surface(Law::Jkr), soft.lever(), {{105_nm, 9.5_nm, 1.6_nm}, {}}, TapMethod::Averaged);
  EXPECT_TRUE(curve.lost_at);
  for (const TapPoint& point : curve.points) {
    EXPECT_LT(std::abs(point.state.phase), 7.0) << nm_of(point.z);
    EXPECT_LT(nm_of(point.state.amplitude), 2.0 * soft.a0_nm) << nm_of(point.z);
  }
}

// Newton's method crept for minutes on the first, and rows on the second had phases at which no swing rests
TEST(TappingCurve, IsLostWhereItsSwingDoesNotRest) {
  const TappedSample far{
      .k = 2.51, .q = 283, .ratio = 1.318, .a0_nm = 43.9, .r_nm = 33.6, .h_zj = 20.3, .e_gpa = 0.0572};
  EXPECT_TRUE(curve_of(far, {{48_nm, 5_nm, 0.88_nm}, {}, true}).lost_at);
  const TappedSample latch{.k = 17.7, .q = 651, .a0_nm = 9.47, .r_nm = 26.1, .h_zj = 96.2, .e_gpa = 4.65};
  const TapPath path{{9.6_nm, 9_nm, 0.05_nm}, {}, true};
  const TappingCurve curve = record_tapping_curve(latch.surface(Law::Jkr), latch.lever(), path, TapMethod::Averaged);
  ASSERT_TRUE(curve.lost_at);
  EXPECT_GT(*curve.lost_at, 9.4_nm);
}

// Above the resonance the branch ends on the other side of the free lever's phase; direct integration counted no jump
TEST(TappingCurve, JumpsByBothMethodsFarAboveTheResonance) {
  const TappedSample sample{.k = 11, .q = 178, .ratio = 1.26, .a0_nm = 29.7, .r_nm = 9.8, .h_zj = 57.3, .e_gpa = 2.62};
  const TapPath path{{30_nm, 26_nm, 0.5_nm}, {}, true};
  const auto averaged = jump_on(curve_of(sample, path), Branch::Approach);
  const auto direct = jump_on(curve_of(sample, path, TapMethod::Direct), Branch::Approach);
  ASSERT_TRUE(averaged && direct);
  EXPECT_NEAR(nm_of(averaged->z), nm_of(direct->z), 0.5);
  EXPECT_NEAR(nm_of(averaged->after.amplitude), nm_of(direct->after.amplitude), 1.0);
}

// The swing of a soft lever far from its resonance repeats only after several periods, or never; its rows were
// compared, and 11 jumps found
TEST(TappingCurve, HasNoJumpsBetweenSwingsThatDoNotRepeat) {
  const TappedSample soft{
      .k = 0.872, .q = 403.5, .ratio = 13.75 / 12.97, .a0_nm = 95.4, .r_nm = 50, .h_zj = 60, .e_gpa = 80};
  const TapPath path{{96_nm, 76_nm, 4_nm}, {}};
  const TappingCurve curve = record_tapping_curve(soft.surface(Law::Jkr), soft.lever(), path, TapMethod::Direct);
  EXPECT_TRUE(curve.points.front().repeats);
  EXPECT_GE(std::count_if(curve.points.begin(), curve.points.end(), [](const TapPoint& p) { return !p.repeats; }), 3);
  for (const TapJump& jump : curve.jumps) ADD_FAILURE() << nm_of(jump.z);
}

// A curve may take a minute: its progress is logged.
TEST(TappingCurve, CountsEachHeightAndThoseOfItsIslands) {
  const TappedSample sample{.q = 100.0};
  for (const TapMethod method : {TapMethod::Averaged, TapMethod::Direct}) {
    std::vector<std::size_t> counted;
    std::size_t last = 0;
    const TappingCurve curve = record_tapping_curve(sample.surface(), sample.lever(), {{22_nm, 20_nm, 0.5_nm}, {}},
                                                    method, [&](std::size_t done, std::size_t all) {
                                                      counted.push_back(done);
                                                      last = all;
                                                    });
    // five heights down, four up again, and five for islands
    ASSERT_EQ(counted.size(), method == TapMethod::Averaged ? 14u : 9u);
    EXPECT_EQ(counted.back(), last);
    for (std::size_t i = 0; i < counted.size(); ++i) EXPECT_EQ(counted[i], i + 1);
    EXPECT_EQ(curve.points.size(), 9u);
  }
}

TEST(TappingCurve, ReportsAStateThatItsPathDoesNotReach) {
  const TappingCurve curve = curve_of({.a0_nm = 10}, {{11_nm, 2_nm, 0.05_nm}, {}});
  EXPECT_TRUE(curve.jumps.empty());
  ASSERT_EQ(curve.islands.size(), 1u);
  const TapIsland& island = curve.islands.front();
  EXPECT_LT(island.lowest_z, 5_nm);
  EXPECT_NEAR(nm_of(island.highest_z), 8.5, 0.5);
  // the path itself, and the island, at 5 nm
  const auto at = std::min_element(curve.points.begin(), curve.points.end(), [](const TapPoint& a, const TapPoint& b) {
    return abs(a.z - 5_nm) < abs(b.z - 5_nm);
  });
  EXPECT_NEAR(nm_of(at->state.amplitude), 4.819, 1e-3 * 4.8);
  EXPECT_NEAR(degrees_of(at->state.phase), 151.19, 0.2);
  AveragedFlow flow(TappedSample{}.surface(), TappedSample{.a0_nm = 10}.lever());
  const auto taps = flow.resting_at(5_nm);
  EXPECT_TRUE(std::any_of(taps.begin(), taps.end(), [](const RestingTap& tap) {
    return tap.stable && std::abs(nm_of(tap.state.amplitude) - 6.345) < 4e-3 * 6.3 &&
           std::abs(degrees_of(tap.state.phase) - 39.38) < 0.2;
  }));
}

// Row T44: a step of the base is a kick, so the fold is not met.
TEST(TappingDeep, ABaseThatMovesInStepsJumpsBeforeTheFold) {
  const TappingCurve curve = curve_of({}, {{20.5_nm, 15.5_nm, 0.5_nm}, {}}, TapMethod::Direct);
  const auto in = jump_on(curve, Branch::Approach), out = jump_on(curve, Branch::Retract);
  ASSERT_TRUE(in && out);
  EXPECT_NEAR(nm_of(in->z), 17.25, 0.26);
  EXPECT_NEAR(nm_of(out->z), 18.75, 0.26);
}

struct SpeedRow {
  double um_per_s, in_direct, out_direct, in_averaged, out_averaged;
};
constexpr SpeedRow kSpeedRows[] = {{0.02, 16.455, 18.835, 16.494, 18.832},
                                   {0.1, 16.343, 18.846, 16.379, 18.844},
                                   {0.5, 16.160, 18.837, 16.192, 18.853},
                                   {2.0, 16.547, 18.627, 16.511, 18.641},
                                   {5.0, 17.950, 17.767, 17.954, 17.834}};

TEST(TappingDeep, AMovingBaseJumpsElsewhere) {
  // Z where the phase passes 90 degrees; the rows' own two methods differ by up to 0.07 nm
  constexpr double kError = 0.08;
  for (const SpeedRow& row : kSpeedRows) {
    if (!deep() && row.um_per_s < 0.3) continue;
    const TapPath path{{20.5_nm, 15.5_nm, 0.02_nm}, Velocity(row.um_per_s * 1e-6)};
    SCOPED_TRACE(row.um_per_s);
    const TappingCurve averaged = curve_of({}, path), direct = curve_of({}, path, TapMethod::Direct);
    for (const Branch branch : {Branch::Approach, Branch::Retract}) {
      const auto slow = jump_on(averaged, branch), exact = jump_on(direct, branch);
      ASSERT_TRUE(slow && exact);
      const bool in = branch == Branch::Approach;
      EXPECT_NEAR(nm_of(exact->z), in ? row.in_direct : row.out_direct, kError);
      // the row's own solver steps by a tenth of a relaxation, and shifts the lowest point by the mean deflection alone
      EXPECT_NEAR(nm_of(slow->z), in ? row.in_averaged : row.out_averaged, kError + 0.02);
      EXPECT_NEAR(nm_of(slow->z), nm_of(exact->z), 0.1);
    }
  }
}

TEST(TappingCurve, RefusesWhatItCannotCompute) {
  const TapPath path{{22_nm, 2_nm, 0.1_nm}, {}};
  EXPECT_THROW((void)curve_of({.q = 99}, path), std::invalid_argument);
  EXPECT_THROW((void)curve_of({}, {{22_nm, 2_nm, 0.1_nm}, Velocity()}), std::invalid_argument);
  EXPECT_THROW((void)curve_of({}, {{22_nm, 2_nm, 0.1_nm}, Velocity(1e-15)}), std::invalid_argument);
  EXPECT_THROW((void)curve_of({}, {{2_nm, 22_nm, 0.1_nm}, {}}), std::invalid_argument);
  EXPECT_THROW((void)curve_of({.q = 1e5}, path, TapMethod::Direct), std::invalid_argument);
}

TEST(FrequencyShift, OfVanDerWaalsHasItsClosedForm) {
  struct Row {
    double z_nm, a_nm, shift, small;
  };
  const TappedSample sample{.k = 2000, .gap_nm = 0.05};
  for (const Row& row : {Row{10.5, 10.0, -0.9751337328, -0.02764280315}, Row{2.0, 0.1, -4.015047012, -4.0},
                         Row{1.0, 0.05, -32.1203761, -32.0}}) {
    const FrequencyShiftPoint point =
        frequency_shift_at(*sample.surface(), 300_kHz, Length(row.a_nm * 1e-9), Length(row.z_nm * 1e-9));
    EXPECT_NEAR(point.shift.si, row.shift, 1e-9 * std::abs(row.shift));
    EXPECT_NEAR(point.small_amplitude_shift.si, row.small, 1e-9 * std::abs(row.small));
  }
}

TEST(FrequencyShift, TurnsWhereTheSampleBeginsToRepel) {
  const FrequencyShiftCurve curve =
      record_frequency_shift(*TappedSample{}.surface(), 300_kHz, 10_nm, {12_nm, 9_nm, 0.05_nm});
  ASSERT_EQ(curve.turns.size(), 1u);
  EXPECT_NEAR(nm_of(curve.turns.front().z), 9.6, 0.2);
  for (const FrequencyShiftPoint& point : curve.points) EXPECT_GE(point.shift, curve.turns.front().shift);
  // above it df falls on the way down, below it df rises
  const auto at = [&](double z_nm) {
    return frequency_shift_at(*TappedSample{}.surface(), 300_kHz, 10_nm, Length(z_nm * 1e-9)).shift.si;
  };
  // sums of 4 million nodes
  EXPECT_NEAR(at(10.5), -48.75668664, 1e-6 * 49);
  EXPECT_NEAR(at(10.165), -263.63115165, 1e-6 * 264);
  EXPECT_NEAR(at(9.5), -488.23854617, 1e-6 * 488);
  EXPECT_NEAR(at(9.0), -172.81852571, 1e-6 * 173);
}

}  // namespace tapping_curve_test
}  // namespace afm::physics
