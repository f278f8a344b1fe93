// SPDX-License-Identifier: Apache-2.0
#include "physics/meniscus.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "curve_laws.h"
#include "physics/contact.h"
#include "physics/force_laws.h"
#include "physics/lennard_jones.h"
#include "physics/van_der_waals.h"
#include "random_interaction.h"

namespace afm::physics {
namespace meniscus_test {

using namespace literals;

constexpr int kMaterials = 2'000;
constexpr double kRounding = 1e-12;

Meniscus at_humidity(double humidity) { return {.relative_humidity = humidity}; }

TEST(Meniscus, FilmsAreAsThickAsTheHeaderSays) {
  EXPECT_NEAR(film_height(at_humidity(0.5)).si, 0.18e-9, 0.005e-9);
  EXPECT_NEAR(film_height(at_humidity(0.75)).si, 0.24e-9, 0.005e-9);
}

// The film of 0.178296 nm that Kelvin's and Hamaker's pressures leave at 50 %, twice that, and cbrt(4 pi R h^2) for 50
// nm, computed outside the program.
TEST(Meniscus, ABridgeFormsAtTwoFilmsAndBreaksAtTheRootOfItsVolume) {
  const Meniscus half = at_humidity(0.5);
  EXPECT_NEAR(film_height(half).si, 1.782962378901542e-10, 1e-22);
  EXPECT_NEAR(bridge_formation_gap(half).si, 3.565924757803084e-10, 1e-22);
  EXPECT_NEAR(bridge_rupture_gap(half, 50_nm).si, 2.7132391550892988e-09, 1e-21);
}

TEST(Meniscus, BridgesFormAndBreakFartherAwayInDamperAir) {
  Length formation;
  Length rupture;
  for (double humidity = 0.05; humidity < 0.96; humidity += 0.05) {
    const Meniscus meniscus = at_humidity(humidity);
    EXPECT_GT(bridge_formation_gap(meniscus), formation);
    EXPECT_GT(bridge_rupture_gap(meniscus, 50_nm), rupture);
    formation = bridge_formation_gap(meniscus);
    rupture = bridge_rupture_gap(meniscus, 50_nm);
    EXPECT_GT(rupture, formation);
    EXPECT_GE(bridge_rupture_gap(meniscus, 0.1_nm), formation);
  }
}

TEST(Meniscus, PullsLessTheLessItWets) {
  const Force wetting = capillary_force({.contact_angle_rad = 0.0}, 50_nm);
  EXPECT_NEAR(capillary_force({.contact_angle_rad = 1.0}, 50_nm) / wetting, std::cos(1.0), kRounding);
  EXPECT_NEAR(capillary_force({.contact_angle_rad = 0.0}, 100_nm) / wetting, 2.0, kRounding);
}

template <class Check>
void for_every_wet_law(Check check) {
  for (const Law name : curve_laws()) {
    RandomInteraction random(static_cast<unsigned>(name));
    for (int i = 0; i < kMaterials; ++i) {
      const ContactParameters m = random();
      LawOptions options;
      options.meniscus = at_humidity(0.02 * random.between(1.0, 49.0));
      check(name, m, *options.meniscus, force_law(name, m), force_law(name, m, options));
    }
  }
}

TEST(WetLaw, PullsWithTheBridgeAddedWhileAttachedAndAsBeforeWhileFree) {
  for_every_wet_law(
      [](Law name, const ContactParameters& m, const Meniscus& meniscus, const ForceLaw& dry, const ForceLaw& wet) {
        const double s = 0.5 * (wet.attached.first + wet.attached.last);
        const Force pull = capillary_force(meniscus, m.tip_radius);
        EXPECT_EQ(wet.attached.at(s).force, dry.attached.at(s).force - pull) << name_of(name);
        EXPECT_EQ(wet.attached.at(s).h, dry.attached.at(s).h);
        EXPECT_EQ(wet.free.at(wet.free.last).force, dry.free.at(wet.free.last).force);
        EXPECT_EQ(wet.contact_gap, dry.contact_gap);
      });
}

TEST(WetLaw, BridgeFormsAndBreaksAtItsGapsOrWithTheNeck) {
  for_every_wet_law(
      [](Law name, const ContactParameters& m, const Meniscus& meniscus, const ForceLaw& dry, const ForceLaw& wet) {
        const Length neck_end = dry.attached.at(dry.attached.last).h;
        const Length breaks = wet.attached.at(wet.attached.last).h;
        const Length forms = wet.free.at(wet.free.last).h;
        const Length contact = dry.free.at(dry.free.last).h;
        const Length rupture = contact + bridge_rupture_gap(meniscus, m.tip_radius);
        EXPECT_NEAR(breaks.si, std::min(rupture, neck_end).si, 1e-9 * rupture.si) << name_of(name);
        const Length formation = std::min(contact + bridge_formation_gap(meniscus), breaks);
        EXPECT_NEAR(forms.si, std::max(formation, contact).si, 1e-9 * rupture.si);
        // a bridge never forms farther out than it breaks
        EXPECT_TRUE(name == Law::Hao || forms <= breaks * (1.0 + 1e-9));
      });
}

TEST(WetLaw, PotentialWhereTheBridgeBreaksIsTheDryLawsThere) {
  RandomInteraction random(9);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    LawOptions options;
    options.meniscus = at_humidity(0.5);
    const ForceLaw dmt = force_law(Law::Dmt, m, options);
    const Length breaks = dmt.attached.at(dmt.attached.last).h;
    const Energy van_der_waals = VanDerWaals(m.hamaker, m.tip_radius).potential(breaks);
    EXPECT_NEAR(*dmt.attached_end_potential / van_der_waals, 1.0, 1e-9);

    const ForceLaw lj = force_law(Law::LennardJones, m, options);
    const Length lj_breaks = lj.attached.at(lj.attached.last).h;
    const LennardJones surfaces(work_of_adhesion(m), m.tip_radius, m.atomic_distance);
    EXPECT_NEAR(*lj.attached_end_potential / surfaces.potential(lj_breaks), 1.0, 1e-9);
  }
}

}  // namespace meniscus_test
}  // namespace afm::physics
