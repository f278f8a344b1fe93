// SPDX-License-Identifier: Apache-2.0
#include "physics/van_der_waals.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "physics/contact.h"
#include "random_interaction.h"

namespace afm::physics {
namespace van_der_waals_test {

using namespace literals;

constexpr double kRounding = 1e-13;
// central differences over a step of 1e-4 of the gap: their own error is some 1e-8
constexpr double kDifferenceStep = 1e-4;
constexpr double kDifferenceError = 3e-7;
constexpr int kMaterials = 10'000;

LawOptions exact_sphere() { return {.exact_hamaker_sphere = true, .retardation_wavelength = {}, .meniscus = {}}; }
LawOptions retarded(Length wavelength) {
  return {.exact_hamaker_sphere = false, .retardation_wavelength = wavelength, .meniscus = {}};
}
LawOptions both(Length wavelength) {
  return {.exact_hamaker_sphere = true, .retardation_wavelength = wavelength, .meniscus = {}};
}
std::array<LawOptions, 4> all_forms() { return {LawOptions{}, exact_sphere(), retarded(100_nm), both(100_nm)}; }

TEST(VanDerWaals, ForceIsTheSlopeOfThePotentialAndGradientThatOfTheForce) {
  RandomInteraction random(1);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    const Length gap(random.between(0.1e-9, 1e-5));
    const Length step = kDifferenceStep * gap;
    for (const LawOptions& form : all_forms()) {
      const VanDerWaals law(m.hamaker, m.tip_radius, form);
      const Force slope = -(law.potential(gap + step) - law.potential(gap - step)) / (2.0 * step);
      EXPECT_NEAR(slope / law.force(gap), 1.0, kDifferenceError);
      const Stiffness steepness = (law.force(gap + step) - law.force(gap - step)) / (2.0 * step);
      EXPECT_NEAR(steepness / law.gradient(gap), 1.0, kDifferenceError);
    }
  }
}

TEST(VanDerWaals, AttractsEverywhereAndLessTheFartherAway) {
  for (const LawOptions& form : all_forms()) {
    const VanDerWaals law(24.5_zJ, 50_nm, form);
    for (Length gap = 0.1_nm; gap < 1_mm; gap = gap * 1.3) {
      EXPECT_LT(law.potential(gap), Energy());
      EXPECT_LT(law.force(gap), Force());
      EXPECT_GT(law.gradient(gap), Stiffness());
    }
  }
}

TEST(VanDerWaals, ExactSphereIsDerjaguinsForALargeRadiusAndWeakerForAnyOther) {
  for (const Length gap : {0.2_nm, 1_nm, 10_nm}) {
    const VanDerWaals large(24.5_zJ, 1_mm, exact_sphere());
    const VanDerWaals approximation(24.5_zJ, 1_mm);
    EXPECT_NEAR(large.force(gap) / approximation.force(gap), 1.0, 1.01 * (gap / 1_mm));
    EXPECT_LT(abs(VanDerWaals(24.5_zJ, 5_nm, exact_sphere()).force(gap)), abs(VanDerWaals(24.5_zJ, 5_nm).force(gap)));
  }
}

// A small sphere far away is a point: its energy is -2 A R^3/(9 D^3). It shows whether the sum's series and its closed
// form join, where the closed form loses digits.
TEST(VanDerWaals, ExactSphereIsAPointFarAway) {
  for (double gap = 1e-6; gap < 1e-3; gap *= 1.7) {
    const double radius = 1e-10;
    const VanDerWaals law(Energy(9.0), Length(radius), exact_sphere());
    const double point = -2.0 * std::pow(radius / (gap + radius), 3.0);
    EXPECT_NEAR(law.potential(Length(gap)).si / point, 1.0, 1e-7);
  }
  const VanDerWaals law(24.5_zJ, 50_nm, exact_sphere());
  const Length joint = 2.0 * 50_nm;
  const Length step = 1e-9 * joint;
  const Energy fall = law.potential(joint + step) - law.potential(joint - step);
  EXPECT_NEAR(fall / (-2.0 * step * law.force(joint)), 1.0, 1e-5);
}

TEST(VanDerWaals, RetardationTakesOffWhatTheHeaderSays) {
  const VanDerWaals bare(24.5_zJ, 50_nm);
  const VanDerWaals weak(24.5_zJ, 50_nm, retarded(100_nm));
  EXPECT_NEAR(weak.force(2_nm) / bare.force(2_nm), 0.952, 0.001);
  EXPECT_NEAR(weak.force(5_nm) / bare.force(5_nm), 0.830, 0.001);
  EXPECT_NEAR(weak.potential(5_nm) / bare.potential(5_nm), 1.0 / 1.7, kRounding);
  EXPECT_NEAR(weak.force(100_um) / weak.force(50_um), 1.0 / 8.0, 1e-3);
}

TEST(VanDerWaals, LongWavelengthDoesNotRetard) {
  const VanDerWaals bare(24.5_zJ, 50_nm);
  const VanDerWaals law(24.5_zJ, 50_nm, retarded(100_um));
  // the first order in D/lambda cancels in the force
  EXPECT_NEAR(law.force(1_nm) / bare.force(1_nm), 1.0, 1e-7);
}

TEST(VanDerWaals, GapAtAForceIsWhereThatForceActs) {
  RandomInteraction random(2);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    const Force attraction(-random.between(1e-12, 1e-6));
    for (const LawOptions& form : all_forms()) {
      const VanDerWaals law(m.hamaker, m.tip_radius, form);
      EXPECT_NEAR(law.force(law.gap_at(attraction)) / attraction, 1.0, kRounding);
    }
  }
}

TEST(ContactGap, IsWhereAttractionIsTheAdhesionInEveryForm) {
  RandomInteraction random(3);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    const double derjaguin = std::sqrt(m.hamaker.si * m.tip_radius.si / (6.0 * adhesion_force(m).si));
    EXPECT_NEAR(contact_gap(m).si / derjaguin, 1.0, kRounding);
    for (const LawOptions& form : all_forms()) {
      const VanDerWaals law(m.hamaker, m.tip_radius, form);
      EXPECT_NEAR(-law.force(contact_gap(m, form)) / adhesion_force(m), 1.0, kRounding);
    }
  }
}

TEST(ContactGap, IsAnAtomsDistanceForThePapersMaterials) {
  const Stiffness rigid(HUGE_VAL);
  EXPECT_NEAR(contact_gap({50_nm, 0.1_N_per_m, rigid, 24.5_zJ, 2.228_mJ_per_m2}).si, 0.3819e-9, 5e-14);
  EXPECT_NEAR(contact_gap({50_nm, 0.1_N_per_m, rigid, 120_zJ, 15.915_mJ_per_m2}).si, 0.3162e-9, 5e-14);
  EXPECT_NEAR(contact_gap({50_nm, 0.036_N_per_m, rigid, 10_zJ, 0.955_mJ_per_m2}).si, 0.3727e-9, 5e-14);
}

}  // namespace van_der_waals_test
}  // namespace afm::physics
