// SPDX-License-Identifier: Apache-2.0
// Invariant: a law returns no more energy than it stores
#include "haptics/potential_energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "servo_bench.h"

namespace potential_energy_test {

using afm::haptics::ContactModel;
using afm::haptics::PotentialEnergy;
using afm::physics::Law;
using afm::physics::Phase;

constexpr PotentialEnergy::Range kRange{-0.12, 0.12};

// The paper's law on a scale that makes it a spring: no force above, K towards zero height once it sticks.
PotentialEnergy spring(double stiffness_n_per_m, double jump_in_m) {
  return {[](double) { return 0.0; }, [=](double h) { return -stiffness_n_per_m * h; }, jump_in_m, kRange};
}

// E0, the energy far away that one approach can give.
double credit_j(const PotentialEnergy& stored) { return stored.at(Phase::Free, kRange.highest_m); }

TEST(PotentialEnergy, CreditsTheSpringThatTheTipJumpsInto) {
  for (const double jump_in_m : {0.00856, 0.002, 0.0075}) {
    EXPECT_NEAR(credit_j(spring(40.0, jump_in_m)), 0.5 * 40.0 * jump_in_m * jump_in_m, 1e-7);
  }
}

TEST(PotentialEnergy, IsThatOfTheSpringAtEveryHeight) {
  const PotentialEnergy stored = spring(40.0, 0.00856);
  for (double h = -0.1; h < 0.1; h += 0.00037) {
    EXPECT_NEAR(stored.at(Phase::Attached, h), 20.0 * h * h, 1e-7);
    EXPECT_NEAR(stored.at(Phase::Free, h), credit_j(stored), 1e-12);
    EXPECT_EQ(stored.at(Phase::WaitForLift, h), 0.0);
  }
  EXPECT_NEAR(stored.stiffness_n_per_m(), 40.0, 1e-9);
}

TEST(PotentialEnergy, GoesOnStraightBeyondItsRange) {
  const PotentialEnergy stored = spring(40.0, 0.00856);
  const double slope = stored.at(Phase::Attached, 0.13) - stored.at(Phase::Attached, 0.125);
  EXPECT_NEAR(stored.at(Phase::Attached, 0.2) - stored.at(Phase::Attached, 0.195), slope, 1e-9);
  EXPECT_EQ(stored.at(Phase::Attached, std::numeric_limits<double>::quiet_NaN()), 0.0);
}

struct AnyLaw {
  std::string name;
  Law law;
};

class StoredEnergyOf : public testing::TestWithParam<AnyLaw> {
 protected:
  StoredEnergyOf() {
    afm::scene::SharedContact mica = afm::test::paper_model().materials[afm::test::kMica];
    mica.law = GetParam().law;
    mica.contact.reduced_modulus.si = 51.5e9;
    tables_ = afm::test::required(afm::haptics::build_tables(mica, {}));
    model_ = afm::test::model_of(mica);
  }

  double force_n(const afm::physics::BranchTable& branch, double height_m) const {
    const auto& scaling = model_->scaling();
    return scaling.hand_force_n(branch.force(afm::physics::Length(scaling.z_m(height_m))).si);
  }

  std::shared_ptr<const afm::physics::LawTables> tables_;
  std::unique_ptr<ContactModel> model_;
};

TEST_P(StoredEnergyOf, FallsByTheWorkOfTheForceOnBothBranches) {
  const PotentialEnergy& stored = model_->stored_energy();
  const double jump_in_m = tables_->figures.z_jtc.si * model_->scaling().hand_m_per_m();
  for (const auto& [phase, branch, from, to] : {std::tuple(Phase::Free, &tables_->free, jump_in_m, 0.080),
                                                std::tuple(Phase::Attached, &tables_->attached, -0.030, 0.050)}) {
    double work_j = 0.0;
    const double step_m = 1e-6;
    for (double h = from; h < to; h += step_m) work_j += force_n(*branch, h + 0.5 * step_m) * step_m;
    EXPECT_NEAR(stored.at(phase, from) - stored.at(phase, to), work_j, 3e-6);
  }
}

TEST_P(StoredEnergyOf, NeverRisesInAJumpAndIsNowhereBelowZero) {
  const PotentialEnergy& stored = model_->stored_energy();
  const auto& figures = tables_->figures;
  const double in_m = figures.z_jtc.si * model_->scaling().hand_m_per_m();
  const double off_m = figures.z_joc.si * model_->scaling().hand_m_per_m();
  EXPECT_NEAR(stored.at(Phase::Free, in_m), stored.at(Phase::Attached, in_m), 1e-12);
  EXPECT_GE(stored.at(Phase::Attached, off_m), stored.at(Phase::Free, off_m) - 1e-6);
  for (double h = -0.12; h < 0.12; h += 0.0003) {
    EXPECT_GE(stored.at(Phase::Attached, h), -1e-9);
    EXPECT_GE(stored.at(Phase::Free, std::max(h, in_m)), -1e-6);
  }
  EXPECT_LE(stored.stiffness_n_per_m(), 400.0 * 1.05);
}

INSTANTIATE_TEST_SUITE_P(Laws, StoredEnergyOf,
                         testing::Values(AnyLaw{"Paper", Law::Paper}, AnyLaw{"Hao", Law::Hao},
                                         AnyLaw{"Hertz", Law::Hertz}, AnyLaw{"Dmt", Law::Dmt}, AnyLaw{"Jkr", Law::Jkr},
                                         AnyLaw{"MaugisDugdale", Law::MaugisDugdale},
                                         AnyLaw{"LennardJones", Law::LennardJones}),
                         [](const auto& test) { return test.param.name; });

}  // namespace potential_energy_test
