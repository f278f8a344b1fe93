// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "physics/imaging/tapping_detector.h"
#include "physics/tapping/tap_envelope.h"
#include "physics/tapping/tapped_sample.h"
#include "physics/tapping/tapping_model.h"
#include "physics/tapping/tapping_oscillator.h"

namespace afm::physics {
namespace tap_table_test {

// The soft lever of rows T22 to T27, in a liquid or a poor vacuum.
const TappedSample kSoft{.k = 2.0, .q = 20.0, .r_nm = 10.0, .e_gpa = 1.0};

// A lever below the quality factor at which the averaged flow begins, with both jumps.
const TappedSample kBistable{.k = 4.0, .q = 99.0};

std::shared_ptr<const LawTables> tables_of(const TappedSample& sample) {
  return tapped_law_tables(Law::Dmt, sample.surface(), sample.lever());
}

// Made once, because it takes seconds.
const std::shared_ptr<const LawTables>& bistable() {
  static const std::shared_ptr<const LawTables> tables = tables_of(kBistable);
  return tables;
}

struct Felt {
  Felt(const TappedSample& sample, std::shared_ptr<const LawTables> made)
      : surface(sample.surface()),
        lever(sample.lever()),
        tables(std::move(made)),
        model(surface, lever, tables, Time(1e-3)) {}

  // The jumps on the way.
  std::vector<ModelEvent> move(double from_nm, double to_nm) {
    std::vector<ModelEvent> events;
    const int ticks = static_cast<int>(std::abs(to_nm - from_nm) / 0.02);
    for (int i = 1; i <= ticks; ++i) {
      const TipResponse response = model.step(Length(1e-9 * (from_nm + (to_nm - from_nm) * i / ticks)));
      events.insert(events.end(), response.events.begin(), response.events.begin() + response.event_count);
    }
    return events;
  }

