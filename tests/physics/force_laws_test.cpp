// SPDX-License-Identifier: Apache-2.0
// The laws as curves: what physics/force_law.h promises of every branch, for every law.
#include "physics/force_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "curve_laws.h"
#include "physics/contact.h"
#include "physics/jkr.h"
#include "physics/van_der_waals.h"
#include "random_interaction.h"

namespace afm::physics {
namespace force_laws_test {

using namespace literals;
using std::numbers::pi;

constexpr int kMaterials = 10'000;
// central differences over a step of 1e-5 in a parameter whose natural scale is 1
constexpr double kStep = 1e-5;
constexpr double kDifferenceError = 1e-8;
constexpr double kRounding = 1e-12;

// A place on a branch, away from its ends, and farther from its kinks: the second derivative of a Hertzian contact has
// no bound where it begins.
double somewhere_on(const LawBranch& branch, RandomInteraction& random) {
  for (;;) {
    const double s = branch.first + (branch.last - branch.first) * (random.between(1.0, 2.0) - 1.0);
    const auto near = [&](double corner) { return std::abs(s - corner) <= 0.05; };
    if (near(branch.first) || near(branch.last) || std::any_of(branch.kinks.begin(), branch.kinks.end(), near))
      continue;
    return s;
  }
}

void expect_exact_derivatives(const LawBranch& branch, double s, const std::string& where) {
  const LawPoint before = branch.at(s - kStep);
  const LawPoint here = branch.at(s);
  const LawPoint after = branch.at(s + kStep);
  const double dh = (after.h - before.h).si / (2.0 * kStep);
  const double df = (after.force - before.force).si / (2.0 * kStep);
  // height covered by the curve near this place, and the rounding of a difference of two large numbers
  const double height = std::abs(here.h.si) + std::abs(here.dh_ds);
  const double force = std::abs(here.force.si) + std::abs(here.dforce_ds);
  EXPECT_NEAR(here.dh_ds, dh, kDifferenceError * height) << where << " at s = " << s;
  EXPECT_NEAR(here.dforce_ds, df, kDifferenceError * force) << where << " at s = " << s;
}

template <class Check>
void for_every_law(Check check) {
  for (const Law name : curve_laws()) {
    RandomInteraction random(static_cast<unsigned>(name));
    for (int i = 0; i < kMaterials; ++i) {
      const ContactParameters m = random();
      check(name, m, force_law(name, m), random);
    }
  }
}

TEST(ForceLaws, DerivativesAreThoseOfTheCurve) {
  for_every_law([](Law name, const ContactParameters&, const ForceLaw& law, RandomInteraction& random) {
    expect_exact_derivatives(law.free, somewhere_on(law.free, random), std::string(name_of(name)) + ", free");
    expect_exact_derivatives(law.attached, somewhere_on(law.attached, random),
                             std::string(name_of(name)) + ", attached");
  });
}

TEST(ForceLaws, ParametersRiseAlongBothBranchesAndKinksLieBetween) {
  for_every_law([](Law, const ContactParameters&, const ForceLaw& law, RandomInteraction&) {
    for (const LawBranch* branch : {&law.free, &law.attached}) {
      EXPECT_LT(branch->first, branch->last);
      EXPECT_TRUE(std::is_sorted(branch->kinks.begin(), branch->kinks.end()));
      for (const double kink : branch->kinks) {
        EXPECT_GT(kink, branch->first);
        EXPECT_LT(kink, branch->last);
      }
    }
  });
}

TEST(ForceLaws, BranchesAreContinuousAtTheirKinks) {
  std::size_t kinks = 0;
  for_every_law([&kinks](Law name, const ContactParameters& m, const ForceLaw& law, RandomInteraction&) {
    for (const double kink : law.attached.kinks) {
      const LawPoint below = law.attached.at(kink - 1e-13);
      const LawPoint above = law.attached.at(kink + 1e-13);
      EXPECT_NEAR((below.h - above.h).si, 0.0, kRounding * (m.atomic_distance + law.contact_gap).si) << name_of(name);
      EXPECT_NEAR(below.force.si, above.force.si, kRounding * adhesion_force(m).si) << name_of(name);
      ++kinks;
    }
  });
  EXPECT_GT(kinks, 1000U);
}

TEST(ForceLaws, ReachAMillimetreBothWays) {
  for_every_law([](Law name, const ContactParameters& m, const ForceLaw& law, RandomInteraction&) {
    EXPECT_GE(law.free.at(law.free.first).h.si, 0.999e-3) << name_of(name);
    const LawPoint deepest = law.attached.at(law.attached.first);
    EXPECT_LE((deepest.h - deepest.force / m.spring_constant).si, -0.999e-3) << name_of(name);
  });
}

TEST(ForceLaws, NeverPushATipThatDoesNotTouchAndNeverRiseTowardsContact) {
  for_every_law([](Law name, const ContactParameters&, const ForceLaw& law, RandomInteraction& random) {
    const LawPoint point = law.free.at(somewhere_on(law.free, random));
    EXPECT_LE(point.force, Force()) << name_of(name);
    EXPECT_LT(point.dh_ds, 0.0) << name_of(name);
    EXPECT_LE(point.dforce_ds, 0.0) << name_of(name);
  });
}

TEST(ForceLaws, PullNoHarderThanTheirAdhesion) {
  for_every_law([](Law name, const ContactParameters& m, const ForceLaw& law, RandomInteraction& random) {
    const double limit = name == Law::Jkr ? 0.75 : name == Law::Hertz ? 0.0 : 1.0;
    const LawPoint point = law.attached.at(somewhere_on(law.attached, random));
    EXPECT_GE(point.force.si, -limit * adhesion_force(m).si * (1.0 + kRounding)) << name_of(name);
  });
}

// DMT, Lennard-Jones and Hertz: the attached branch passes through every point of the free one.
TEST(ForceLaws, SingleValuedLawsAreOneCurve) {
  for (const Law name : {Law::Hertz, Law::Dmt, Law::LennardJones}) {
    RandomInteraction random(7);
    for (int i = 0; i < kMaterials; ++i) {
      const ForceLaw law = force_law(name, random());
      const double s = somewhere_on(law.free, random);
      const LawPoint free = law.free.at(s);
      const LawPoint attached = law.attached.at(-s);
      EXPECT_NEAR(free.h / attached.h, 1.0, kRounding);
      EXPECT_NEAR(free.force.si, attached.force.si, -kRounding * attached.force.si);
      EXPECT_NEAR(law.free.at(law.free.last).h.si, law.contact_gap.si, kRounding * law.contact_gap.si);
    }
  }
}

// The potential at the attached branch's end plus the work from there is the potential anywhere else: known far inside
// by other means for JKR, and for the others where the tip is farthest.
TEST(ForceLaws, PotentialAtTheEndIsThatOfTheLaw) {
  RandomInteraction random(8);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    const ForceLaw dmt = dmt_law(m);
    const Length farthest = dmt.attached.at(dmt.attached.last).h;
    EXPECT_NEAR(*dmt.attached_end_potential / (-m.hamaker * m.tip_radius / (6.0 * farthest)), 1.0, kRounding);
    const AdhesiveContact contact = adhesive_contact(m);
    EXPECT_NEAR(*jkr_law(m).attached_end_potential / jkr_energy(contact, jkr_fixed_grips_radius(contact)), 1.0, 1e-14);
    EXPECT_EQ(*hertz_law(m).attached_end_potential, Energy());
    EXPECT_FALSE(hao_law(m).attached_end_potential);
  }
}

TEST(ForceLaws, ExactSphereAndRetardationKeepTheAdhesion) {
  RandomInteraction random(9);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    const LawOptions options{.exact_hamaker_sphere = true, .retardation_wavelength = 100_nm, .meniscus = {}};
    const ForceLaw law = dmt_law(m, options);
    EXPECT_NEAR(law.free.at(law.free.last).force / -adhesion_force(m), 1.0, kRounding);
    EXPECT_EQ(law.contact_gap, contact_gap(m, options));
    EXPECT_LT(law.contact_gap, dmt_law(m).contact_gap);
    expect_exact_derivatives(law.free, somewhere_on(law.free, random), "dmt of the exact sphere");
  }
}

