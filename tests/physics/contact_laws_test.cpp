// SPDX-License-Identifier: Apache-2.0
// Hertz, DMT and JKR by themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/contact.h"
#include "physics/hertz.h"
#include "physics/jkr.h"
#include "physics/jkr_pull_off.h"
#include "random_interaction.h"

namespace afm::physics {
namespace contact_laws_test {

using namespace literals;
using std::numbers::pi;
using testing::HasSubstr;

constexpr double kRounding = 1e-13;
// central differences over 1e-5 of their argument
constexpr double kDifferenceError = 1e-8;
constexpr int kMaterials = 10'000;

template <class Check>
void for_random_contacts(Check check) {
  RandomInteraction random(1);
  for (int i = 0; i < kMaterials; ++i) check(adhesive_contact(random()), random);
}

TEST(AdhesiveContact, RefusesARigidOne) {
  ContactParameters rigid = RandomInteraction(1)();
  rigid.reduced_modulus = Pressure(HUGE_VAL);
  try {
    adhesive_contact(rigid);
    FAIL() << "not refused";
  } catch (const UnphysicalValue& error) {
    EXPECT_EQ(error.field(), "reduced_modulus");
    EXPECT_THAT(error.what(), HasSubstr("reduced modulus is infinite"));
  }
}

TEST(Hertz, LoadIndentationAndRadiusAreOneRelation) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction& random) {
    const Force load(random.between(1e-12, 1e-3));
    const Length radius = hertz_contact_radius(contact, load);
    EXPECT_NEAR(hertz_load(contact, radius * radius / contact.tip_radius) / load, 1.0, kRounding);
  });
}

TEST(Hertz, StiffnessIsTheSlopeOfTheLoad) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction& random) {
    const Length delta(random.between(1e-13, 1e-6));
    const Length step = 1e-5 * delta;
    const Stiffness slope = (hertz_load(contact, delta + step) - hertz_load(contact, delta - step)) / (2.0 * step);
    const Length radius = sqrt(contact.tip_radius * delta);
    EXPECT_NEAR(slope / hertz_stiffness(contact, radius), 1.0, kDifferenceError);
  });
}

TEST(Hertz, DoesNotPullATipThatDoesNotTouch) {
  const AdhesiveContact contact{50_nm, 1_GPa, 50_mJ_per_m2};
  EXPECT_EQ(hertz_load(contact, Length()), Force());
  EXPECT_EQ(hertz_load(contact, -1_nm), Force());
}

TEST(Dmt, IsHertzUnderALoadIncreasedByTheAdhesion) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction& random) {
    const Force load(random.between(1e-12, 1e-3));
    const Length radius = dmt_contact_radius(contact, load - dmt_adhesion(contact));
    EXPECT_NEAR(radius / hertz_contact_radius(contact, load), 1.0, 1e-9);
    EXPECT_EQ(dmt_contact_radius(contact, -dmt_adhesion(contact)), Length());
  });
}

TEST(Jkr, RadiusAtALoadIsTheStableOneThatCarriesIt) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction& random) {
    const Force unit = pi * contact.work_of_adhesion * contact.tip_radius;
    for (const Force load : {-1.4999 * unit, -1.0 * unit, Force(), random.between(1e-3, 1e6) * unit}) {
      const Length radius = jkr_contact_radius(contact, load);
      EXPECT_GE(radius, jkr_pull_off_radius(contact));
      const Force scale = abs(load) + unit;
      EXPECT_NEAR((jkr_load(contact, radius) - load) / scale, 0.0, 1e-12);
    }
  });
}

TEST(Jkr, PullsOffWhereTheLoadIsLeast) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction&) {
    const Length radius = jkr_pull_off_radius(contact);
    const Force load = jkr_pull_off_load(contact);
    EXPECT_NEAR(jkr_load(contact, radius) / load, 1.0, kRounding);
    for (const double away : {0.5, 0.99, 1.01, 2.0}) EXPECT_GT(jkr_load(contact, away * radius), load);
  });
}

TEST(Jkr, LosesFixedGripsWhereTheNeckIsLongest) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction&) {
    const auto& [r, e, w] = contact;
    const Length radius = jkr_fixed_grips_radius(contact);
    const Length neck = jkr_indentation(contact, radius);
    EXPECT_NEAR(neck / (-0.75 * cbrt(pi * pi * (w / e) * (w / e) * r)), 1.0, kRounding);
    EXPECT_NEAR(jkr_load(contact, radius) / (-5.0 / 6.0 * pi * w * r), 1.0, kRounding);
    for (const double away : {0.5, 0.99, 1.01, 2.0}) EXPECT_GT(jkr_indentation(contact, away * radius), neck);
  });
}

TEST(Jkr, LoadIsTheSlopeOfTheEnergy) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction& random) {
    const Length a = random.between(0.1, 100.0) * jkr_pull_off_radius(contact);
    const Length step = 1e-5 * a;
    const Energy work = jkr_energy(contact, a + step) - jkr_energy(contact, a - step);
    const Length way = jkr_indentation(contact, a + step) - jkr_indentation(contact, a - step);
    const Force hertz = 4.0 / 3.0 * contact.reduced_modulus * a * a * a / contact.tip_radius;
    const Force scale = hertz + pi * contact.work_of_adhesion * contact.tip_radius;
    const Length length_scale = a * a / contact.tip_radius + abs(jkr_indentation(contact, a));
    EXPECT_NEAR((work - jkr_load(contact, a) * way).si, 0.0, kDifferenceError * (scale * length_scale).si * 1e-4);
  });
}

TEST(Jkr, TouchesWithZeroGapAtFourThirds) {
  for_random_contacts([](const AdhesiveContact& contact, RandomInteraction&) {
    const auto& [r, e, w] = contact;
    const Length touching = cbrt(2.0 * pi * w * r * r / e);
    EXPECT_NEAR(jkr_indentation(contact, touching) * r / (touching * touching), 0.0, kRounding);
    EXPECT_NEAR(jkr_load(contact, touching) / (-4.0 / 3.0 * pi * w * r), 1.0, kRounding);
  });
}

TEST(Jkr, RefusesALoadThatNoContactHolds) {
  const AdhesiveContact contact{50_nm, 1_GPa, 50_mJ_per_m2};
  try {
    jkr_contact_radius(contact, -12_nN);
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "load -12 nN tears the contact off, which holds -11.781 nN");
  }
  EXPECT_THROW(jkr_contact_radius(contact, Force(std::nan(""))), std::invalid_argument);
}

}  // namespace contact_laws_test
}  // namespace afm::physics