  std::shared_ptr<const TapSurface> surface;
  DrivenLever lever;
  std::shared_ptr<const LawTables> tables;
  TappingModel model;
};

// T22, T24, T25, T26: RK4 with 3200 steps a swing, from the free orbit
TEST(TapTable, HasTheSwingsOfDirectIntegration) {
  struct Row {
    double z_nm, amplitude_nm, phase_deg, mean_nn, peak_nn;
  };
  Felt felt(kSoft, tables_of(kSoft));
  ASSERT_NE(felt.tables->taps, nullptr);
  (void)felt.model.step(Length(60e-9));
  double at_nm = 60.0;
  for (const Row& row :
       {Row{20.0, 19.8452, 97.1197, -0.125027, 0.0}, Row{14.0, 15.9531, 52.9899, 0.597987, 9.85077},
        Row{12.0, 14.0327, 44.6658, 0.70779, 10.612986}, Row{6.0, 8.07496, 24.0408, 0.904584, 10.981254}}) {
    felt.move(at_nm, row.z_nm);
    at_nm = row.z_nm;
    EXPECT_NEAR(nm_of(felt.model.amplitude()), row.amplitude_nm, 2e-3 * row.amplitude_nm) << row.z_nm;
    EXPECT_NEAR(degrees_of(felt.model.phase_lag()), row.phase_deg, 0.3) << row.z_nm;
    EXPECT_NEAR(felt.model.step(Length(1e-9 * row.z_nm)).force.si * 1e9, row.mean_nn, 0.02) << row.z_nm;
    const TapTable::Rest rest = felt.tables->taps->at(row.z_nm < 18.0, 1e-9 * row.z_nm);
    EXPECT_NEAR(rest.peak_force_n * 1e9, row.peak_nn, 0.02 * std::max(1.0, row.peak_nn)) << row.z_nm;
  }
}

// At a height with two states, a free swing and a lever at rest each settle in one of the table's states.
TEST(TapTable, HasTheStatesInWhichALeverSettles) {
  const std::shared_ptr<const TapTable> rests = bistable()->taps;
  const CycleFigures& figures = bistable()->figures;
  ASSERT_TRUE(figures.hysteretic);
  const Length middle = 0.5 * (figures.z_jtc + figures.z_joc);
  const std::vector<TapState> states = rests->states_at(middle);
  ASSERT_EQ(states.size(), 2U);
  TappingOscillator tip(kBistable.surface(), kBistable.lever());
  for (const TapState& start : {TapState{kBistable.lever().free_amplitude, kBistable.lever().free_phase}, TapState{}}) {
    tip.place(middle, start);
    const double rest_nm = nm_of(tip.settle().state.amplitude);
    double nearest_nm = HUGE_VAL;
    for (const TapState& state : states) {
      nearest_nm = std::min(nearest_nm, std::abs(nm_of(state.amplitude) - rest_nm));
    }
    EXPECT_LT(nearest_nm, 4e-3 * rest_nm) << rest_nm;
  }
}

TEST(TapTable, LetsAHandFallIntoTheRepulsiveStateAndOutOfIt) {
  Felt felt(kBistable, bistable());
  const CycleFigures& figures = felt.tables->figures;
  ASSERT_TRUE(figures.hysteretic);
  EXPECT_EQ(felt.model.slow_motion(), 1.0);
  (void)felt.model.step(Length(30e-9));
  const double below_nm = nm_of(figures.z_jtc) - 2.0, middle_nm = nm_of(0.5 * (figures.z_jtc + figures.z_joc));
  EXPECT_EQ(felt.tables->taps->states_at(Length(1e-9 * middle_nm)).size(), 2U);
  EXPECT_EQ(felt.tables->taps->states_at(Length(1e-9 * below_nm)).size(), 1U);
  const auto in = felt.move(30.0, below_nm);
  ASSERT_EQ(in.size(), 1U);
  EXPECT_EQ(in[0].kind, EventKind::JumpToRepulsion);
  EXPECT_NEAR(nm_of(in[0].z), nm_of(figures.z_jtc), 0.05);
  const auto off = felt.move(below_nm, 30.0);
  ASSERT_EQ(off.size(), 1U);
  EXPECT_EQ(off[0].kind, EventKind::JumpToAttraction);
  EXPECT_NEAR(nm_of(off[0].z), nm_of(figures.z_joc), 0.05);
}

// Mica in water under a soft lever: below contact the pressed swing jumps to and fro, and its push steps.
TEST(TapTable, IsOneBranchWhereThereIsNoLoopBetweenTheStates) {
  const TappedSample pressed{.k = 2.0, .q = 5.0, .r_nm = 50.0, .h_zj = 24.5, .e_gpa = 51.5};
  Felt felt(pressed, tables_of(pressed));
  const LawTables& tables = *felt.tables;
  EXPECT_FALSE(tables.taps->walk().jumps.empty());
  EXPECT_FALSE(tables.figures.hysteretic);
  EXPECT_NEAR(nm_of(tables.figures.z_jtc), 20.1, 0.3) << "where the tip begins to touch";
  EXPECT_EQ(tables.figures.z_joc, tables.figures.z_jtc);
  (void)felt.model.step(Length(30e-9));
  EXPECT_TRUE(felt.move(30.0, 0.1).empty());
  EXPECT_EQ(felt.model.phase(), Phase::Attached);
  EXPECT_EQ(felt.model.push(), tables.attached.force(Length(0.1e-9)));
  EXPECT_TRUE(felt.move(0.1, 30.0).empty());
  EXPECT_EQ(felt.model.phase(), Phase::Free);
}

// The push of a hand rises by at most four times that of a swing that loses as much as its base moves.
TEST(TapTable, SpreadsAStepOfThePush) {
  const TappedSample sticky{.k = 2.0, .q = 5.0, .r_nm = 50.0, .e_gpa = 50.0};
  const auto tables = tables_of(sticky);
  const double steepest = 4.0 * tables->tapped_full.si / sticky.lever().free_amplitude.si;
  constexpr double kStepM = 0.01e-9;
  for (double z = 0.0; z < 25e-9; z += kStepM) {
    for (const BranchTable* branch : {&tables->free, &tables->attached}) {
      const double rise = (branch->force(Length(z)) - branch->force(Length(z + kStepM))).si / kStepM;
      ASSERT_LT(rise, 1.6 * steepest) << z;
    }
  }
}

TEST(TapTable, IsFollowedWithTheRelaxationOfTheLever) {
  const auto rests = std::make_shared<const TapTable>(kSoft.surface(), kSoft.lever());
  TapEnvelope envelope(rests);
  const TapTable::Rest rest = rests->at(true, 12e-9);
  const double a0 = kSoft.lever().free_amplitude.si;
  envelope.place(0.0, a0, 60e-9);
  // one relaxation 2Q/w0
  envelope.advance(12e-9, 12e-9, 2.0 * kSoft.q);
  const double u = rest.u_m * (1.0 - std::exp(-1.0)), v = rest.v_m + (a0 - rest.v_m) * std::exp(-1.0);
  EXPECT_NEAR(envelope.amplitude_m(), std::hypot(u, v), 1e-15);
}

TEST(TapTable, HoldsASetpointOfAnImage) {
  TappingDetector detector(kSoft.surface(), kSoft.lever(), Length(16e-9));
  EXPECT_TRUE(detector.is_direct());
  EXPECT_NEAR(detector.amplitude_m(), 16e-9, 0.02e-9);
  // T24: 15.953 nm at a height of 14 nm
  EXPECT_NEAR(detector.engaged_gap_m(), 14.05e-9, 0.05e-9);
  EXPECT_THROW(TappingDetector(kSoft.surface(), kSoft.lever(), Length(20e-9)), std::invalid_argument);
}

}  // namespace tap_table_test
}  // namespace afm::physics
