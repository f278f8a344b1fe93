// SPDX-License-Identifier: Apache-2.0
// A tip on a soft surface: depth, force, volumes, repeated passes, and the energy of the hand.
// Invariant: no path of the hand gains energy from a soft sample, and the volumes of its marks add up
#include "physics/manipulation/scratching_tip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "scratching.h"
#include "support/deep.h"
#include "support/no_alloc.h"

namespace afm::physics {
namespace scratching_test {

using test::base_at;
using test::marking_tip;
using test::on_pmma;
using test::pmma;
using test::scratch;

constexpr double kStep = 0.1e-9;  // step of a tick at 0.1 um/s and 1 kHz

// Mean results of a tip on a path at about 100 nN, over its second half.
struct Mean {
  double load_n = 0.0, lateral_n = 0.0, depth_m = 0.0;
};
Mean groove(ScratchingTip& tip, const LeverBase& to, double step_m = kStep) {
  const LeverBase from = tip.last().base;
  const double length_m = magnitude(to.position - from.position).si;
  Mean mean;
  int count = 0;
  scratch(tip, to, step_m, [&](const ScratchTick& tick) {
    if (magnitude(tick.base.position - from.position).si < 0.5 * length_m) return;
    mean.load_n += tick.load.si;
    mean.lateral_n += magnitude(tick.lateral).si;
    mean.depth_m -= tick.apex.z.si;
    ++count;
  });
  return {mean.load_n / count, mean.lateral_n / count, mean.depth_m / count};
}

void press(ScratchingTip& tip, double z_m) {
  const Sideways<Length> here = tip.last().base.position;
  scratch(tip, {here, Length(z_m)}, kStep);
}
void move_above(ScratchingTip& tip, double x_m, double y_m) {
  press(tip, 80e-9);
  scratch(tip, base_at(x_m, y_m, 80e-9), 2e-9);
}

TEST(Scratching, AStandingTipSinksAsInN59) {
  ScratchingTip tip = on_pmma();
  press(tip, -51.37e-9);
  EXPECT_EQ(tip.last().lateral, Sideways<Force>{});
  const Force load = tip.last().load;
  EXPECT_NEAR(load.si, 50e-9, 0.5e-9);
  // squares of 2.5 nm hold a contact of 7.3 nm
  EXPECT_NEAR(-tip.last().apex.z.si, imprint_depth(marking_tip(), pmma(), load).si, 0.2e-9);
  press(tip, 50e-9);
  EXPECT_EQ(tip.last().state, ScratchState::Free);
  EXPECT_NEAR(-tip.surface().height({}).si, 0.624e-9, 0.3e-9);
}

TEST(Scratching, ADraggedTipDigsAsInN60AndN62) {
  for (const double angle : {0.0, 0.3, 0.785}) {
    ScratchingTip tip = on_pmma();
    move_above(tip, -100e-9 * std::cos(angle), -100e-9 * std::sin(angle));
    press(tip, -106.3e-9);
    const Mean mean = groove(tip, base_at(100e-9 * std::cos(angle), 100e-9 * std::sin(angle), -106.3e-9));
    const Length depth = groove_depth(marking_tip(), pmma(), Force(mean.load_n));
    EXPECT_NEAR(mean.depth_m, depth.si, 0.06 * depth.si) << angle;
    const double force = (pmma().hardness * groove_section(marking_tip(), depth)).si;
    EXPECT_NEAR(mean.lateral_n, force, 0.1 * force) << angle;
    // against the motion
    EXPECT_LT(tip.last().lateral.x.si, 0.0);
    press(tip, 50e-9);
    const GrooveSection section = tip.surface().section(
        base_at(-100e-9 * std::cos(angle), -100e-9 * std::sin(angle)).position, tip.last().base.position);
    const Length radius = groove_radius(pmma(), Force(mean.load_n));
    EXPECT_NEAR(section.width.si, 2.0 * radius.si, 0.12 * 2.0 * radius.si) << angle;
    const double left_m = mean.depth_m - spring_back(pmma(), Force(mean.load_n), radius).si;
    EXPECT_NEAR(section.depth.si, left_m, 0.1 * left_m) << angle;
    // ridges of the material that has not sprung back: the section less two thirds of width times height
    const Area stays = groove_section(marking_tip(), depth) -
                       2.0 / 3.0 * (spring_back(pmma(), Force(mean.load_n), radius) * (2.0 * radius));
    const double ridge_m = ridge_height(stays, 0.7, 2.0 * radius).si;
    EXPECT_NEAR(section.ridge.si, ridge_m, 0.25 * ridge_m) << angle;
  }
}

TEST(Scratching, EveryPassDigsLessAndVolumesAreKept) {
  ScratchingTip tip = on_pmma();
  std::vector<double> dug_m;
  double before_m = 0.0;
  for (int pass = 0; pass < 5; ++pass) {
    move_above(tip, -100e-9, 3e-9);
    press(tip, -110e-9);
    groove(tip, base_at(100e-9, 3e-9, -110e-9));
    press(tip, 80e-9);
    const GrooveSection section =
        tip.surface().section(base_at(-100e-9, 3e-9).position, base_at(100e-9, 3e-9).position);
    dug_m.push_back(section.depth.si - before_m);
    before_m = section.depth.si;
    // volumes according to the books and to the grid
    const MarkVolumes volumes = tip.surface().volumes();
    const double for_good_m3 = (volumes.pressed - volumes.sprung_back).si;
    EXPECT_NEAR((tip.surface().below() - tip.surface().above()).si, for_good_m3 - volumes.ridges.si,
                1e-6 * for_good_m3);
    EXPECT_NEAR(volumes.ridges.si, 0.7 * for_good_m3, 1e-6 * for_good_m3);
    EXPECT_NEAR(volumes.densified.si, 0.3 * for_good_m3, 1e-6 * for_good_m3);
    EXPECT_EQ(volumes.under_way.si, 0.0);
    EXPECT_GT(volumes.sprung_back.si, 0.0);
    EXPECT_NEAR(tip.last().lost.si, pmma().hardness.si * volumes.pressed.si, 1e-9 * tip.last().lost.si);
  }
  EXPECT_GT(dug_m[0], 4e-9);
  for (std::size_t i = 1; i < dug_m.size(); ++i) {
    EXPECT_LT(dug_m[i], dug_m[i - 1]) << i;
    EXPECT_GT(dug_m[i], 0.0) << i;
  }
}

TEST(Scratching, TheGrooveDoesNotDependOnTheRateOfTicks) {
  double reference_m = 0.0;
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    ScratchingTip tip = on_pmma();
    move_above(tip, -100e-9, 0.0);
    press(tip, -106.3e-9);
    groove(tip, base_at(100e-9, 10e-9, -106.3e-9), 1e-7 / rate_hz);
    press(tip, 50e-9);
    const double depth_m = tip.surface().section(base_at(-100e-9).position, base_at(100e-9, 10e-9).position).depth.si;
    if (reference_m == 0.0) reference_m = depth_m;
    EXPECT_NEAR(depth_m, reference_m, 0.03 * reference_m) << rate_hz;
  }
}

// In its own imprint a tip does not mark, up to the load that made the imprint.
TEST(Scratching, AnImprintBearsTheLoadThatMadeIt) {
  ScratchingTip tip = on_pmma();
  press(tip, -60e-9);
  press(tip, -40e-9);
  const double lost_j = tip.last().lost.si;
  press(tip, -59e-9);
  EXPECT_EQ(tip.last().state, ScratchState::Holds);
  EXPECT_EQ(tip.last().lost.si, lost_j);
  press(tip, -90e-9);
  EXPECT_GT(tip.last().lost.si, lost_j);
}

// What a look at all squares one by one finds, with the exact outline of the tip: the lever presses with what bears,
// the displaced volume and the resistance are those of the squares, and the expected apex does not change a bit.
TEST(Scratching, ALookFindsWhatEachSquareBears) {
  SoftSurface soft = pmma();
  soft.reduced_modulus = Pressure(1e15);  // nothing springs back: the seen heights are those under the tip
  const PushSprings springs{Stiffness(10.0), Stiffness(1.0), Stiffness(1.0)};
  ScratchingTip tip(marking_tip(), springs, soft, {Length(-60e-9), Length(-60e-9)}, {Length(60e-9), Length(60e-9)},
                    base_at(0.0, 0.0, 50e-9));
  for (const double x_m : {-30e-9, 0.0, 20e-9}) {
    move_above(tip, x_m, -50e-9);
    press(tip, -120e-9);
    scratch(tip, base_at(-x_m, 40e-9, -100e-9), kStep);
  }
  press(tip, 50e-9);
  const MarkedSurface& surface = tip.surface();
  const TipOutline outline(marking_tip());
  const double square_m2 = surface.spacing().si * surface.spacing().si, within_m = 4e-4 * marking_tip().radius.si;
  const auto each_begin = [&](const Sideways<Length>& place, const auto& look) {
    for (std::size_t row = 0; row < surface.rows(); ++row) {
      for (std::size_t column = 0; column < surface.columns(); ++column) {
        const Sideways<Length> at =
            surface.middle_of_first() + Sideways<Length>{static_cast<double>(column) * surface.spacing(),
                                                         static_cast<double>(row) * surface.spacing()};
        look((surface.square(column, row) - outline.height_at(magnitude(at - place))).si);
      }
    }
  };
  std::mt19937_64 random(11);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  double resisted_n = 0.0, off_n = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Sideways<Length> place{Length(uniform(-60e-9, 60e-9)), Length(uniform(-60e-9, 60e-9))};
    const double angle = uniform(0.0, 6.3);
    const Sideways<double> along{std::cos(angle), std::sin(angle)};
    const Length base(-std::exp(uniform(std::log(2e-9), std::log(180e-9))));
    const auto look = [&](double way_m, Length about) {
      return surface.sink(place + Sideways<Length>{Length(way_m * along.x), Length(way_m * along.y)}, along, base,
                          springs.normal, about);
    };
    const Sunk sunk = look(0.0, Length(0.0));
    for (const double about_m : {-150e-9, sunk.apex.si, 20e-9}) {
      const Sunk again = look(0.0, Length(about_m));
      ASSERT_EQ(again.apex, sunk.apex);
      ASSERT_EQ(again.displaced, sunk.displaced);
      ASSERT_EQ(again.resistance, sunk.resistance);
    }
    double most_n = 0.0, least_n = 0.0, displaced_m3 = 0.0, bears_m2 = 0.0;
    each_begin(place, [&](double begin_m) {
      if (begin_m > sunk.apex.si - within_m) most_n += soft.hardness.si * square_m2;
      if (begin_m > sunk.apex.si + within_m) least_n += soft.hardness.si * square_m2;
      if (begin_m > sunk.apex.si) bears_m2 += square_m2;
      displaced_m3 += square_m2 * std::max(0.0, begin_m - sunk.apex.si);
    });
    const double load_n = (springs.normal * (sunk.apex - base)).si;
    EXPECT_GE(load_n, least_n - 1e-15) << i;
    EXPECT_LE(load_n, most_n + 1e-15) << i;
    EXPECT_NEAR(sunk.displaced.si, displaced_m3, (bears_m2 + square_m2) * within_m) << i;
    const auto energy_j = [&](const Sunk& at) {
      const Length bent = at.apex - base;
      return (0.5 * (springs.normal * (bent * bent)) + soft.hardness * at.displaced).si;
    };
    constexpr double kStepM = 1e-13;
    const double slope_n = (energy_j(look(kStepM, sunk.apex)) - energy_j(look(-kStepM, sunk.apex))) / (2.0 * kStepM);
    resisted_n += std::abs(slope_n);
    off_n += std::abs(sunk.resistance.si - slope_n);
  }
  EXPECT_GT(resisted_n, 0.0);
  EXPECT_LT(off_n, 0.01 * resisted_n);
}

