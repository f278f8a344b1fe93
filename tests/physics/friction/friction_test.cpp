// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "physics/adhesive_contact.h"
#include "physics/friction/lateral_contact.h"
#include "physics/hertz.h"
#include "physics/jkr.h"
#include "physics/jkr_pull_off.h"
#include "physics/mica.h"

namespace afm::physics {
namespace friction_test {

using namespace literals;

FrictionParameters everything(FrictionLaw law) {
  return {.law = law,
          .lattice = LatticeKind::Hexagonal,
          .coefficient = 0.05,
          .shear_strength = Pressure(1e8),
          .period = 0.52_nm,
          .corrugation = Length(5e-12),
          .lateral_stiffness = 1_N_per_m};
}

std::string refused(FrictionParameters friction) {
  try {
    validate(friction);
  } catch (const UnphysicalValue& error) {
    return error.field();
  }
  return "";
}

TEST(Friction, RefusesWhatALawNeedsAndHasNot) {
  for (const FrictionLawText& row : kFrictionLaws) EXPECT_EQ(refused(everything(row.law)), "") << row.word;
  FrictionParameters friction = everything(FrictionLaw::Amontons);
  friction.coefficient = 0.0;
  EXPECT_EQ(refused(friction), "friction_coefficient");
  friction = everything(FrictionLaw::ContactArea);
  friction.shear_strength = Pressure();
  EXPECT_EQ(refused(friction), "shear_strength");
  friction = everything(FrictionLaw::Lattice);
  friction.period = Length();
  EXPECT_EQ(refused(friction), "lattice_period");
  friction = everything(FrictionLaw::Lattice);
  friction.corrugation = Length(std::nan(""));
  EXPECT_EQ(refused(friction), "lattice_corrugation");
  friction = everything(FrictionLaw::Amontons);
  friction.lateral_stiffness = Stiffness(HUGE_VAL);
  EXPECT_EQ(refused(friction), "lateral_stiffness");
  EXPECT_EQ(refused({}), "");
}

TEST(ContactArea, IsThatOfTheLawInUse) {
  const ContactParameters mica = elastic_mica();
  const AdhesiveContact adhesive = adhesive_contact(mica);
  const auto radius = [&](Law law, Force force) { return std::sqrt(contact_area(law, mica, force).si / M_PI); };
  EXPECT_NEAR(radius(Law::Hertz, 2_nN), hertz_contact_radius(adhesive, 2_nN).si, 1e-20);
  EXPECT_NEAR(radius(Law::Dmt, 2_nN), dmt_contact_radius(adhesive, 2_nN).si, 1e-20);
  EXPECT_NEAR(radius(Law::Jkr, 2_nN), jkr_contact_radius(adhesive, 2_nN).si, 1e-20);
  const double maugis = radius(Law::MaugisDugdale, 2_nN);
  EXPECT_GT(maugis, hertz_contact_radius(adhesive, 2_nN).si);
  EXPECT_LT(maugis, 1.2 * jkr_contact_radius(adhesive, 2_nN).si);
  // pulled harder than any contact holds, the area is that of the pull-off
  EXPECT_EQ(contact_area(Law::Hertz, mica, Force(-1.0)), Area());
  EXPECT_NEAR(radius(Law::Dmt, Force(-1.0)), 0.0, 1e-15);
  EXPECT_NEAR(radius(Law::Jkr, Force(-1.0)), jkr_pull_off_radius(adhesive).si, 1e-15);
  for (const Law law : {Law::Paper, Law::Hao, Law::LennardJones, Law::Measured}) {
    EXPECT_FALSE(has_contact_area(law));
    EXPECT_THROW(contact_area(law, mica, 1_nN), std::invalid_argument);
  }
}

TEST(LateralContact, RefusesNoLawAndAnUnknownOne) {
  const auto make = [](FrictionLaw law) { LateralContact(everything(law), Law::Dmt, elastic_mica(), 1.4_nN); };
  EXPECT_THROW(make(FrictionLaw::None), std::invalid_argument);
  EXPECT_THROW(make(static_cast<FrictionLaw>(kFrictionLaws.size())), std::invalid_argument);
}

// The largest force along x of a tip that slides 2 nm in steps of 1 pm, after a way that is longer than any spring here
// stretches.
double sliding_force_N(LateralContact contact, Force load) {
  const Length way = 1000_nm;
  contact.touch_down({}, load);
  contact.slide_to({way, Length()}, load);
  double largest = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    contact.slide_to({way + 0.001_nm * i, Length()}, load);
    largest = std::max(largest, -contact.force().x.si);
  }
  return largest;
}

TEST(LateralContact, SlidesAtTheForceOfItsLaw) {
  const ContactParameters mica = elastic_mica();
  const Force adhesion = dmt_adhesion(adhesive_contact(mica));
  const LateralContact amontons(everything(FrictionLaw::Amontons), Law::Dmt, mica, adhesion);
  EXPECT_NEAR(sliding_force_N(amontons, 4_nN), 0.2e-9, 1e-18);
  const LateralContact area(everything(FrictionLaw::ContactArea), Law::Dmt, mica, adhesion);
  for (const double load_nn : {0.05, 0.5, 2.0, 10.0, 100.0, 5000.0}) {
    const Force load(1e-9 * load_nn);
    const double exact = 1e8 * contact_area(Law::Dmt, mica, load - adhesion).si;
    EXPECT_NEAR(sliding_force_N(area, load), exact, (load_nn > 0.4 ? 5e-4 : 0.01) * exact) << load_nn;
  }
  const LateralContact lattice(everything(FrictionLaw::Lattice), Law::Dmt, mica, adhesion);
  EXPECT_NEAR(sliding_force_N(lattice, 2_nN), 0.2417e-9, 0.0001e-9);
}

// Functions that a tick of the servo calls, for each row: an enumerator without its row does not compile.
TEST(LateralContact, IsWithoutForceOffTheSampleAndSlidesOnItByEveryLaw) {
  for (const FrictionLawText& row : kFrictionLaws) {
    if (row.law == FrictionLaw::None) continue;
    LateralContact contact(everything(row.law), Law::Dmt, elastic_mica(), 1.4_nN);
    for (const Force load : {Force(), 1_nN, Force(1.0)}) {
      EXPECT_TRUE(std::isfinite(sliding_force_N(contact, load))) << row.word;
    }
    EXPECT_GT(sliding_force_N(contact, 1_nN), 0.0) << row.word;
    EXPECT_FALSE(contact.touching());
    contact.touch_down({}, 3_nN);
    for (int i = 1; i <= 40; ++i) contact.slide_to({0.1_nm * i, Length()}, 3_nN);
    EXPECT_LT(contact.force().x.si, 0.0);
    EXPECT_GT(contact.stored(), Energy());
    contact.lift();
    EXPECT_EQ(contact.force(), Sideways<Force>());
    EXPECT_EQ(contact.stored(), Energy());
    EXPECT_EQ(contact.lift_per_load(), Length());
  }
}

}  // namespace friction_test
}  // namespace afm::physics
