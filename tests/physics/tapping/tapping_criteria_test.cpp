// SPDX-License-Identifier: Apache-2.0
// The averaged motion and the envelope of hand and image against direct integration, on random levers and samples.
// Invariant: averaged tapping rests, falls and ends where direct integration does
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/swing_map.h"
#include "physics/tapping/tap_envelope.h"
#include "physics/tapping/tapped_sample.h"
#include "physics/tapping/tapping_curve.h"
#include "physics/tapping/tapping_oscillator.h"
#include "support/deep.h"

namespace afm::physics {
namespace tapping_criteria_test {

using namespace literals;
using support::deep;

// Runs one task for each set-up, on all cores, which fills in its result.
template <class Case>
void run_all(std::vector<Case>& cases, const std::function<void(Case&)>& task) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < cases.size(); i = next++) task(cases[i]);
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

std::string text_of(const TappedSample& s) {
  const auto text = [](const char* name, double value) { return std::string(name) + std::to_string(value); };
  return text(" k ", s.k) + text(" Q ", s.q) + text(" A0 ", s.a0_nm) + text(" R ", s.r_nm) + text(" H ", s.h_zj) +
         text(" E ", s.e_gpa);
}

// Distance of a swing from a root: amplitude relative to both, phase in degrees.
struct Apart {
  double share, degrees;
};
Apart apart(const TapState& a, const TapState& b) {
  const double turn = std::remainder(a.phase - b.phase, 2.0 * std::numbers::pi);
  return {abs(a.amplitude - b.amplitude) / b.amplitude, std::abs(degrees_of(turn))};
}

// The root nearest to a swing; -1 without one.
int nearest_root(const std::vector<RestingTap>& roots, const TapState& swing) {
  int nearest = -1;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const Apart from = apart(swing, roots[i].state);
    const double distance = std::hypot(from.share, from.degrees / 60.0);
    if (!roots[i].stable || distance >= least) continue;
    least = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

struct RestCase {
  TappedSample sample;
  Length z;
  bool with_envelope;         // model with a table, a second of work
  std::size_t elsewhere = 0;  // number of states that direct integration leaves
  struct Pair {
    TapState averaged, enveloped, direct;
  };
  std::vector<Pair> pairs{};
};

// Bounds of the criterion: share of the amplitude, degrees.
constexpr Apart kAtRest{3e-3, 0.5};
bool beyond(const Apart& from, const Apart& bound) { return from.share > bound.share || from.degrees > bound.degrees; }

// The point at the drive's angle of zero of a swing about its mean deflection, which is large where a tip sticks.
TapState beginning_of(const RestingTap& tap) {
  const double x = tap.deflection.si + tap.state.amplitude.si * std::cos(tap.state.phase);
  const double v = tap.state.amplitude.si * std::sin(tap.state.phase);
  return {Length(std::hypot(x, v)), std::atan2(v, x)};
}

// The stable roots at one height, and where direct integration and the envelope rest that begin in them.
void rest(RestCase& one) {
  const auto surface = one.sample.surface();
  AveragedFlow flow(surface, one.sample.lever());
  TappingOscillator tip(surface, one.sample.lever());
  const std::vector<RestingTap> roots = flow.resting_at(one.z);
  std::optional<TapEnvelope> envelope;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (!roots[i].stable) continue;
    tip.place(one.z, beginning_of(roots[i]));
    (void)tip.settle();
    TapState direct = resting_tap(tip.settle()).state;
    // another state, perhaps one that is not among the roots
    if (nearest_root(roots, direct) != static_cast<int>(i) || apart(direct, roots[i].state).degrees > 10.0) {
      ++one.elsewhere;
      continue;
    }
    // usual steps hold a soft lever at phases of their own, up to 0.6 degrees off
    constexpr int kFiner = 4 * TappingOscillator::kUsualSteps;
    if (beyond(apart(direct, roots[i].state), kAtRest)) {
      TappingOscillator finer(surface, one.sample.lever(), kFiner);
      finer.place(one.z, beginning_of(roots[i]));
      (void)finer.settle();
      direct = resting_tap(finer.settle()).state;
    }
    RestCase::Pair pair{roots[i].state, roots[i].state, direct};
    // for a hand, a swing below a twentieth of the free one counts as stopped
    if (one.with_envelope && roots[i].state.amplitude > 0.05 * one.sample.lever().free_amplitude) {
      if (!envelope) envelope.emplace(flow, surface->contact_height());
      envelope->place(roots[i].state, one.z.si);
      for (int n = 0; n < 40; ++n) envelope->advance(one.z.si, one.z.si, 2.0 * one.sample.q, 2000);
      pair.enveloped = {Length(envelope->amplitude_m()), envelope->phase_rad()};
      if (nearest_root(roots, pair.enveloped) != static_cast<int>(i)) continue;
    }
    one.pairs.push_back(pair);
  }
}

// Criterion: 200 random set-ups, at rest within 0.3 % of A and 0.5 degrees where both rest in the same state.
TEST(TappingDeep, TheEnvelopeRestsWhereDirectIntegrationDoes) {
  RandomInteraction random(11);
  std::vector<RestCase> cases;
  for (int i = 0, count = deep() ? 200 : 4; i < count; ++i) {
    const TappedSample sample = random_tapped_sample(random);
    const Length z(sample.a0_nm * 1e-9 * random.between(0.3, 1.0));
    cases.push_back({.sample = sample, .z = z, .with_envelope = i % 4 == 0});
  }
  run_all<RestCase>(cases, rest);
  std::size_t compared = 0, elsewhere = 0, outside = 0, outside_envelope = 0;
  double most_share = 0.0, most_degrees = 0.0;
  for (const RestCase& one : cases) {
    elsewhere += one.elsewhere;
    for (const RestCase::Pair& pair : one.pairs) {
      ++compared;
      const Apart flow = apart(pair.averaged, pair.direct), envelope = apart(pair.enveloped, pair.direct);
      most_share = std::max(most_share, envelope.share);
      most_degrees = std::max(most_degrees, envelope.degrees);
      outside += beyond(flow, kAtRest) ? 1U : 0U;
      outside_envelope += beyond(envelope, kAtRest) ? 1U : 0U;
      EXPECT_LE(envelope.share, kAtRest.share) << text_of(one.sample) << " z " << nm_of(one.z) << " A "
                                               << nm_of(pair.direct.amplitude) << " flow " << flow.share;
      EXPECT_LE(envelope.degrees, kAtRest.degrees) << text_of(one.sample) << " z " << nm_of(one.z) << " A "
                                                   << nm_of(pair.direct.amplitude) << " flow " << flow.degrees;
    }
  }
  RecordProperty("compared", std::to_string(compared));
  RecordProperty("elsewhere", std::to_string(elsewhere));
  RecordProperty("outside_flow", std::to_string(outside));
  RecordProperty("outside_envelope", std::to_string(outside_envelope));
  RecordProperty("most_share", std::to_string(most_share));
  RecordProperty("most_degrees", std::to_string(most_degrees));
  EXPECT_GE(compared, cases.size());
  EXPECT_LE(elsewhere, compared / 30 + 2);
}

struct StartCase {
  TappedSample sample;
  Length z;
  std::vector<TapState> starts{};
  struct Unknown {
    DirectSwing swing;
    double moved;  // change from one swing to the next, relative to the free amplitude
  };
  std::vector<Unknown> unknown{};  // swings that match no known state, without repetitions
  std::size_t averaged = 0, mapped = 0;
};

bool same(const TapState& a, const TapState& b) {
  const Apart from = apart(a, b);
  // the steps of direct integration hold a swing over a stiff contact at phases of their own
  return from.share < 0.01 && from.degrees < 2.0;
}

// Swings on from every start until it is clearly in a known state, or for ten relaxations.
void start_anywhere(StartCase& one) {
  const auto surface = one.sample.surface();
  AveragedFlow flow(surface, one.sample.lever());
  std::vector<RestingTap> roots = flow.resting_at(one.z);
  one.averaged = roots.size();
  std::vector<TapState> averaged;
  for (const RestingTap& root : roots) averaged.push_back(root.state);
  SwingMap map(surface, one.sample.lever());
  for (const DirectSwing& beside : map.stable_beside(averaged, one.z)) {
    roots.push_back(resting_tap(beside));
    ++one.mapped;
  }
  TappingOscillator tip(surface, one.sample.lever());
  const auto known = [&](const TapState& swing) {
    const int root = nearest_root(roots, swing);
    return (root >= 0 && same(swing, roots[static_cast<std::size_t>(root)].state)) ||
           std::any_of(one.unknown.begin(), one.unknown.end(),
                       [&](const StartCase::Unknown& seen) { return same(swing, resting_tap(seen.swing).state); });
  };
  constexpr double kAnyChange = 1e9;  // settle() then takes 67 swings
  const int stretches = static_cast<int>(std::ceil(0.5 * one.sample.q / 67.0));
  for (const TapState& start : one.starts) {
    tip.place(one.z, start);
    int in_root = 0;
    for (int n = 0; n < 40 && in_root < 2; ++n) {
      for (int i = 1; i < stretches; ++i) (void)tip.settle(kAnyChange);
      in_root = known(resting_tap(tip.settle(kAnyChange)).state) ? in_root + 1 : 0;
    }
    if (in_root == 2) continue;
    const DirectSwing swing = tip.settle();
    const TapState here = tip.advance(1), next = tip.advance(1);
    const auto x = [](const TapState& at) { return at.amplitude.si * std::cos(at.phase); };
    const auto v = [](const TapState& at) { return at.amplitude.si * std::sin(at.phase); };
    one.unknown.push_back({swing, std::hypot(x(next) - x(here), v(next) - v(here)) / (one.sample.a0_nm * 1e-9)});
  }
}

// Criterion: `states` finds every root that 1000 random starts of direct integration find, on 20 set-ups: averages and
// the map of a swing together, for over soft levers that adhere the averages lack some. A swing that is none of them
// does not rest: it differs from the next one. A tenth of the starts has to do.
TEST(TappingDeep, EveryStateOfDirectIntegrationIsAmongTheAveragedOnes) {
  RandomInteraction random(12);
  std::vector<StartCase> cases;
  for (int i = 0, count = deep() ? 20 : 2; i < count; ++i) {
    TappedSample sample = random_tapped_sample(random);
    if (!deep()) sample.q = 100.0;
    StartCase one{sample, Length(sample.a0_nm * 1e-9 * random.between(0.5, 0.95))};
    for (int j = 0, starts = deep() ? 100 : 8; j < starts; ++j) {
      const Length amplitude(sample.a0_nm * 1e-9 * random.between(0.05, 1.1));
      one.starts.push_back({amplitude, random.between(0.1, 3.1)});
    }
    cases.push_back(one);
  }
  run_all<StartCase>(cases, start_anywhere);
  std::size_t mapped = 0, restless = 0;
  for (const StartCase& one : cases) {
    mapped += one.mapped;
    restless += one.unknown.size();
    for (const StartCase::Unknown& lost : one.unknown) {
      EXPECT_GT(lost.moved, 1e-3) << text_of(one.sample) << " z " << nm_of(one.z) << " averaged " << one.averaged
                                  << " mapped " << one.mapped << " A " << nm_of(lost.swing.state.amplitude) << " phase "
                                  << degrees_of(lost.swing.state.phase);
    }
  }
  RecordProperty("mapped", std::to_string(mapped));
  RecordProperty("restless", std::to_string(restless));
}

struct FoldCase {
  TappedSample sample;
  struct Bracket {
    Branch branch;
    Length fold, before, after;  // heights of the base: of the fold, and of the steps before and after it
  };
  std::vector<Bracket> brackets{};
};

// Direct integration in steps of 0.02 nm over each fold, from rest to rest.
void bracket(FoldCase& one) {
  const auto surface = one.sample.surface();
  const Length a0(one.sample.a0_nm * 1e-9), step = 0.02_nm, margin = 0.2_nm;
  const TappingCurve curve =
      record_tapping_curve(surface, one.sample.lever(), {{1.1 * a0, 0.5 * a0, 0.1_nm}, {}}, TapMethod::Averaged);
  AveragedFlow flow(surface, one.sample.lever());
  TappingOscillator tip(surface, one.sample.lever());
  for (const TapJump& jump : curve.jumps) {
    const Length way = jump.branch == Branch::Approach ? -step : step;
    Length z = jump.z - way * (margin / step);
    tip.place(z, flow.settle(jump.before, z).state);
    const auto at_rest = [&] {
      (void)tip.settle();
      return resting_tap(tip.settle()).state;
    };
    TapState state = at_rest();
    FoldCase::Bracket found{jump.branch, jump.z, z, Length()};
    while (abs(z - jump.z) < 1.6 * margin) {
      const Length next = z + way;
      tip.set_base(next);
      const TapState moved = at_rest();
      const bool fell = apart(moved, jump.after).degrees < apart(moved, jump.before).degrees;
      if (fell) {
        found.before = z;
        found.after = next;
        break;
      }
      state = moved;
      z = next;
    }
    one.brackets.push_back(found);
  }
}

// Criterion: direct integration in steps of 0.02 nm brackets the folds within 0.1 nm, on 10 set-ups.
TEST(TappingDeep, DirectIntegrationBracketsTheFolds) {
  RandomInteraction random(15);
  std::vector<FoldCase> cases{{TappedSample{}}};
  for (int i = 1, count = deep() ? 24 : 1; i < count; ++i) {
    cases.push_back({TappedSample{.k = random.between(20.0, 50.0),
                                  .q = random.between(200.0, 500.0),
                                  .a0_nm = random.between(18.0, 30.0),
                                  .r_nm = random.between(10.0, 30.0),
                                  .h_zj = random.between(30.0, 100.0),
                                  .e_gpa = random.between(1.0, 4.0)}});
  }
  run_all<FoldCase>(cases, bracket);
  // other set-ups change their swing without a jump
  std::erase_if(cases, [](const FoldCase& one) { return one.brackets.empty(); });
  EXPECT_GE(cases.size(), deep() ? 10U : 1U);
  for (const FoldCase& one : cases) {
    EXPECT_GE(one.brackets.size(), 2U) << text_of(one.sample);
    for (const FoldCase::Bracket& found : one.brackets) {
      const char* way = found.branch == Branch::Approach ? " down" : " up";
      ASSERT_GT(found.after.si, 0.0) << "it never fell" << text_of(one.sample) << way;
      EXPECT_LE(nm_of(abs(found.before - found.fold)), 0.1) << text_of(one.sample) << way;
      EXPECT_LE(nm_of(abs(found.after - found.fold)), 0.1) << text_of(one.sample) << way;
    }
  }
}

struct SpeedCase {
  TappedSample sample;
  Velocity speed;
  TappingCurve averaged{}, direct{};
};

// Criterion: under a base of 0.02 to 5 um/s the averaged motion jumps within 0.1 nm of direct integration, on 20
// set-ups.
TEST(TappingDeep, TheAveragedFlowJumpsWhereDirectIntegrationDoes) {
  RandomInteraction random(14);
  std::vector<SpeedCase> cases;
  for (int i = 0, count = deep() ? 20 : 2; i < count; ++i) {
    const TappedSample sample{.k = random.between(10.0, 50.0),
                              .q = random.between(200.0, 600.0),
                              .a0_nm = random.between(15.0, 30.0),
                              .r_nm = random.between(10.0, 30.0),
                              .h_zj = random.between(30.0, 120.0),
                              .e_gpa = random.between(1.0, 5.0)};
    cases.push_back({sample, Velocity(random.between(deep() ? 0.02e-6 : 0.5e-6, 5e-6))});
  }
  run_all<SpeedCase>(cases, [](SpeedCase& one) {
    const TapPath path{{Length(one.sample.a0_nm * 1.05e-9), Length(one.sample.a0_nm * 0.6e-9), 0.02_nm}, one.speed};
    one.averaged = record_tapping_curve(one.sample.surface(), one.sample.lever(), path, TapMethod::Averaged);
    one.direct = record_tapping_curve(one.sample.surface(), one.sample.lever(), path, TapMethod::Direct);
  });
  std::size_t compared = 0;
  for (const SpeedCase& one : cases) {
    ASSERT_EQ(one.averaged.jumps.size(), one.direct.jumps.size()) << text_of(one.sample);
    for (std::size_t i = 0; i < one.averaged.jumps.size(); ++i) {
      ++compared;
      ASSERT_EQ(one.averaged.jumps[i].branch, one.direct.jumps[i].branch);
      EXPECT_NEAR(nm_of(one.averaged.jumps[i].z), nm_of(one.direct.jumps[i].z), 0.1)
          << text_of(one.sample) << " speed " << one.speed.si << " jump " << i;
    }
  }
  EXPECT_GE(compared, cases.size());
}

}  // namespace tapping_criteria_test
}  // namespace afm::physics