TEST(Scratching, StopsAtTheLowestHeightOfTheModel) {
  ScratchingTip tip = on_pmma({Stiffness(10.0), Stiffness(100.0), Stiffness(100.0)});
  press(tip, -300e-9);
  EXPECT_TRUE(tip.last().stops);
  EXPECT_EQ(tip.last().apex.z, tip.surface().deepest());
  press(tip, 50e-9);
  EXPECT_FALSE(tip.last().stops);
}

TEST(Scratching, IgnoresPlacesWhereThereIsNoSurface) {
  ScratchingTip tip = on_pmma();
  press(tip, -20e-9);
  const LeverBase before = tip.last().base;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const LeverBase& wrong :
       {base_at(nan), base_at(0.0, nan), base_at(0.0, 0.0, nan), base_at(1.0), base_at(0.0, -1.0)}) {
    tip.move_to(wrong);
    EXPECT_EQ(tip.last().base.position, before.position);
    EXPECT_EQ(tip.last().base.z, before.z);
  }
  const auto on_field = [](double side_m, double start_m) {
    return ScratchingTip(marking_tip(), {Stiffness(10.0), Stiffness(1.0), Stiffness(1.0)}, pmma(), {},
                         {Length(side_m), Length(side_m)}, base_at(start_m, 0.0, 1e-9));
  };
  const double longest_m = MarkedSurface::longest_side(marking_tip()).si;
  EXPECT_NO_THROW(on_field(longest_m, longest_m));
  EXPECT_THROW(on_field(1.01 * longest_m, 0.0), std::invalid_argument);
  EXPECT_THROW(on_field(100e-9, 1e-6), std::invalid_argument);
}