TEST(ForceLaws, RigidDmtIsAWallAtTheContactGap) {
  ContactParameters m = RandomInteraction(10)();
  m.reduced_modulus = Pressure(HUGE_VAL);
  const ForceLaw law = dmt_law(m);
  for (double s = law.attached.first; s < 0.0; s += 0.1) EXPECT_EQ(law.attached.at(s).h, law.contact_gap);
  EXPECT_NEAR(law.attached.at(-1e-15).force / -adhesion_force(m), 1.0, kRounding);
  EXPECT_GT(law.attached.at(law.attached.first).force.si, 900.0);
}

TEST(ForceLaws, RefuseWhatTheyCannotCompute) {
  ContactParameters m = RandomInteraction(11)();
  EXPECT_THROW(force_law(Law::Paper, m), std::invalid_argument);
  EXPECT_THROW(force_law(Law::Measured, m), std::invalid_argument);
  EXPECT_THROW(dmt_law(m, {.exact_hamaker_sphere = false, .retardation_wavelength = 0_nm, .meniscus = {}}),
               UnphysicalValue);
  m.reduced_modulus = Pressure(HUGE_VAL);
  EXPECT_THROW(hertz_law(m), UnphysicalValue);
  EXPECT_THROW(jkr_law(m), UnphysicalValue);
  m.tip_radius = -1_nm;
  for (const Law name : curve_laws()) EXPECT_THROW(force_law(name, m), UnphysicalValue);
}

TEST(LawNames, AreReadBack) {
  for (const LawTraits& row : kLawTable) EXPECT_EQ(law_of(name_of(row.law)), row.law);
  EXPECT_EQ(law_of("hertzian"), std::nullopt);
  EXPECT_EQ(law_of(""), std::nullopt);
  EXPECT_EQ(name_of(static_cast<Law>(99)), "unknown");
}

}  // namespace force_laws_test
}  // namespace afm::physics
