// SPDX-License-Identifier: Apache-2.0
#include "physics/adhesion_map.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "random_interaction.h"

namespace afm::physics {
namespace adhesion_map_test {

using namespace literals;

constexpr int kMaterials = 10'000;

ContactParameters contact_of(Length radius, SurfaceEnergy work_of_adhesion, Pressure modulus) {
  ContactParameters contact{radius, 0.1_N_per_m, Stiffness(HUGE_VAL), 24.5_zJ, work_of_adhesion / 2.0};
  contact.reduced_modulus = modulus;
  return contact;
}

TEST(AdhesionMap, MaugisParameterIsTaborsTimes1157) {
  RandomInteraction random(1);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    EXPECT_NEAR(maugis_parameter(m) / tabor_parameter(m), 1.15701163485, 1e-10);
  }
}

TEST(AdhesionMap, TaborParameterScalesAsItsDefinition) {
  RandomInteraction random(2);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    ContactParameters scaled = m;
    scaled.tip_radius = 8.0 * m.tip_radius;
    scaled.reduced_modulus = 27.0 * m.reduced_modulus;
    scaled.mean_surface_energy = 64.0 * m.mean_surface_energy;
    scaled.atomic_distance = 5.0 * m.atomic_distance;
    EXPECT_NEAR(tabor_parameter(scaled) / tabor_parameter(m), 2.0 / 9.0 * 16.0 / 5.0, 1e-12);
  }
}

TEST(AdhesionMap, RigidContactHasParametersOfZeroAndTheRigidRegime) {
  ContactParameters m = RandomInteraction(3)();
  m.reduced_modulus = Pressure(HUGE_VAL);
  EXPECT_EQ(tabor_parameter(m), 0.0);
  EXPECT_EQ(maugis_parameter(m), 0.0);
  const LawChoice choice = choose_law(m);
  EXPECT_EQ(choice.regime, Regime::Rigid);
  EXPECT_EQ(choice.law, Law::Dmt);
  EXPECT_EQ(choice.reason, "no modulus is given: the contact is rigid, so DMT");
}

TEST(AdhesionMap, SuitsThePapersMaterialsWithDmtAndSoftOnesWithMore) {
  const LawChoice mica = choose_law(contact_of(50_nm, 4.456_mJ_per_m2, 51.5_GPa));
  EXPECT_EQ(mica.law, Law::Dmt);
  EXPECT_EQ(mica.regime, Regime::Dmt);
  EXPECT_EQ(mica.reason, "Tabor parameter 0.024 < 0.1: the contact is too stiff to be drawn out into a neck, so DMT");

  const LawChoice silicon_nitride = choose_law(contact_of(50_nm, 1.91_mJ_per_m2, 132_GPa));
  EXPECT_EQ(silicon_nitride.law, Law::Dmt);
  EXPECT_EQ(silicon_nitride.regime, Regime::Rigid);

  const LawChoice polystyrene = choose_law(contact_of(50_nm, 106_mJ_per_m2, 3.6_GPa));
  EXPECT_EQ(polystyrene.law, Law::MaugisDugdale);
  EXPECT_EQ(polystyrene.regime, Regime::Maugis);
  EXPECT_EQ(polystyrene.reason,
            "Tabor parameter 1.17 between 0.1 and 5 (Maugis' lambda 1.35): neither DMT nor JKR holds, so "
            "Maugis-Dugdale");

  const LawChoice pdms = choose_law(contact_of(1_um, 44_mJ_per_m2, Pressure(2.6667e6)));
  EXPECT_EQ(pdms.law, Law::Jkr);
  EXPECT_EQ(pdms.regime, Regime::Jkr);
  EXPECT_EQ(pdms.reason, "Tabor parameter 216 > 5: the contact is soft enough to be drawn out into a neck, so JKR");
}

TEST(AdhesionMap, RegimesFollowOneAnotherAsTheContactSoftens) {
  const std::array order{Regime::Rigid, Regime::Dmt, Regime::Maugis, Regime::Jkr};
  std::size_t reached = 0;
  for (double tabor = 1e-4; tabor < 1e3; tabor *= 1.05) {
    const Regime regime = regime_of(tabor, 0.0);
    while (reached < order.size() && order[reached] != regime) ++reached;
    ASSERT_LT(reached, order.size()) << "out of order at a Tabor parameter of " << tabor;
  }
  EXPECT_EQ(order[reached], Regime::Jkr);
}

TEST(AdhesionMap, LoadTakesAContactFromItsRegimeToHertz) {
  for (double tabor = 1e-4; tabor < 1e3; tabor *= 1.5) {
    EXPECT_NE(regime_of(tabor, 1.0), Regime::Hertz);
    EXPECT_EQ(regime_of(tabor, 1e5), Regime::Hertz);
  }
  // the stiffest add 2 to any load, JKR the root of six times the load
  EXPECT_EQ(regime_of(0.001, 39.0), Regime::Rigid);
  EXPECT_EQ(regime_of(0.001, 42.0), Regime::Hertz);
  EXPECT_EQ(regime_of(100.0, 2500.0), Regime::Jkr);
  EXPECT_EQ(regime_of(100.0, 2600.0), Regime::Hertz);
}

TEST(AdhesionMap, NamesAreTheRegimes) {
  EXPECT_EQ(name_of(Regime::Rigid), "rigid");
  EXPECT_EQ(name_of(Regime::Hertz), "hertz");
  EXPECT_EQ(name_of(Regime::Dmt), "dmt");
  EXPECT_EQ(name_of(Regime::Maugis), "maugis");
  EXPECT_EQ(name_of(Regime::Jkr), "jkr");
}

TEST(AdhesionMap, RefusesAnUnphysicalContact) {
  ContactParameters m = RandomInteraction(4)();
  m.reduced_modulus = Pressure(1e30);
  EXPECT_THROW(choose_law(m), UnphysicalValue);
}

}  // namespace adhesion_map_test
}  // namespace afm::physics