// No path of the hand takes energy out of the lever, and the surface only absorbs energy: N65.
TEST(ScratchCertificate, HoldsOnRandomPaths) {
  const int paths = support::deep() ? 60 : 6, ticks = 3000;
  long marks = 0;
  for (int path = 0; path < paths; ++path) {
    std::mt19937_64 random(static_cast<std::uint64_t>(path) + 1);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const auto spring = [&] { return Stiffness(std::exp(uniform(std::log(0.1), std::log(50.0)))); };
    ScratchingTip tip = on_pmma({spring(), spring(), Stiffness(1.0)});
    const double deepest_m = -uniform(10e-9, 150e-9);
    double x = 0.0, y = 0.0, z = 0.0, dx = 0.0, dy = 0.0, dz = 0.0, before_j = 0.0, lost_j = 0.0, largest_j = 0.0;
    int left = 0;
    for (int i = 0; i < ticks; ++i) {
      if (left-- <= 0) {
        left = std::uniform_int_distribution(1, 200)(random);
        const double speed = std::exp(uniform(std::log(1e-12), std::log(20e-9))), angle = uniform(0.0, 6.3);
        dx = speed * std::cos(angle);
        dy = speed * std::sin(angle);
        dz = uniform(0.0, 1.0) < 0.5 ? uniform(-1.0, 1.0) * speed : 0.0;
      }
      x = std::clamp(x + dx, -300e-9, 300e-9);
      y = std::clamp(y + dy, -150e-9, 150e-9);
      z = std::clamp(z + dz, deepest_m, 30e-9);
      const ScratchTick& tick = [&]() -> const ScratchTick& {
        const afm::test::NoAllocation no_allocation;
        return tip.move_to(base_at(x, y, z));
      }();
      largest_j = std::max({largest_j, std::abs(tick.given.si), tick.lost.si, tick.stored.si});
      const double surplus_j = (tick.given - tick.lost - tick.stored).si;
      ASSERT_GE(surplus_j - before_j, -1e-12 * largest_j) << "path " << path << ", tick " << i;
      ASSERT_GE(tick.lost.si, lost_j);
      before_j = surplus_j;
      lost_j = tick.lost.si;
      if (tick.state == ScratchState::Marks) ++marks;
    }
    const MarkVolumes volumes = tip.surface().volumes();
    EXPECT_NEAR((tip.surface().below() - tip.surface().above()).si,
                (volumes.pressed - volumes.sprung_back - volumes.ridges).si, 1e-6 * volumes.pressed.si);
    EXPECT_GE(volumes.densified.si, -1e-9 * volumes.pressed.si);
    // a path back to the start gives the hand no energy
    scratch(tip, base_at(x, y, 50e-9), 1e-9);
    EXPECT_EQ(tip.last().stored.si, 0.0);
    EXPECT_GE(tip.last().work.si, -1e-12 * largest_j);
  }
  EXPECT_GT(marks, paths * ticks / 20);
}

}  // namespace scratching_test
}  // namespace afm::physics
