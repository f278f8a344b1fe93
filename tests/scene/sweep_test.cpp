// SPDX-License-Identifier: Apache-2.0
// The sweep of a scripted hand: its lines, what they do to a sphere (N38), and the shipped set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/whole_file.h"
#include "scene/samples/hand_script.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/scripted_push.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace sweep_test {

using physics::Force;
using physics::Length;
using physics::LeverBase;
using physics::Sideways;
using physics::Velocity;
using testing::HasSubstr;

const std::string kFile = support::source("assets/particles/sweep-gold.toml");

LeverBase at(double x_m, double y_m) { return {{Length(x_m), Length(y_m)}, Length(0.0)}; }

TEST(Sweep, GoesThereAndBackAcrossItsWay) {
  const LeverBase from = at(10e-9, 20e-9);
  // a way of 50 nm: 13 lines
  const HandMove move{
      .to = at(40e-9, 60e-9), .speed = Velocity(1e-6), .sweep_width = Length(100e-9), .line_spacing = Length(4e-9)};
  EXPECT_EQ(lines_of(from, move), 13.0);
  const std::size_t ticks = ticks_of(from, move, physics::Frequency(1e4));
  EXPECT_EQ(ticks, 14500U);  // 50 nm + 14 x 100 nm, 0.1 nm each
  double before_ahead_m = 0.0, before_aside_m = 0.0;
  int turns = 0;
  bool to_the_left = true;
  for (std::size_t i = 1; i <= ticks; ++i) {
    const LeverBase base = on_the_way(from, move, static_cast<double>(i) / static_cast<double>(ticks));
    const Sideways<Length> gone = base.position - from.position;
    const double ahead_m = 0.6 * gone.x.si + 0.8 * gone.y.si, aside_m = 0.6 * gone.y.si - 0.8 * gone.x.si;
    const double step_m = std::abs(ahead_m - before_ahead_m) + std::abs(aside_m - before_aside_m);
    ASSERT_NEAR(step_m, 0.1e-9, 1e-15) << i;
    ASSERT_LE(std::abs(aside_m), 50e-9 + 1e-15) << i;
    const double aside_by_m = aside_m - before_aside_m;
    if (std::abs(aside_by_m) > 0.05e-9 && (aside_by_m > 0.0) != to_the_left) {
      // at the side, one spacing farther than the last time
      EXPECT_NEAR(std::abs(before_aside_m), 50e-9, 0.11e-9) << i;
      EXPECT_NEAR(ahead_m, std::min(++turns, 13) * 50e-9 / 13.0, 0.11e-9) << i;
      to_the_left = !to_the_left;
    }
    before_ahead_m = ahead_m;
    before_aside_m = aside_m;
  }
  EXPECT_EQ(turns, 14);  // the last one to the end
  EXPECT_EQ(on_the_way(from, move, 1.0).position, move.to.position);
}

// One sphere with hardly any friction on the sample, below stiff springs.
class SweptSphere : public testing::Test {
 protected:
  SweptSphere() : set_(load_particle_set(kFile).value()) {
    set_.particles.resize(1);
    set_.particles[0].position = {};
    physics::ParticleSpecies& gold = set_.setup.species[0];
    gold.law = physics::ParticleLaw::Measured;
    gold.measured_threshold = Force(1e-15);
    gold.kinetic_ratio = 1.0;
    set_.start = at(-60e-9, 0.0);
    set_.moves.clear();
  }

  Sideways<Length> end() const { return play(set_, {.rate = physics::Frequency(1000.0)}).at[0].position; }

  // Distance of the axes of tip and sphere at z = 0 (M1).
  double rho_m() const {
    const double sine = std::sin(set_.setup.tip.half_angle_rad), cosine = std::cos(set_.setup.tip.half_angle_rad);
    const double tip_m = set_.setup.tip.radius.si, sphere_m = set_.setup.species[0].contact.tip_radius.si;
    return (tip_m + sphere_m + sine * (sphere_m - tip_m)) / cosine;
  }

  ParticleSet set_;
};

