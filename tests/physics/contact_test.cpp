// SPDX-License-Identifier: Apache-2.0
#include "physics/contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace afm::physics {
namespace contact_test {

using namespace literals;
using testing::HasSubstr;

// closed forms differ from each other only by rounding
constexpr double kRounding = 1e-14;

const Stiffness kRigid(std::numeric_limits<double>::infinity());
const std::array<Stiffness, 6> kSampleStiffnesses{0.01_N_per_m, 0.05_N_per_m, 0.1_N_per_m,
                                                  1_N_per_m,    1e9_N_per_m,  kRigid};

ContactParameters mica(Stiffness sample_stiffness = kRigid) {
  return {50_nm, 0.1_N_per_m, sample_stiffness, 24.5_zJ, 2.228_mJ_per_m2};
}

template <class Q>
void expect_ratio(Q a, Q b, double ratio) {
  EXPECT_NEAR(a / b, ratio, kRounding * ratio);
}

TEST(Contact, GapIsTwiceAlphaTimesDeflectionForAnyAlpha) {
  for (const Stiffness k_s : kSampleStiffnesses) {
    const auto events = approach_retract_events(mica(k_s));
    expect_ratio(events.d_attr, events.delta_c_attr, 2.0 * events.alpha);
  }
}

TEST(Contact, JumpToContactIsThreeHalvesOfItsGapForAnyAlpha) {
  for (const Stiffness k_s : kSampleStiffnesses) {
    const auto events = approach_retract_events(mica(k_s));
    expect_ratio(events.z_jtc, events.d_attr, 1.5);
  }
}

TEST(Contact, JumpSharesOutBetweenGapLeverAndSample) {
  for (const Stiffness k_s : kSampleStiffnesses) {
    const auto events = approach_retract_events(mica(k_s));
    expect_ratio(events.d_attr + events.delta_c_attr + events.delta_s_attr, events.z_jtc, 1.0);
  }
}

// A_H R/(6 D^2) of a sphere and a half-space, on which (3.8) and (3.9) rest.
Force attraction(const ContactParameters& contact, Length gap) {
  return contact.hamaker * contact.tip_radius / (6.0 * gap * gap);
}

TEST(Contact, LeverBalancesVanDerWaalsAttractionAtTheFold) {
  for (const Stiffness k_s : kSampleStiffnesses) {
    const ContactParameters contact = mica(k_s);
    const auto events = approach_retract_events(contact);
    expect_ratio(attraction(contact, events.d_attr), events.f_fold, 1.0);
  }
}

// Z(D) = D + (1/k_c + 1/k_s) A_H R/(6 D^2) has its minimum where the tip jumps (Hao et al. 1991).
TEST(Contact, JumpToContactIsTheFoldOfTheEquilibrium) {
  for (const Stiffness k_s : kSampleStiffnesses) {
    const ContactParameters contact = mica(k_s);
    const auto events = approach_retract_events(contact);
    const auto z = [&](Length gap) { return gap + attraction(contact, gap) / effective_stiffness(contact); };
    expect_ratio(z(events.d_attr), events.z_jtc, 1.0);
    for (const double away : {0.5, 0.9, 0.999, 1.001, 1.1, 2.0}) EXPECT_GT(z(events.d_attr * away), events.z_jtc);
  }
}

TEST(Contact, RigidSampleHasAlphaOneAndTheLeversStiffness) {
  const auto events = approach_retract_events(mica());
  EXPECT_EQ(events.alpha, 1.0);
  EXPECT_EQ(events.effective_stiffness, 0.1_N_per_m);
  EXPECT_EQ(events.delta_s_attr, 0_nm);
}

TEST(Contact, StiffSampleTendsToTheRigidOne) {
  const auto stiff = approach_retract_events(mica(1e12_N_per_m));
  const auto rigid = approach_retract_events(mica());
  EXPECT_NEAR(stiff.z_jtc / rigid.z_jtc, 1.0, 1e-12);
  EXPECT_NEAR(stiff.loop_energy / rigid.loop_energy, 1.0, 1e-12);
}

TEST(Contact, LeverAndSampleInSeriesAreExchangeable) {
  ContactParameters a = mica(0.4_N_per_m);
  ContactParameters b = a;
  std::swap(b.spring_constant, b.sample_stiffness);
  expect_ratio(effective_stiffness(a), effective_stiffness(b), 1.0);
  expect_ratio(jump_to_contact_z(a), jump_to_contact_z(b), 1.0);
}

TEST(Contact, ScalesWithRadius) {
  ContactParameters larger = mica(1_N_per_m);
  const auto before = approach_retract_events(larger);
  larger.tip_radius = larger.tip_radius * 8.0;
  const auto after = approach_retract_events(larger);
  expect_ratio(after.z_jtc, before.z_jtc, 2.0);
  expect_ratio(after.f_ad, before.f_ad, 8.0);
}

TEST(Contact, ScalesWithHamakerConstant) {
  ContactParameters stronger = mica(1_N_per_m);
  const auto before = approach_retract_events(stronger);
  stronger.hamaker = stronger.hamaker * 27.0;
  const auto after = approach_retract_events(stronger);
  expect_ratio(after.z_jtc, before.z_jtc, 3.0);
  expect_ratio(after.f_ad, before.f_ad, 1.0);
}

TEST(Contact, ScalesWithBothStiffnesses) {
  ContactParameters stiffer = mica(1_N_per_m);
  const auto before = approach_retract_events(stiffer);
  stiffer.spring_constant = stiffer.spring_constant * 8.0;
  stiffer.sample_stiffness = stiffer.sample_stiffness * 8.0;
  const auto after = approach_retract_events(stiffer);
  expect_ratio(after.z_jtc, before.z_jtc, 0.5);
  expect_ratio(after.f_attr, before.f_attr, 4.0);
  expect_ratio(after.z_joc, before.z_joc, 1.0 / 8.0);
  expect_ratio(after.f_ad, before.f_ad, 1.0);
}

TEST(Contact, AdhesionScalesWithSurfaceEnergyAlone) {
  ContactParameters stickier = mica();
  const auto before = approach_retract_events(stickier);
  stickier.mean_surface_energy = stickier.mean_surface_energy * 2.0;
  const auto after = approach_retract_events(stickier);
  expect_ratio(after.f_ad, before.f_ad, 2.0);
  expect_ratio(after.work_of_adhesion, before.work_of_adhesion, 2.0);
  expect_ratio(after.z_jtc, before.z_jtc, 1.0);
}

std::string refusal(const ContactParameters& contact, const std::string& field) {
  try {
    validate(contact);
  } catch (const UnphysicalValue& error) {
    EXPECT_EQ(error.field(), field);
    return error.what();
  }
  ADD_FAILURE() << field << " was not refused";
  return "";
}

TEST(Validate, AcceptsTheMaterialsAndARigidSample) { EXPECT_NO_THROW(validate(mica())); }

TEST(Validate, RefusesNegativeZeroNotANumberAndAbsurdValues) {
  for (const double bad : {-1.0, 0.0, std::nan(""), 1e30, -HUGE_VAL}) {
    ContactParameters contact = mica();
    contact.tip_radius = Length(bad);
    refusal(contact, "tip_radius");
    contact = mica();
    contact.spring_constant = Stiffness(bad);
    refusal(contact, "spring_constant");
    contact = mica();
    contact.hamaker = Energy(bad);
    refusal(contact, "hamaker");
    contact = mica();
    contact.mean_surface_energy = SurfaceEnergy(bad);
    refusal(contact, "mean_surface_energy");
  }
  for (const double bad : {-1.0, 0.0, std::nan(""), -HUGE_VAL}) {
    ContactParameters contact = mica();
    contact.sample_stiffness = Stiffness(bad);
    refusal(contact, "sample_stiffness");
  }
}

TEST(Validate, QuotesTheValueWithItsUnitAndTheRange) {
  ContactParameters contact = mica();
  contact.tip_radius = -50_nm;
  EXPECT_EQ(refusal(contact, "tip_radius"), "tip radius -50 nm is not within 100 pm to 1 mm");
  EXPECT_THROW(approach_retract_events(contact), std::invalid_argument);
}

}  // namespace contact_test
}  // namespace afm::physics
