// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/contact.h"
#include "physics/force_model.h"
#include "physics/jkr.h"
#include "physics/law_tables.h"
#include "physics/maugis_dugdale.h"
#include "random_interaction.h"
#include "support/deep.h"

namespace afm::physics {
namespace laws_property_test {

const int kMaterials = support::draws(1'500);  // draws per law: more than ten thousand in all in a deep check

// Tables; null if the paper's law or Hao's has no loop: an adhesion weaker than the van der Waals force at the jump in.
std::shared_ptr<const LawTables> tables_of(Law law, const ContactParameters& contact) {
  try {
    return build_law_tables(law, contact);
  } catch (const UnphysicalValue&) {
    throw;
  } catch (const std::invalid_argument&) {
    if (has_dynamics(law)) throw;
    return nullptr;
  }
}

class LawOfAnyMaterial : public testing::TestWithParam<Law> {
 protected:
  // Calls `check` with the tables of random materials, a third of which lie on a soft support.
  template <class Check>
  void for_each_material(std::uint64_t seed, Check check) const {
    RandomInteraction random(seed);
    int looked_at = 0;
    for (int i = 0; i < kMaterials && !HasFatalFailure(); ++i) {
      ContactParameters contact = random();
      if (i % 3 == 0) contact.sample_stiffness = Stiffness(random.between(0.01, 1e4));
      const auto tables = tables_of(GetParam(), contact);
      if (tables == nullptr) continue;
      SCOPED_TRACE("material " + std::to_string(i));
      check(*tables);
      ++looked_at;
    }
    EXPECT_GT(looked_at, kMaterials / 2);
  }
};

void expect_ratio(double value, double reference, double ratio, double scale, const char* what) {
  ASSERT_NEAR(value, reference * ratio, 1e-8 * scale) << what;
}

// With all lengths times lambda and all forces times phi, every figure changes by the same factors.
TEST_P(LawOfAnyMaterial, KnowsNoUnits) {
  constexpr double kLength = 1.7, kForce = 0.6;
  for_each_material(101, [&](const LawTables& tables) {
    ContactParameters other = tables.contact;
    other.tip_radius = kLength * other.tip_radius;
    other.atomic_distance = kLength * other.atomic_distance;
    other.spring_constant = kForce / kLength * other.spring_constant;
    other.sample_stiffness = kForce / kLength * other.sample_stiffness;
    other.mean_surface_energy = kForce / kLength * other.mean_surface_energy;
    other.hamaker = kForce * kLength * other.hamaker;
    other.reduced_modulus = kForce / kLength / kLength * other.reduced_modulus;
    const CycleFigures& a = tables.figures;
    const auto scaled = build_law_tables(GetParam(), other);
    const CycleFigures& b = scaled->figures;
    // Hertz' contact has neither jump nor pull, so that only the tip's size is left to compare with
    const Length place = std::max(abs(a.z_joc), 0.01 * tables.contact.tip_radius);
    const double length = kLength * place.si;
    const double force = kForce * std::max(abs(a.force_before_joc), abs(tables.attached.force(-place))).si;
    ASSERT_EQ(a.hysteretic, b.hysteretic);
    expect_ratio(b.z_jtc.si, a.z_jtc.si, kLength, length, "z_jtc");
    expect_ratio(b.z_joc.si, a.z_joc.si, kLength, length, "z_joc");
    expect_ratio(b.force_after_jtc.si, a.force_after_jtc.si, kForce, force, "force after jump to contact");
    expect_ratio(b.force_before_joc.si, a.force_before_joc.si, kForce, force, "force before jump off contact");
    expect_ratio(b.loop_energy.si, a.loop_energy.si, kForce * kLength, length * force, "loop energy");
    for (const double share : {-2.0, -0.1, 0.3, 0.9, 1.5}) {
      const Length z = share * place;
      expect_ratio(scaled->attached.force(kLength * z).si, tables.attached.force(z).si, kForce,
                   std::max(force, std::abs(kForce * tables.attached.force(z).si)), "attached");
      expect_ratio(scaled->free.force(kLength * z).si, tables.free.force(z).si, kForce, force, "free");
    }
  });
}

TEST_P(LawOfAnyMaterial, JumpsInBeforeItJumpsOffAndNeverGivesEnergy) {
  for_each_material(102, [](const LawTables& tables) {
    const CycleFigures& figures = tables.figures;
    if (!figures.hysteretic) {
      ASSERT_EQ(figures.z_jtc, figures.z_joc);
      ASSERT_EQ(figures.loop_energy, Energy());
      // where Maugis-Dugdale holds a longer attraction, two narrow loops side by side count as none
      if (GetParam() == Law::MaugisDugdale && tables.contact_gap > 4.0 * tables.contact.atomic_distance) return;
      ASSERT_LE(figures.critical_stiffness, tables.contact.spring_constant * (1.0 + 1e-9));
      return;
    }
    ASSERT_LT(figures.z_jtc, figures.z_joc);
    ASSERT_LT(figures.force_before_joc, Force());
    // a jump to contact pulls, and a jump off contact lets go; Maugis' zone may form without a jump
    ASSERT_LE(figures.force_after_jtc.si, figures.force_before_jtc.si * (1.0 - 1e-9));
    ASSERT_LE(figures.force_before_joc, figures.force_after_joc);
    const double loop = figures.loop_energy.si;
    ASSERT_GT(loop, 0.0);
    ASSERT_GE(figures.lost_at_jtc.si, -1e-9 * loop);
    ASSERT_GE(figures.lost_at_joc.si, -1e-9 * loop);
    ASSERT_NEAR((figures.lost_at_jtc + figures.lost_at_joc).si, loop, 1e-12 * loop);
    ASSERT_GE(figures.critical_stiffness, tables.contact.spring_constant * (1.0 - 1e-9));
  });
}

// A stroke of a hand with a tremble, down and up through both jumps, sampled this often in a second.
void expect_jumps_of_figures(const std::shared_ptr<const LawTables>& tables, int rate_hz) {
  const CycleFigures& figures = tables->figures;
  const double span = 1.5 * std::max((figures.z_joc - figures.z_jtc).si, 1e-9);
  const double middle = 0.5 * (figures.z_joc + figures.z_jtc).si;
  ApproachRetractModel model(tables);
  std::vector<ModelEvent> events;
  for (int i = 0; i <= rate_hz; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / rate_hz;
    const TipResponse response = model.step(Length(middle + span * (std::cos(turn) + 0.05 * std::sin(9.0 * turn))));
    events.insert(events.end(), response.events.begin(), response.events.begin() + response.event_count);
  }
  ASSERT_EQ(events.size(), figures.hysteretic ? 2U : 0U) << rate_hz;
  if (events.empty()) return;
  ASSERT_EQ(events[0].kind, EventKind::JumpToContact);
  ASSERT_EQ(events[0].z, figures.z_jtc);
  ASSERT_EQ(events[0].force_before, figures.force_before_jtc);
  ASSERT_EQ(events[0].force_after, figures.force_after_jtc);
  ASSERT_EQ(events[1].kind, EventKind::JumpOffContact);
  ASSERT_EQ(events[1].z, figures.z_joc);
  ASSERT_EQ(events[1].force_before, figures.force_before_joc);
  ASSERT_EQ(events[1].force_after, figures.force_after_joc);
}

// Whatever the way, a branch that is not left gives back at a place the force that it had there: no net work.
void expect_retraced_branches(const std::shared_ptr<const LawTables>& tables, RandomInteraction& random) {
  const CycleFigures& figures = tables->figures;
  ApproachRetractModel model(tables);
  model.step(figures.z_joc + Length(1e-9));
  const Length above = figures.z_jtc + Length(1e-12), below = figures.z_joc - Length(1e-12);
  const TipResponse free = model.step(above);
  ASSERT_EQ(free.phase, Phase::Free);
  for (int i = 0; i < 10; ++i) model.step(above + Length(random.between(1e-12, 1e-6)));
  ASSERT_EQ(model.step(above).force, free.force);
  ASSERT_EQ(model.phase(), Phase::Free);

  model.step(figures.z_jtc - Length(1e-9));
  const TipResponse attached = model.step(below);
  ASSERT_EQ(attached.phase, Phase::Attached);
  for (int i = 0; i < 10; ++i) model.step(below - Length(random.between(1e-12, 1e-6)));
  ASSERT_EQ(model.step(below).force, attached.force);
  ASSERT_EQ(model.phase(), Phase::Attached);
}

void expect_nothing_until_lifted(const std::shared_ptr<const LawTables>& tables) {
  const Length z_joc = tables->figures.z_joc;
  ApproachRetractModel model(tables);
  for (const double below : {0.0, 1e-9, 5e-9, 1e-12, 1e-6}) {
    const TipResponse response = model.step(z_joc - Length(below));
    ASSERT_EQ(response.force, Force());
    ASSERT_EQ(response.phase, Phase::WaitForLift);
  }
  ASSERT_EQ(model.step(z_joc + Length(1e-9)).phase, Phase::Free);
}

TEST_P(LawOfAnyMaterial, IsLatchedByItsFiguresAlone) {
  RandomInteraction wiggle(5);
  for_each_material(103, [&](const LawTables& tables) {
    const auto shared = std::make_shared<const LawTables>(tables);
    for (const int rate_hz : {500, 8000}) expect_jumps_of_figures(shared, rate_hz);
    expect_retraced_branches(shared, wiggle);
    expect_nothing_until_lifted(shared);
  });
}

INSTANTIATE_TEST_SUITE_P(Laws, LawOfAnyMaterial, testing::ValuesIn(laws_with(&LawTraits::computed)),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(LawLimits, HaoFoldsAsTheCubeRootOfHamakerTimesRadiusByStiffness) {
  RandomInteraction random(201);
  for (int i = 0; i < 500; ++i) {
    ContactParameters contact = random();
    contact.mean_surface_energy = SurfaceEnergy(50.0);
    const double before = build_law_tables(Law::Hao, contact)->figures.z_jtc.si;
    const double a = random.between(0.1, 10.0), r = random.between(0.5, 2.0), k = random.between(0.1, 10.0);
    contact.hamaker = a * contact.hamaker;
    contact.tip_radius = r * contact.tip_radius;
    contact.spring_constant = k * contact.spring_constant;
    ASSERT_NEAR(build_law_tables(Law::Hao, contact)->figures.z_jtc.si / before, std::cbrt(a * r / k), 1e-9) << i;
  }
}

// A soft lever gives the tip its load, a stiff one its height.
TEST(LawLimits, OfTheLeverAreLoadControlAndFixedGrips) {
  RandomInteraction random(202);
  for (int i = 0; i < 500; ++i) {
    ContactParameters contact = random();
    const AdhesiveContact adhesive = adhesive_contact(contact);
    const double unit = std::numbers::pi * adhesive.work_of_adhesion.si * adhesive.tip_radius.si;
    contact.spring_constant = Stiffness(1e-6);
    ASSERT_NEAR(build_law_tables(Law::Jkr, contact)->figures.force_before_joc.si / unit, -1.5, 1e-6) << i;
    const double lambda = maugis_lambda(adhesive, cohesive_stress(adhesive.work_of_adhesion, contact.atomic_distance));
    const double held = maugis_point(lambda, maugis_pull_off(lambda)).load;
    ASSERT_NEAR(build_law_tables(Law::MaugisDugdale, contact)->figures.force_before_joc.si / unit, held, 1e-4) << i;

    contact.spring_constant = Stiffness(std::numeric_limits<double>::infinity());
    ASSERT_NEAR(build_law_tables(Law::Jkr, contact)->figures.force_before_joc.si / unit, -5.0 / 6.0, 1e-9) << i;
    const CycleFigures grips = build_law_tables(Law::Jkr, contact)->figures;
    const double coefficient = grips.loop_energy.si / std::cbrt(std::pow(adhesive.work_of_adhesion.si, 5.0) *
                                                                std::pow(adhesive.tip_radius.si, 4.0) /
                                                                std::pow(adhesive.reduced_modulus.si, 2.0));
    ASSERT_NEAR(coefficient, 7.09219597186, 1e-9) << i;
  }
}

TEST(LawLimits, ThePapersLawIsAStraightLineExactly) {
  RandomInteraction random(203);
  int looked_at = 0;
  for (int i = 0; i < 10'000; ++i) {
    ContactParameters contact = random();
    contact.sample_stiffness = Stiffness(random.between(0.01, 1e4));
    const auto tables = tables_of(Law::Paper, contact);
    if (tables == nullptr) continue;
    const double z = random.between(1e-12, 1e-3), slope = -effective_stiffness(contact).si;
    ASSERT_NEAR(tables->attached.force(Length(z)).si, slope * z, 1e-12 * std::abs(slope * z));
    ASSERT_NEAR(tables->attached.force(Length(-z)).si, -slope * z, 1e-12 * std::abs(slope * z));
    ASSERT_EQ(tables->free.force(Length(z)), Force());
    ++looked_at;
  }
  EXPECT_GT(looked_at, 5'000);
}

}  // namespace laws_property_test
}  // namespace afm::physics