TEST_F(SweptSphere, N38GoesOneSpacingALineAndNeverAlongTheLines) {
  const double spacing_m = 0.1 * rho_m();
  const auto after = [&](int lines) {
    set_.moves = {{.to = at(-60e-9 + lines * spacing_m, 0.0),
                   .speed = Velocity(2e-6),
                   .sweep_width = Length(200e-9),
                   .line_spacing = Length(1.000001 * spacing_m)}};
    return end();
  };
  const Sideways<Length> before = after(40), later = after(60);
  EXPECT_NEAR((later.x - before.x).si / 20.0, 0.1 * rho_m(), 1e-6 * rho_m());
  EXPECT_NEAR((later.y - before.y).si / 20.0, 0.0, 1e-6 * rho_m());
}

TEST_F(SweptSphere, N38OneWayLinesDrift) {
  const double spacing_m = 0.1 * rho_m(), half_m = 300e-9;
  const auto after = [&](int lines) {
    set_.moves.clear();
    for (int i = 0; i < lines; ++i) {
      const double x_m = -60e-9 + i * spacing_m;
      for (const auto& [y_m, z_m] : {std::pair{-half_m, 200e-9}, {-half_m, 0.0}, {half_m, 0.0}, {half_m, 200e-9}}) {
        set_.moves.push_back({.to = {{Length(x_m), Length(y_m)}, Length(z_m)}, .speed = Velocity(5e-6)});
      }
    }
    return end();
  };
  const Sideways<Length> before = after(20), later = after(30);
  const Sideways<Length> way = later - before;
  EXPECT_NEAR(way.x.si / 10.0, spacing_m, 1e-6 * rho_m());
  // M70
  const double first = std::asin(1.0 - spacing_m / rho_m());
  EXPECT_NEAR(way.y.si / 10.0, rho_m() * (-std::log(std::tan(0.5 * first)) - std::cos(first)), 1e-5 * rho_m());
  EXPECT_NEAR(std::atan2(way.x.si, way.y.si) * 180.0 / std::numbers::pi, 72.64314952, 0.02);
}

TEST(Sweep, OfTheShippedSetLeavesARow) {
  const auto set = load_particle_set(kFile);
  ASSERT_TRUE(set) << set.error().message;
  const ScriptedPush played = play(*set, {.rate = physics::Frequency(1000.0)});
  EXPECT_GE(played.least_margin_j, -1e-12 * played.ends.back().tick.given.si);
  EXPECT_EQ(played.lagging, 0U);
  ASSERT_EQ(played.at.size(), 7U);
  for (const auto& place : played.at) {
    // in front of the last line by the distance of the axes
    EXPECT_NEAR(place.position.x.si, 320.25e-9, 0.1e-9);
    EXPECT_LE(std::abs(place.position.y.si), 250e-9);
  }
}

TEST(Sweep, IsRefusedWithTheReason) {
  const support::ScratchFolder folder;
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = core::read_file(kFile).value();
    const std::size_t found = text.find(from);
    EXPECT_NE(found, std::string::npos) << from;
    const auto set = load_particle_set(folder.write("set.toml", text.replace(found, from.size(), to)));
    return set ? "accepted" : set.error().message;
  };
  EXPECT_THAT(refusal("sweep_width = \"500 nm\"", "sweep_width = \"0 nm\""), HasSubstr("sweep_width"));
  EXPECT_THAT(refusal("sweep_width = \"500 nm\"", "sweep_width = \"1 mm\""), HasSubstr("sweep_width"));
  EXPECT_THAT(refusal("sweep_width = \"500 nm\"\n", ""), HasSubstr("line_spacing: belongs to a sweep_width"));
  EXPECT_THAT(refusal("line_spacing = \"4 nm\"\n", ""), HasSubstr("line_spacing"));
  EXPECT_THAT(refusal("line_spacing = \"4 nm\"", "line_spacing = \"-4 nm\""), HasSubstr("line_spacing"));
  EXPECT_THAT(refusal("x = \"280 nm\"", "x = \"90 um\""), HasSubstr("lines, 10000 at most"));
  EXPECT_THAT(refusal("x = \"280 nm\"", "x = \"-80 nm\""), HasSubstr("stays where it is"));
}

}  // namespace sweep_test
}  // namespace afm::scene
