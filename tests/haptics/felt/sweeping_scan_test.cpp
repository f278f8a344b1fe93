// SPDX-License-Identifier: Apache-2.0
// A look at particles whose scan presses too hard to climb them.
// Invariant: a scan with a gentle load moves no particle by a bit; one with a higher load sweeps them, without force
#include "haptics/contact/sweeping_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "haptics/felt_particles.h"
#include "physics/manipulation/push_figures.h"
#include "servo_bench.h"
#include "support/particles/gold_particles.h"

namespace afm {
namespace sweeping_scan_test {

using haptics::SweepingScan;
using scene::ScanHand;
using scene::ScanLead;

constexpr double kTickS = 0.001;
constexpr std::uint32_t kGentlePn = 67, kHardPn = 68;  // limits around 67.9 pN (N24)

ScanLead look_at(double half_m, std::uint32_t load_pn) {
  return {.height_m = half_m, .hand = ScanHand::Looks, .load_pn = load_pn};
}

// A sphere with hardly any friction goes one spacing a line, and along the lines by M71.
TEST(SweepingScan, DriftsInTheDirectionOfOneWayLines) {
  const scene::SharedParticles set = test::particles_at({{0.0, 0.0}}, test::constant_species(1e-15, 1.0));
  const double rho_m = test::touch_m(set);
  SweepingScan scan(set);
  const ScanLead look = look_at(1.6 * rho_m, 1);  // 32 spacings of 0.1 rho
  ASSERT_TRUE(scan.sweeps(1e-12));
  scan.begin(look, std::vector<scene::ParticlePage>(1));
  int ticks = 0;
  const auto after = [&](int lines) {
    for (; ticks < 100 * lines - 5; ++ticks) scan.step({0.0, 0.0}, kTickS);
    return scan.particles().position(0);
  };
  const auto before = after(20), later = after(30);
  const double along_m = (later.x - before.x).si / 10.0, across_m = (later.y - before.y).si / 10.0;
  EXPECT_NEAR(across_m, 0.1 * rho_m, 1e-4 * rho_m);
  const double first = std::asin(0.9);
  EXPECT_NEAR(along_m, rho_m * (-std::log(std::tan(0.5 * first)) - std::cos(first)), 1e-4 * rho_m);
  EXPECT_NEAR(std::atan2(across_m, along_m) * 180.0 / std::numbers::pi, 72.643, 0.2);
}

// Gold spheres at level 1, and a hand above them.
struct LookedAt {
  explicit LookedAt(const scene::SharedParticles& particles = test::particles_at({{-80e-9, 0.0}, {0.0, 0.0}}))
      : set(particles), scale(*haptics::particle_scale(set, haptics::omni_like("hand"))) {
    set.level.level = 1;
    felt = std::make_unique<haptics::FeltParticles>(set, scale);
    start = pages();
  }

  void look(std::uint32_t load_pn, double seconds, ScanHand hand = ScanHand::Looks) {
    ScanLead lead = look_at(3.0 * test::touch_m(set), load_pn);
    lead.hand = hand;
    for (double s = 0.0; s < seconds; s += kTickS) {
      const haptics::ParticlePush push = felt->step({0.0, 0.0}, z_m < 0.0 ? scale.clear_z_m : z_m, kTickS);
      ASSERT_FALSE(push.touches);
      ASSERT_EQ(push.push_n, glm::dvec3(0.0));
      haptics::ParticlePush swept;
      felt->sweep(lead, kTickS, swept);
      for (const haptics::ParticlePush::Event& event : swept.happened()) events.push_back(event);
    }
  }
  std::vector<scene::ParticlePage> pages() const { return {felt->pages().begin(), felt->pages().end()}; }

