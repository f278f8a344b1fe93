// SPDX-License-Identifier: Apache-2.0
#include "physics/maugis_dugdale.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "physics/contact.h"
#include "physics/force_laws.h"
#include "physics/hertz.h"
#include "physics/jkr.h"
#include "physics/law_tables.h"
#include "physics/van_der_waals.h"
#include "random_interaction.h"
#include "support/deep.h"

namespace afm::physics {
namespace maugis_dugdale_test {

using namespace literals;
using std::numbers::pi;

constexpr int kMaterials = 10'000;
constexpr double kRounding = 1e-12;
// central differences over a step of 1e-5 in a parameter whose natural scale is 1
constexpr double kDifferenceError = 1e-8;

// Maugis' equations as he prints them, for c > a > 0.
struct Printed {
  double zone_equation, load, indentation;
};
Printed printed(double lambda, double a, double m) {
  const double root = std::sqrt(m * m - 1.0);
  const double angle = std::acos(1.0 / m);
  return {lambda * a * a / 2.0 * (root + (m * m - 2.0) * angle) +
              4.0 * lambda * lambda * a / 3.0 * (root * angle - m + 1.0),
          a * a * a - lambda * a * a * (root + m * m * angle), a * a - 4.0 / 3.0 * lambda * a * root};
}

TEST(MaugisPoint, SolvesMaugisEquationsAsPrinted) {
  RandomInteraction random(1);
  for (int i = 0; i < kMaterials; ++i) {
    const double lambda = random.between(0.01, 20.0);
    const double s = -random.between(1e-3, 2.0);
    const MaugisPoint point = maugis_point(lambda, s);
    const double m = 1.0 / std::sqrt(-std::expm1(2.0 * s));
    const Printed expected = printed(lambda, point.contact_radius, m);
    const double scale = 1.0 + std::pow(point.contact_radius, 3.0);
    EXPECT_NEAR(expected.zone_equation, 1.0, 1e-10);
    EXPECT_NEAR(point.load, expected.load, 1e-10 * scale);
    EXPECT_NEAR(point.indentation, expected.indentation, 1e-10 * scale);
  }
}

TEST(MaugisPoint, DerivativesAreThoseOfTheFamily) {
  RandomInteraction random(2);
  for (int i = 0; i < kMaterials; ++i) {
    const double lambda = random.between(1e-3, 1e4);
    const double step = 1e-5;
    // near the point whose load has no second derivative, and beyond it
    const double s = i % 4 == 0 ? random.between(0.001, 3.0) : -random.between(0.05, 20.0);
    const MaugisPoint before = maugis_point(lambda, s - step);
    const MaugisPoint here = maugis_point(lambda, s);
    const MaugisPoint after = maugis_point(lambda, s + step);
    const double load_scale = 1.0 + std::pow(here.contact_radius, 3.0) + std::abs(here.dload_ds);
    const double way_scale = 1.0 + std::pow(here.contact_radius, 2.0) + std::abs(here.dindentation_ds);
    EXPECT_NEAR((after.load - before.load) / (2.0 * step), here.dload_ds, 10.0 * kDifferenceError * load_scale)
        << lambda << " " << s;
    EXPECT_NEAR((after.indentation - before.indentation) / (2.0 * step), here.dindentation_ds,
                10.0 * kDifferenceError * way_scale)
        << lambda << " " << s;
    EXPECT_LE(after.contact_radius, here.contact_radius);
  }
}

// At the point the family goes on as Kim, McMeeking & Johnson's (1998) zone without contact: a disc of the radius c
// pulls with pi c^2 sigma0 and draws its middle out by 2 sigma0 c/E*.
TEST(MaugisPoint, GoesOnAsAUniformlyPulledDisc) {
  for (const double lambda : {0.01, 0.3, 1.0, 10.0}) {
    const MaugisPoint point = maugis_point(lambda, 0.0);
    const double c = std::sqrt(-2.0 * point.load / (pi * lambda));
    EXPECT_EQ(point.contact_radius, 0.0);
    EXPECT_NEAR(point.indentation / (-4.0 / 3.0 * lambda * c), 1.0, kRounding);
    const MaugisPoint zone = maugis_point(lambda, 1e-15);
    EXPECT_NEAR(zone.load / point.load, 1.0, kRounding);
    EXPECT_NEAR(zone.indentation / point.indentation, 1.0, kRounding);
    EXPECT_NEAR(maugis_point(lambda, 40.0).load, 0.0, 1e-15);
  }
}

TEST(MaugisDugdale, IsJkrForLargeLambda) {
  RandomInteraction random(3);
  for (int i = 0; i < kMaterials; ++i) {
    const AdhesiveContact contact = adhesive_contact(random());
    const MaugisUnits units = maugis_units(contact);
    const double lambda = 1e4;
    const double load = random.between(0.5, 1e3) - 1.99;
    const MaugisPoint point = maugis_point(lambda, maugis_at_load(lambda, load));
    const Length radius = jkr_contact_radius(contact, load * units.load);
    EXPECT_NEAR(point.contact_radius * units.radius / radius, 1.0, 1e-6);
    EXPECT_NEAR((point.indentation * units.indentation - jkr_indentation(contact, radius)) / units.indentation, 0.0,
                2e-6 * (1.0 + point.indentation));
  }
  EXPECT_NEAR(maugis_point(1e4, maugis_pull_off(1e4)).load, -1.5, 1e-7);
  EXPECT_NEAR(maugis_point(1e4, maugis_fixed_grips_end(1e4)).load, -5.0 / 6.0, 1e-4);
}

TEST(MaugisDugdale, IsDmtForSmallLambda) {
  RandomInteraction random(4);
  for (int i = 0; i < kMaterials; ++i) {
    const AdhesiveContact contact = adhesive_contact(random());
    const MaugisUnits units = maugis_units(contact);
    const double lambda = 1e-6;
    const double load = random.between(0.1, 1e3) - 2.0;
    const MaugisPoint point = maugis_point(lambda, maugis_at_load(lambda, load));
    const Length radius = dmt_contact_radius(contact, load * units.load);
    EXPECT_NEAR(point.contact_radius * units.radius / radius, 1.0, 1e-3);
    EXPECT_NEAR(point.indentation * units.indentation / (radius * radius / contact.tip_radius), 1.0, 1e-2);
  }
  EXPECT_NEAR(maugis_point(1e-6, maugis_pull_off(1e-6)).load, -2.0, 1e-5);
}

TEST(MaugisDugdale, PullsOffBetweenDmtAndJkrAndLessTheSofter) {
  double previous = -2.0;
  for (double lambda = 1e-3; lambda < 1e3; lambda *= 1.1) {
    const double load = maugis_point(lambda, maugis_pull_off(lambda)).load;
    EXPECT_GT(load, previous);
    EXPECT_LE(load, -1.5);
    previous = load;
  }
}

// Carpick, Ogletree & Salmeron's fits (1999), within the 1.7 % that separates them from the solution at most.
TEST(MaugisDugdale, AgreesWithTheFitsThatPeopleUse) {
  for (double lambda = 0.01; lambda < 100.0; lambda *= 1.2) {
    const double x = 4.04 * std::pow(lambda, 1.4);
    EXPECT_NEAR(maugis_point(lambda, maugis_pull_off(lambda)).load / (-7.0 / 4.0 + (x - 1.0) / (4.0 * (x + 1.0))), 1.0,
                0.017);
    const double y = 2.28 * std::pow(lambda, 1.3);
    EXPECT_NEAR(
        maugis_point(lambda, maugis_at_load(lambda, 0.0)).contact_radius / (1.54 + 0.279 * (y - 1.0) / (y + 1.0)), 1.0,
        0.017);
  }
}

TEST(MaugisDugdale, SolutionsLieWhereTheyShould) {
  RandomInteraction random(5);
  for (int i = 0; i < kMaterials; ++i) {
    const double lambda = random.between(1e-3, 1e4);
    const double load = random.between(0.6, 1e3) - 2.1;
    const double pull_off = maugis_pull_off(lambda);
    const MaugisPoint least = maugis_point(lambda, pull_off);
    EXPECT_LT(maugis_point(lambda, pull_off * (1.0 + 1e-6)).dload_ds, 0.0);
    EXPECT_GT(maugis_point(lambda, pull_off * (1.0 - 1e-6)).dload_ds, 0.0);
    const double end = maugis_fixed_grips_end(lambda);
    EXPECT_GE(end, pull_off);
    EXPECT_LE(maugis_point(lambda, end).indentation, least.indentation);
    if (load <= least.load) {
      EXPECT_THROW(maugis_at_load(lambda, load), std::invalid_argument);
    } else {
      EXPECT_NEAR(maugis_point(lambda, maugis_at_load(lambda, load)).load, load, 1e-11 * (2.0 + load));
    }
  }
}

TEST(MaugisUnits, AreMaugisOwn) {
  const AdhesiveContact contact{20_nm, 10_GPa, 50_mJ_per_m2};
  const MaugisUnits units = maugis_units(contact);
  const Pressure k = 4.0 / 3.0 * contact.reduced_modulus;
  // a^3 K/R is Hertz' load of the radius a, delta = a^2/R his indentation
  EXPECT_NEAR(units.radius * units.radius * units.radius * k / contact.tip_radius / units.load, 1.0, kRounding);
  EXPECT_NEAR(units.radius * units.radius / contact.tip_radius / units.indentation, 1.0, kRounding);
  const Pressure stress = cohesive_stress(contact.work_of_adhesion, 0.3_nm);
  const double printed_lambda =
      2.0 * stress.si * std::cbrt(contact.tip_radius.si / (pi * contact.work_of_adhesion.si * k.si * k.si));
  EXPECT_NEAR(maugis_lambda(contact, stress), printed_lambda, kRounding * printed_lambda);
}

// The law that joins it to van der Waals attraction.

struct JoinedLaw {
  ContactParameters contact;
  ForceLaw law;
  bool single_valued() const { return law.attached.at(law.attached.last).h > 0.5_mm; }
  // End of the contact, or of an equally strong pull.
  double contact_end() const { return single_valued() ? law.attached.kinks.back() : law.attached.last; }
  bool is_near_kink(double s) const {
    const auto& kinks = law.attached.kinks;
    return std::any_of(kinks.begin(), kinks.end(), [s](double kink) { return std::abs(s - kink) < 0.01; });
  }
};

template <class Check>
void for_random_laws(Check check, int materials = kMaterials) {
  RandomInteraction random(6);
  int single_valued = 0;
  for (int i = 0; i < materials; ++i) {
    const ContactParameters m = random();
    const JoinedLaw joined{m, maugis_law(m)};
    single_valued += joined.single_valued() ? 1 : 0;
    check(joined, random);
  }
  // checks that both kinds occurred
  EXPECT_GT(single_valued, materials / 20);
  EXPECT_LT(single_valued, materials - materials / 20);
}

TEST(MaugisLaw, FreeBranchEndsOnTheContactsCurve) {
  for_random_laws([](const JoinedLaw& joined, RandomInteraction&) {
    const ForceLaw& law = joined.law;
    const LawPoint formed = law.free.at(law.free.last);
    // the attached branch's point with that height, by halving: along the contact the height rises
    double inner = law.attached.first;
    double outer = joined.contact_end();
    if (joined.single_valued()) {
      // one curve, so far in that no lever has a fold beyond it
      EXPECT_EQ(law.attached.at(-law.free.last).force, formed.force);
      EXPECT_NEAR(formed.dforce_ds * law.contact_gap.si / (adhesion_force(joined.contact).si * formed.dh_ds), 0.0,
                  1e-6);
      return;
    }
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (inner + outer);
      (law.attached.at(middle).h < formed.h ? inner : outer) = middle;
    }
    // near the end under fixed grips a rounding of the height moves the force by its square root
    EXPECT_NEAR(law.attached.at(outer).force.si, formed.force.si, 1e-7 * -formed.force.si);
  });
}

TEST(MaugisLaw, ContactPullsHarderThanTheFreeTipWhereverBothAre) {
  for_random_laws([](const JoinedLaw& joined, RandomInteraction& random) {
    if (joined.single_valued()) return;
    const auto& [m, law] = joined;
    const double unit = random.between(1.0, 2.0) - 1.0;
    const LawPoint attached = law.attached.at(law.attached.first + unit * (law.attached.last - law.attached.first));
    if (attached.h <= law.free.at(law.free.last).h) return;
    EXPECT_LE(attached.force, VanDerWaals(m.hamaker, m.tip_radius).force(attached.h));
  });
}

// Whatever the lever, from one without stiffness to fixed grips.
TEST(MaugisLaw, EveryCycleDissipatesAndEveryJumpLosesEnergy) {
  const auto check = [](const JoinedLaw& joined, RandomInteraction& random) {
    ContactParameters m = joined.contact;
    for (const double stiffness : {0.01, random.between(0.1, 1e6), HUGE_VAL}) {
      m.spring_constant = Stiffness(stiffness);
      const auto tables = build_law_tables(Law::MaugisDugdale, joined.law, m);
      const CycleFigures& figures = tables->figures;
      const Energy rounding = 1e-9 * (adhesion_force(m) * joined.law.contact_gap + abs(figures.loop_energy));
      EXPECT_GE(figures.z_joc, figures.z_jtc);
      EXPECT_GE(figures.loop_energy, -rounding);
      EXPECT_GE(figures.lost_at_jtc, -rounding);
      EXPECT_GE(figures.lost_at_joc, -rounding);
      // near the end under fixed grips, a rounding of Z moves the force by its square root
      EXPECT_LE(figures.force_after_jtc, figures.force_before_jtc + 1e-6 * adhesion_force(m));
      EXPECT_TRUE(!figures.hysteretic || stiffness < 1.001 * figures.critical_stiffness.si || !joined.single_valued());
    }
  };
  const int kTabulated = support::draws(1'500);
  for_random_laws(check, kTabulated);
}

TEST(MaugisLaw, BranchesAreContinuousAndTheirDerivativesTrue) {
  for_random_laws([](const JoinedLaw& joined, RandomInteraction& random) {
    const LawBranch& branch = joined.law.attached;
    if (joined.single_valued()) {
      const LawPoint below = branch.at(joined.contact_end() - 1e-14);
      const LawPoint above = branch.at(joined.contact_end());
      EXPECT_NEAR((below.h - above.h) / joined.law.contact_gap, 0.0, kRounding);
      EXPECT_NEAR(below.force / above.force, 1.0, 10.0 * kRounding);
    }
    const double end = joined.contact_end();
    const double step = 1e-5;
    const double s = end - random.between(0.01, end - branch.first - 0.01);
    if (joined.is_near_kink(s)) return;  // kink with a jump of the derivatives
    const LawPoint before = branch.at(s - step);
    const LawPoint here = branch.at(s);
    const LawPoint after = branch.at(s + step);
    const double force = adhesion_force(joined.contact).si + std::abs(here.force.si) + std::abs(here.dforce_ds);
    const double height = joined.law.contact_gap.si + std::abs(here.h.si) + std::abs(here.dh_ds);
    EXPECT_NEAR((after.force - before.force).si / (2.0 * step), here.dforce_ds, 10.0 * kDifferenceError * force);
    EXPECT_NEAR((after.h - before.h).si / (2.0 * step), here.dh_ds, 10.0 * kDifferenceError * height);
  });
}

TEST(MaugisLaw, PotentialsOfBothBranchesMeetWhereContactForms) {
  for_random_laws([](const JoinedLaw& joined, RandomInteraction&) {
    if (joined.single_valued()) return;
    const auto& [m, law] = joined;
    // from the end back to the formation of the contact, by the trapezoidal rule over the square root of the path
    const LawPoint formed = law.free.at(law.free.last);
    double inner = law.attached.first;
    double outer = law.attached.last;
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (inner + outer);
      (law.attached.at(middle).h < formed.h ? inner : outer) = middle;
    }
    constexpr int kSteps = 600;
    const double way = std::sqrt(law.attached.last - outer);
    Energy work;
    LawPoint previous = law.attached.at(law.attached.last);
    for (int k = 1; k <= kSteps; ++k) {
      const double left = way * k / kSteps;
      const LawPoint point = law.attached.at(law.attached.last - left * left);
      work = work + 0.5 * (point.force + previous.force) * (previous.h - point.h);
      previous = point;
    }
    const Energy free = VanDerWaals(m.hamaker, m.tip_radius).potential(formed.h);
    EXPECT_NEAR((*law.attached_end_potential + work) / free, 1.0, 1e-3 * (1.0 + abs(work) / abs(free)));
  });
}

TEST(MaugisLaw, IsDmtsForAStiffContact) {
  ContactParameters m = RandomInteraction(7)();
  m.reduced_modulus = 10000_GPa;
  m.mean_surface_energy = 0.5_mJ_per_m2;
  m.tip_radius = 10_nm;
  const ForceLaw maugis = maugis_law(m);
  const ForceLaw dmt = dmt_law(m);
  EXPECT_EQ(maugis.contact_gap, dmt.contact_gap);
  const LawPoint point = maugis.attached.at(0.0);
  EXPECT_NEAR(point.h / dmt.contact_gap, 1.0, 0.01);
  EXPECT_NEAR(point.force / -adhesion_force(m), 1.0, 0.01);
  EXPECT_NEAR(maugis.attached.at(maugis.attached.last).h.si, 1e-3, 1e-8);
}

TEST(MaugisLaw, IsJkrsShiftedByTheContactGapForASoftContact) {
  ContactParameters m = RandomInteraction(8)();
  m.reduced_modulus = Pressure(1e6);
  m.mean_surface_energy = 20_mJ_per_m2;
  m.tip_radius = 1_um;
  const AdhesiveContact contact = adhesive_contact(m);
  const ForceLaw law = maugis_law(m);
  EXPECT_EQ(law.contact_gap, contact_gap(m));
  const LawPoint end = law.attached.at(law.attached.last);
  const Length radius = jkr_fixed_grips_radius(contact);
  EXPECT_NEAR(end.force / jkr_load(contact, radius), 1.0, 0.03);
  EXPECT_NEAR((end.h - law.contact_gap) / -jkr_indentation(contact, radius), 1.0, 0.03);
}

}  // namespace maugis_dugdale_test
}  // namespace afm::physics
