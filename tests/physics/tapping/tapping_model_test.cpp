// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tapping_model.h"
#include "physics/tapping/tapping_oscillator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/felt_swing.h"
#include "physics/tapping/tapped_sample.h"
#include "support/no_alloc.h"

namespace afm::physics {
namespace tapping_model_test {

using namespace literals;

constexpr Time kTick(1e-3);

// A lever that taps under a hand, in ticks of a millisecond.
struct Tapped {
  explicit Tapped(const TappedSample& sample = {}, Time tick = kTick)
      : surface(sample.surface()),
        lever(sample.lever()),
        tables(tapped_law_tables(Law::Dmt, surface, lever)),
        model(surface, lever, tables, tick) {}

  std::shared_ptr<const TapSurface> surface;
  DrivenLever lever;
  std::shared_ptr<const LawTables> tables;
  TappingModel model;
};

struct Path {
  std::vector<ModelEvent> events;
  double work_of_push_j = 0, work_of_mean_j = 0;  // work on the hand
};

// Moves from one height to another at this speed; the forces act from one tick to the next.
void move(TappingModel& model, double from_nm, double to_nm, double nm_per_tick, Path& path) {
  const int ticks = std::max(1, static_cast<int>(std::ceil(std::abs(to_nm - from_nm) / nm_per_tick)));
  const double step_nm = (to_nm - from_nm) / ticks;
  Force push = model.push(), mean;
  for (int i = 1; i <= ticks; ++i) {
    const TipResponse response = model.step(Length(1e-9 * (from_nm + i * step_nm)));
    path.work_of_push_j += 0.5e-9 * step_nm * (push + model.push()).si;
    if (i > 1) path.work_of_mean_j += 0.5e-9 * step_nm * (mean + response.force).si;
    push = model.push();
    mean = response.force;
    path.events.insert(path.events.end(), response.events.begin(), response.events.begin() + response.event_count);
  }
}

TEST(TappedTables, HaveTheFoldsOfASlowWalk) {
  const Tapped tapped;
  const CycleFigures& figures = tapped.tables->figures;
  ASSERT_TRUE(figures.hysteretic);
  EXPECT_NEAR(figures.z_jtc.si, 16.568e-9, 3e-3 * 16.568e-9);
  EXPECT_NEAR(figures.z_joc.si, 18.826e-9, 3e-3 * 18.826e-9);
  // P = k A0/Q (1 - A/A0) = 2 nN (1 - A/A0)
  const auto push_at = [](double amplitude_nm) { return 2e-9 * (1.0 - amplitude_nm / 20.0); };
  EXPECT_NEAR(figures.force_before_jtc.si, push_at(16.9), 2e-9 * 3e-3);
  EXPECT_NEAR(figures.force_after_jtc.si, push_at(18.07), 2e-9 * 3e-3);
  EXPECT_NEAR(figures.force_before_joc.si, push_at(20.0), 2e-9 * 3e-3);
  EXPECT_NEAR(figures.force_after_joc.si, push_at(18.72), 2e-9 * 3e-3);
  EXPECT_NEAR(tapped.tables->tapped_full.si, 2e-9, 1e-15);
  EXPECT_NEAR(tapped.tables->tapped_from.si, 22e-9, 1e-15);
}

// A stiff sample raises the resonance: of a drive at it or below it the swing becomes smaller, above it larger.
TEST(TappedTables, HaveTheLargestSwingOfASlowHand) {
  const auto largest = [](double ratio) {
    const TappedSample sample{.ratio = ratio, .e_gpa = 50.0};
    const auto tables = tapped_law_tables(Law::Dmt, sample.surface(), sample.lever());
    return std::pair(largest_swing_of_hand(sample.surface(), sample.lever(), *tables),
                     largest_felt_swing(sample.lever()));
  };
  for (const double ratio : {0.94, 1.0}) EXPECT_LE(largest(ratio).first.si, 1.01 * 20e-9) << ratio;
  EXPECT_GT(largest(1.06).first, largest(1.06).second);
}

TEST(TappedTables, RefuseALeverThatFollowsTooSlowly) {
  const TappedSample slow{.q = 3000.0};
  EXPECT_THROW((void)tapped_law_tables(Law::Dmt, slow.surface(), slow.lever()), UnphysicalValue);
}

// Over a soft lever beside the resonance the walk crept on in endless steps of 1e-18 m.
TEST(TappedTables, EndAboveTheHeightAtWhichTheAveragesFollowNoBranch) {
  const TappedSample soft{.k = 2.0, .q = 120.0, .ratio = 1.06};
  for (const Harmonics harmonics : {Harmonics::OfTheDrive, Harmonics::AtResonance}) {
    DrivenLever lever = soft.lever();
    lever.harmonics = harmonics;
    const auto tables = tapped_law_tables(Law::Dmt, soft.surface(), lever);
    EXPECT_GT(tables->pressed_to.si, soft.surface()->contact_height().si);
    EXPECT_LT(tables->pressed_to.si, 6e-9);
  }
}

// Share by which the amplitude of direct integration differs from that under a hand that rests at this height.
double off_under_hand(Harmonics harmonics, const TappedSample& sample, double z_nm) {
  const auto surface = sample.surface();
  DrivenLever lever = sample.lever();
  lever.harmonics = harmonics;
  TappingModel model(surface, lever, tapped_law_tables(Law::Dmt, surface, lever), kTick);
  Path path;
  move(model, 24.0, z_nm, 0.02, path);
  for (int i = 0; i < 200; ++i) (void)model.step(Length(1e-9 * z_nm));
  TappingOscillator tip(surface, lever);
  tip.place(Length(1e-9 * z_nm), {model.amplitude(), model.phase_lag()});
  (void)tip.settle();
  return tip.settle().state.amplitude / model.amplitude() - 1.0;
}

// A hand's harmonics answered as at the resonance; an older session still has them so.
TEST(TappingModel, RestsWhereDirectIntegrationDoesBesideTheResonance) {
  const TappedSample below{.ratio = 0.94};
  EXPECT_LT(std::abs(off_under_hand(Harmonics::OfTheDrive, below, 11.0)), 1e-4);
  EXPECT_GT(std::abs(off_under_hand(Harmonics::AtResonance, below, 11.0)), 8e-4);
}

TEST(TappingModel, RestsInTheStatesOfTheTables) {
  // both states at one height, by a slow approach and by a slow retract
  Tapped tapped;
  Path path;
  move(tapped.model, 22.0, 17.4149, 0.005, path);
  EXPECT_EQ(tapped.model.phase(), Phase::Free);
  EXPECT_NEAR(nm_of(tapped.model.amplitude()), 17.4935, 2e-3 * 17.5);
  EXPECT_NEAR(degrees_of(tapped.model.phase_lag()), 118.99, 0.4);
  EXPECT_NEAR(tapped.model.push().si, tapped.tables->free.force(17.4149_nm).si, 0.01e-9);
  move(tapped.model, 17.4149, 15.0, 0.005, path);
  move(tapped.model, 15.0, 17.4149, 0.005, path);
  EXPECT_EQ(tapped.model.phase(), Phase::Attached);
  EXPECT_NEAR(nm_of(tapped.model.amplitude()), 18.8572, 2e-3 * 18.9);
  EXPECT_NEAR(degrees_of(tapped.model.phase_lag()), 70.54, 0.4);
  EXPECT_NEAR(tapped.model.push().si, tapped.tables->attached.force(17.4149_nm).si, 0.01e-9);
}

TEST(TappingModel, TakesEnergyFromASlowHandThatTheMeanForceWouldGiveTo) {
  Tapped tapped;
  Path path;
  move(tapped.model, 22.0, 15.5, 0.002, path);
  move(tapped.model, 15.5, 22.0, 0.002, path);
  ASSERT_EQ(path.events.size(), 2u);
  EXPECT_EQ(path.events[0].kind, EventKind::JumpToRepulsion);
  EXPECT_EQ(path.events[1].kind, EventKind::JumpToAttraction);
  EXPECT_LT(path.events[0].force_before.si, 0.0);
  EXPECT_NEAR(path.work_of_mean_j, 1.63e-18, 0.05 * 1.63e-18);
  // k A0/Q/A0 = 0.1 N/m times -3.04 nm^2
  EXPECT_NEAR(path.work_of_push_j, -0.304e-18, 0.05 * 0.304e-18);
  EXPECT_NEAR(tapped.tables->figures.loop_energy.si, 0.304e-18, 0.05 * 0.304e-18);
}

TEST(TappingModel, JumpsWhereADirectlyIntegratedLeverJumpsAtAnySpeedOfTheHand) {
  struct Row {
    double um_per_s, down_nm, up_nm;
  };
  for (const Row& row : {Row{0.02, 16.455, 18.835}, Row{0.1, 16.343, 18.846}, Row{0.5, 16.16, 18.837},
                         Row{2.0, 16.547, 18.627}, Row{5.0, 17.95, 17.767}}) {
    // at 4 kHz, so that the path of 5 nm is a whole number of ticks
    Tapped tapped({}, Time(0.25e-3));
    Path path;
    const auto rest_at = [&](double nm) {
      for (int i = 0; i < 240; ++i) (void)tapped.model.step(Length(1e-9 * nm));
    };
    rest_at(20.5);
    move(tapped.model, 20.5, 15.5, 0.25 * row.um_per_s, path);
    rest_at(15.5);
    move(tapped.model, 15.5, 20.5, 0.25 * row.um_per_s, path);
    for (int i = 0; i < 20 && path.events.size() < 2; ++i) move(tapped.model, 20.5, 20.5, 1.0, path);
    ASSERT_EQ(path.events.size(), 2u) << row.um_per_s;
    EXPECT_NEAR(1e9 * path.events[0].z.si, row.down_nm, 0.1) << row.um_per_s;
    EXPECT_NEAR(1e9 * path.events[1].z.si, row.up_nm, 0.1) << row.um_per_s;
  }
}

// Above the resonance the repulsive state of gold ends above A0, at 22.8 nm: the swing falls onto the free one, without
// crossing its phase, which it crossed at the jump in.
TEST(TappingModel, SaysWhereASwingFallsOntoTheFreeOne) {
  const TappedSample gold{.ratio = 300.2 / 300.0, .r_nm = 50.0, .h_zj = 120.0, .e_gpa = 71.4, .gap_nm = 0.3};
  const auto surface = gold.surface();
  for (const JumpOff jump_off : {JumpOff::WhereSeen, JumpOff::WherePhaseCrossed}) {
    DrivenLever lever = gold.lever();
    lever.jump_off = jump_off;
    TappingModel model(surface, lever, tapped_law_tables(Law::Dmt, surface, lever), kTick);
    Path path;
    move(model, 26.0, 8.0, 0.01, path);
    move(model, 8.0, 26.0, 0.01, path);
    ASSERT_EQ(path.events.size(), 2U);
    EXPECT_EQ(path.events[1].kind, EventKind::JumpToAttraction);
    EXPECT_NEAR(path.events[1].z.si, jump_off == JumpOff::WhereSeen ? 22.8e-9 : path.events[0].z.si, 0.1e-9);
  }
}

TEST(TappingModel, HasNoJumpWhereTheRepulsiveStateIsAnIsland) {
  Tapped tapped(TappedSample{.a0_nm = 10.0});
  EXPECT_LT(tapped.tables->figures.z_jtc, 2_nm);
  Path path;
  move(tapped.model, 12.0, 5.0, 0.005, path);
  EXPECT_NEAR(nm_of(tapped.model.amplitude()), 4.819, 3e-3 * 4.819);
  EXPECT_NEAR(degrees_of(tapped.model.phase_lag()), 151.19, 0.4);
  move(tapped.model, 5.0, 2.0, 0.005, path);
  move(tapped.model, 2.0, 12.0, 0.005, path);
  EXPECT_TRUE(path.events.empty());
}

TEST(TappingModel, GivesASlowHandNoEnergyOnAnyClosedPath) {
  Tapped tapped;
  const double stored_j = 2e-9 * 20e-9;
  std::mt19937 random(38);
  std::uniform_real_distribution<double> height_nm(1.0, 21.0);
  double most_j = -HUGE_VAL;
  for (int path = 0; path < 60; ++path) {
    Path work;
    double at_nm = 24.0;
    for (int leg = 0; leg < 6; ++leg) {
      const double next_nm = leg == 5 ? 24.0 : height_nm(random);
      move(tapped.model, at_nm, next_nm, 0.01, work);
      at_nm = next_nm;
    }
    most_j = std::max(most_j, work.work_of_push_j);
  }
  EXPECT_LT(most_j, 1e-4 * stored_j);
}

TEST(TappingModel, WaitsForALiftAboveBothJumps) {
  Tapped tapped;
  EXPECT_EQ(tapped.model.step(17.5_nm).phase, Phase::WaitForLift);
  EXPECT_EQ(tapped.model.push().si, 0.0);
  (void)tapped.model.step(22_nm);
  EXPECT_EQ(tapped.model.phase(), Phase::Free);
  const TipResponse lost = tapped.model.step(Length(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(lost.phase, Phase::WaitForLift);
  EXPECT_EQ(lost.force.si, 0.0);
  EXPECT_EQ(tapped.model.push().si, 0.0);
}

TEST(TappingModel, StaysFiniteUnderAHandThatLeapsAndPresses) {
  Tapped tapped;
  (void)tapped.model.step(30_nm);
  for (const double z_nm : {-20.0, 500.0, 0.1, 18.0, -1.0, 3.0, 1e6, 0.0}) {
    for (int i = 0; i < 50; ++i) (void)tapped.model.step(Length(1e-9 * z_nm));
    const double share = tapped.model.push() / tapped.tables->tapped_full;
    EXPECT_GT(share, -0.01) << z_nm;
    EXPECT_LT(share, 1.01) << z_nm;
  }
}

TEST(TappingModel, IsInSlowMotionWhereItsLeverIsTooFastForTheTick) {
  // 2 pi 300 kHz 1 ms = 1885 = 23.6 steps of a tenth of 2Q = 800; with Q = 100 it is 94.2 steps, of which a tick makes
  // 48
  EXPECT_EQ(Tapped().model.slow_motion(), 1.0);
  EXPECT_NEAR(Tapped(TappedSample{.q = 100.0}).model.slow_motion(), 94.2478 / 48.0, 1e-4);
}

TEST(TappingModel, StepsWithoutAllocationInMicroseconds) {
  Tapped tapped;
  (void)tapped.model.step(22_nm);
  std::vector<double> us;
  us.reserve(4000);
  const auto tick = [&](int i) {
    const afm::test::NoAllocation none;
    (void)tapped.model.step(Length(1e-9 * (18.0 + 4.0 * std::sin(0.01 * i))));
  };
  for (int i = 0; i < 4000; ++i) {
    const auto start = std::chrono::steady_clock::now();
    tick(i);
    us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(us.begin(), us.end());
  RecordProperty("step_p50_us", std::to_string(us[us.size() / 2]));
  RecordProperty("step_p99_us", std::to_string(us[us.size() * 99 / 100]));
}

// Mica under the program's own tip, in water: the ring of a contact of 50 GPa is much faster than the relaxation.
TEST(TappingModel, RestsOnAStiffSampleAndJumpsOnce) {
  const TappedSample mica{.r_nm = 50.0, .h_zj = 24.5, .e_gpa = 51.5, .gap_nm = 0.3};
  Tapped tapped(mica);
  AveragedFlow flow(tapped.surface, tapped.lever);
  for (const double nm_per_tick : {0.01, 0.1}) {
    Path path;
    tapped.model.wait_for_lift();
    (void)tapped.model.step(24_nm);
    move(tapped.model, 24.0, 20.0, nm_per_tick, path);
    for (const double z_nm : {16.0, 10.0, 5.0, 2.5}) {
      move(tapped.model, z_nm + 4.0, z_nm, nm_per_tick, path);
      for (int i = 0; i < 300; ++i) (void)tapped.model.step(Length(z_nm * 1e-9));
      double rest_nm = 0.0;
      for (const RestingTap& tap : flow.resting_at(Length(z_nm * 1e-9))) {
        if (tap.stable) rest_nm = std::max(rest_nm, tap.state.amplitude.si * 1e9);
      }
      EXPECT_NEAR(tapped.model.amplitude().si * 1e9, rest_nm, 0.02) << z_nm << " nm, " << nm_per_tick << " nm a tick";
    }
    EXPECT_LE(path.events.size(), 1U) << nm_per_tick;
  }
}

}  // namespace tapping_model_test
}  // namespace afm::physics