  scene::SharedParticles set;
  haptics::ParticleScale scale;
  std::unique_ptr<haptics::FeltParticles> felt;
  std::vector<scene::ParticlePage> start;
  std::vector<haptics::ParticlePush::Event> events;
  double z_m = -1.0;  // height of the hand; negative: just above the particles
};

TEST(SweepingScan, WithAGentleLoadMovesNothingByABit) {
  LookedAt gold;
  gold.look(kGentlePn, 3.4);
  EXPECT_EQ(gold.pages(), gold.start);
  EXPECT_TRUE(gold.felt->changed_pages().empty());
  EXPECT_TRUE(gold.events.empty());
  gold.look(1000, 3.4, ScanHand::Scans);
  EXPECT_EQ(gold.pages(), gold.start) << "no look";
}

TEST(SweepingScan, WithAHigherLoadSweepsUpwardsAndSaysSoOnceForEachParticle) {
  LookedAt gold;
  gold.look(kHardPn, 3.4);
  ASSERT_EQ(gold.events.size(), 2U);
  for (std::uint32_t i : {0U, 1U}) {
    EXPECT_EQ(gold.events[i].kind, physics::EventKind::ParticleSwept);
    EXPECT_NEAR(gold.events[i].force_before_n, 0.25e-9, 0.05e-9) << "the threshold";
    const scene::ParticlePose &was = gold.start[0].poses[i], is = gold.pages()[0].poses[i];
    EXPECT_GT(is.y_m, was.y_m + 2.5 * test::touch_m(gold.set)) << "ahead of the last line";
    EXPECT_GT(is.x_m, was.x_m);
  }
  EXPECT_EQ(gold.felt->push().strokes, 1U);
  ASSERT_TRUE(gold.felt->take_back());
  for (std::uint32_t i : {0U, 1U}) EXPECT_EQ(gold.pages()[0].poses[i], gold.start[0].poses[i]);
}

TEST(SweepingScan, EndsWhenTheHandComesDown) {
  LookedAt gold;
  gold.look(kHardPn, 1.6);
  const auto there = gold.pages();
  EXPECT_NE(there, gold.start);
  // beside the particles, in the square
  for (int i = 0; i < 100; ++i) {
    gold.felt->step({30e-9, 100e-9}, 0.5 * gold.scale.clear_z_m, kTickS);
    haptics::ParticlePush swept;
    gold.felt->sweep(look_at(3.0 * test::touch_m(gold.set), kHardPn), kTickS, swept);
    EXPECT_EQ(swept.event_count, 0U);
  }
  EXPECT_EQ(gold.pages(), there);
}

TEST(SweepingScan, ClimbsWhatIsPinned) {
  scene::SharedParticles set = test::particles_at({{-80e-9, 0.0}, {0.0, 0.0}});
  set.particles[1].pinned = 1;
  LookedAt gold(set);
  gold.look(kHardPn, 3.4);
  EXPECT_EQ(gold.events.size(), 1U);
  EXPECT_EQ(gold.pages()[0].poses[1], gold.start[0].poses[1]);
  EXPECT_NE(gold.pages()[0].poses[0], gold.start[0].poses[0]);
}

TEST(SweepingScan, OfARodTurnsOnItsEndFirst) {
  scene::SharedParticles set = test::particles_at({{0.0, 0.0}}, test::constant_species(3e-9, 0.5, 20e-9));
  set.length_m[0] = 500e-9;
  const physics::PushSetup setup = scene::push_setup(set);
  // 0.414 q L at the end (N46), by the slope of a tip without friction
  const double gentle_n = physics::climbing_load(setup.species[0], setup.tip, setup.tip_friction).si;
  EXPECT_NEAR(gentle_n, 3e-9 * (std::sqrt(2.0) - 1.0) * std::tan(std::numbers::pi / 12.0), 1e-14);
  const SweepingScan scan(set);
  EXPECT_FALSE(scan.sweeps(gentle_n));
  EXPECT_TRUE(scan.sweeps(1.001 * gentle_n));
}

// If friction at the tip leaves no gentle load (N25), the load is that of a tip without friction.
TEST(SweepingScan, HasAGentleLoadUnderEveryTip) {
  const physics::PushSetup setup = scene::push_setup(test::particles_at({{0.0, 0.0}}));
  const physics::ParticleSpecies& gold = setup.species[0];
  EXPECT_EQ(physics::climbing_load(gold, setup.tip, 0.3), physics::gentle_load(gold, setup.tip, 0.0));
  EXPECT_EQ(physics::climbing_load(gold, setup.tip, 0.1), physics::gentle_load(gold, setup.tip, 0.1));
  EXPECT_GT(physics::climbing_load(gold, setup.tip, 0.1).si, 0.0);
}

}  // namespace sweeping_scan_test
}  // namespace afm
