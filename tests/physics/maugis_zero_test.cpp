// SPDX-License-Identifier: Apache-2.0
// Where Maugis-Dugdale's contact has its zero, and for which values its law is single-valued.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "physics/contact.h"
#include "physics/force_laws.h"
#include "physics/law_tables.h"
#include "physics/maugis_dugdale.h"
#include "physics/van_der_waals.h"
#include "random_interaction.h"

namespace afm::physics {
namespace maugis_zero_test {

using std::numbers::pi;

constexpr int kContacts = 3'000;
constexpr double kAsComputed = 1e-9;  // tolerance to which the reference numbers were solved

// Adhesion of a shorter range than van der Waals attraction: a0 = 2.05 nm, z0 = 0.25 nm, lambda = 0.852.
ContactParameters longer_attraction() {
  ContactParameters contact;
  contact.tip_radius = Length(1.3300388793401783e-06);
  contact.spring_constant = Stiffness(2.4905706911845611);
  contact.sample_stiffness = Stiffness(HUGE_VAL);
  contact.hamaker = Energy(9.4430903069162623e-19);
  contact.mean_surface_energy = SurfaceEnergy(0.0059319238512708684 / 2.0);
  contact.reduced_modulus = Pressure(2809865912.1609931);
  contact.atomic_distance = Length(2.456638085108962e-10);
  return contact;
}

struct PullOff {
  Law law;
  double z, force;
};

// By a separate script: golden sections for the largest Z = h - P/k over the contact radius (JKR, h = -delta) or over
// m = c/a (Maugis 1992, (6.16) to (6.18), h = a0 - delta); DMT: Z = a0 + F_ad/k, as k is less than A R/(3 a0^3).
TEST(ZeroOfContact, PutsThePullOffWhereTheEquationsDo) {
  for (const PullOff& expected : {PullOff{Law::MaugisDugdale, 1.8376180936762297e-08, -4.024236209918857e-08},
                                  PullOff{Law::Jkr, 1.5070299688971853e-08, -3.717359406131255e-08},
                                  PullOff{Law::Dmt, 2.195893892892239e-08, -4.9572380211402606e-08}}) {
    const CycleFigures figures = build_law_tables(expected.law, longer_attraction())->figures;
    EXPECT_NEAR(figures.z_joc.si / expected.z, 1.0, kAsComputed) << name_of(expected.law);
    EXPECT_NEAR(figures.force_before_joc.si / expected.force, 1.0, kAsComputed) << name_of(expected.law);
  }
}

// The parameter at which an attached branch of Maugis-Dugdale has the height a0, where delta = 0.
double untouched(const ForceLaw& law) {
  double inner = law.attached.first, outer = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (inner + outer);
    (law.attached.at(middle).h < law.contact_gap ? inner : outer) = middle;
  }
  return inner;
}

TEST(ZeroOfContact, IsTheGapOfVanDerWaalsAndAdhesionWhateverTheValues) {
  RandomInteraction random(1);
  int longer = 0;
  for (int i = 0; i < kContacts; ++i) {
    const ContactParameters contact = random();
    const ForceLaw law = maugis_law(contact);
    EXPECT_EQ(law.contact_gap, contact_gap(contact));
    const double s = untouched(law);
    const double lambda =
        maugis_lambda(adhesive_contact(contact), cohesive_stress(work_of_adhesion(contact), contact.atomic_distance));
    EXPECT_NEAR(maugis_point(lambda, s).indentation, 0.0, 1e-6) << i;
    longer += contact_gap(contact) > 4.0 * contact.atomic_distance ? 1 : 0;
  }
  EXPECT_GT(longer, kContacts / 20);
}

// Between the end of the contact and the height at which van der Waals force is no stronger, the pull stays.
TEST(ZeroOfContact, LongerAttractionIsHeldByTheContactsPull) {
  const ContactParameters contact = longer_attraction();
  const ForceLaw law = maugis_law(contact);
  // the point: h = a0 - delta and P by (6.16), (6.17) with a = 0; and where A R/(6 h^2) is that pull
  constexpr double kEnd = 2.374352653265436e-09, kFree = 2.8633980621968576e-09, kPull = 1.0300397841402182;
  const double pull = -kPull * pi * 0.0059319238512708684 * contact.tip_radius.si;
  ASSERT_EQ(law.attached.kinks.size(), 2U);
  const std::array ends{law.attached.at(law.attached.kinks[0]), law.attached.at(law.attached.kinks[1])};
  EXPECT_NEAR(ends[0].h.si / kEnd, 1.0, kAsComputed);
  EXPECT_NEAR(ends[1].h.si / kFree, 1.0, kAsComputed);
  const double middle = 0.5 * (law.attached.kinks[0] + law.attached.kinks[1]);
  for (const LawPoint& point : {ends[0], law.attached.at(middle), ends[1]}) {
    EXPECT_NEAR(point.force.si / pull, 1.0, kAsComputed);
  }
  EXPECT_EQ(law.attached.at(middle).dforce_ds, 0.0);
}

bool is_one_curve(const ForceLaw& law) { return law.attached.at(law.attached.last).h > Length(0.5e-3); }

// docs/physics.md: under fixed grips a zone without contact ends where c = 8 lambda/(3 pi), with the pull
// 2 y pi W R, y = 16 lambda^3/(9 pi), at h = a0 + h0 (1 + y), h0 = W/sigma0. One curve if van der Waals force,
// 2 (a0/h)^2 pi W R, is no weaker there.
TEST(SingleValued, IsWhatTheClosedConditionSays) {
  RandomInteraction random(2);
  int one_curve = 0, looked_at = 0;
  for (int i = 0; i < kContacts; ++i) {
    const ContactParameters contact = random();
    const SurfaceEnergy w = work_of_adhesion(contact);
    const Pressure stress = cohesive_stress(w, contact.atomic_distance);
    const double lambda = maugis_lambda(adhesive_contact(contact), stress);
    if (lambda > 0.937) continue;
    const double y = 16.0 * std::pow(lambda, 3.0) / (9.0 * pi);
    const double height = 1.0 + (w / stress).si / contact_gap(contact).si * (1.0 + y);
    if (std::abs(height * height * y - 1.0) < 1e-6) continue;
    const bool expected = height * height * y <= 1.0;
    EXPECT_EQ(is_one_curve(maugis_law(contact)), expected) << "lambda " << lambda;
    one_curve += expected ? 1 : 0;
    ++looked_at;
  }
  EXPECT_GT(one_curve, looked_at / 4);
  EXPECT_LT(one_curve, looked_at);
}

// The value of lambda by itself does not decide: with a short-range attraction (a0 = 0.06 nm, z0 = 0.4 nm) the law has
// a loop at both 0.461 and 0.924; with a long-range one (a0 = 2.05 nm) at neither.
TEST(SingleValued, DependsOnTheRangesAndNotOnLambdaAlone) {
  for (const double lambda : {0.461, 0.924}) {
    for (const bool short_range : {true, false}) {
      ContactParameters contact = longer_attraction();
      if (short_range) {
        contact.hamaker = Energy(12.0 * pi * 0.0059319238512708684 * 0.06e-9 * 0.06e-9);
        contact.atomic_distance = Length(0.4e-9);
      }
      // lambda goes as E*^(-2/3)
      const double now =
          maugis_lambda(adhesive_contact(contact), cohesive_stress(work_of_adhesion(contact), contact.atomic_distance));
      contact.reduced_modulus = contact.reduced_modulus * std::pow(now / lambda, 1.5);
      EXPECT_EQ(is_one_curve(maugis_law(contact)), !short_range) << lambda;
    }
  }
}

// c(0) = 8 lambda/(3 pi) in (6.18) at the point, (pi/4) lambda c^2 + (4/3)(pi/2 - 1) lambda^2 c = 1, gives
// lambda^3 = 9 pi/(16 (pi - 1)).
TEST(SingleValued, ZoneWithoutContactEndsAtThePointForOneLambda) {
  const double lambda = std::cbrt(9.0 * pi / (16.0 * (pi - 1.0)));
  EXPECT_NEAR(lambda, 0.937947, 1e-6);
  EXPECT_GT(maugis_fixed_grips_end(lambda * (1.0 - 1e-9)), 0.0);
  EXPECT_LE(maugis_fixed_grips_end(lambda * (1.0 + 1e-9)), 0.0);
}

}  // namespace maugis_zero_test
}  // namespace afm::physics
