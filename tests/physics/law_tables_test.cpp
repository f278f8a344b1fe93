// SPDX-License-Identifier: Apache-2.0
#include "physics/law_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "curve_laws.h"
#include "physics/contact.h"
#include "physics/force_laws.h"

namespace afm::physics {
namespace law_tables_test {

using namespace literals;
using testing::HasSubstr;

const Stiffness kRigid(std::numeric_limits<double>::infinity());

ContactParameters contact(Stiffness lever, Stiffness support, Energy hamaker, SurfaceEnergy mean_surface_energy,
                          Pressure modulus) {
  return {50_nm, lever, support, hamaker, mean_surface_energy, modulus, 0.3_nm};
}

// Mica of the paper, mica on a soft support, polystyrene, a gel: from rigid to JKR.
const std::vector<ContactParameters> kContacts{
    contact(0.1_N_per_m, kRigid, 24.5_zJ, 2.228_mJ_per_m2, 51.5_GPa),
    contact(0.1_N_per_m, 0.2_N_per_m, 24.5_zJ, 2.228_mJ_per_m2, 51.5_GPa),
    contact(2_N_per_m, kRigid, 109_zJ, 53_mJ_per_m2, 3.6_GPa),
    contact(40_N_per_m, kRigid, 109_zJ, 53_mJ_per_m2, 3.6_GPa),
    contact(0.05_N_per_m, kRigid, 40_zJ, 20_mJ_per_m2, 0.001_GPa),
};

double compliance(const ContactParameters& contact) {
  return 1.0 / contact.spring_constant.si + 1.0 / contact.sample_stiffness.si;
}

// A branch bent by lever and support, looked up without any table: its stable stretch by walking, Z by halving.
class ExactBranch {
 public:
  ExactBranch(const LawBranch& branch, double compliance, double sign)
      : branch_(branch), compliance_(compliance), sign_(sign), end_(branch.last) {
    constexpr int kSteps = 20'000;
    for (int i = 1; i <= kSteps; ++i) {
      double low = branch.first + (branch.last - branch.first) * (i - 1) / kSteps;
      double high = branch.first + (branch.last - branch.first) * i / kSteps;
      if (is_stable(high)) continue;
      for (int k = 0; k < 100; ++k) (is_stable(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
      end_ = low;
      return;
    }
  }

  double z(double s) const { return branch_.at(s).h.si - compliance_ * branch_.at(s).force.si; }

  bool reaches(double z_wanted) const {
    return sign_ * (z_wanted - z(branch_.first)) > 0.0 && sign_ * (z(end_) - z_wanted) >= 0.0;
  }

  double force(double z_wanted) const {
    double low = branch_.first, high = end_;
    for (int k = 0; k < 200; ++k) {
      const double middle = 0.5 * (low + high);
      (sign_ * (z(middle) - z_wanted) < 0.0 ? low : high) = middle;
    }
    return branch_.at(high).force.si;
  }

 private:
  bool is_stable(double s) const {
    const LawPoint point = branch_.at(s);
    return sign_ * (point.dh_ds - compliance_ * point.dforce_ds) >= 0.0;
  }

  const LawBranch& branch_;
  double compliance_;
  double sign_;
  double end_;
};

class EveryLaw : public testing::TestWithParam<std::tuple<Law, std::size_t>> {
 protected:
  const Law law_ = std::get<0>(GetParam());
  const ContactParameters interaction_ = kContacts[std::get<1>(GetParam())];
  const std::shared_ptr<const LawTables> tables_ = build_law_tables(law_, interaction_);
  const CycleFigures& figures_ = tables_->figures;
  // scale for errors of the law's forces
  const double scale_ = std::max(1e-11, std::abs(figures_.force_before_joc.si));
};

TEST_P(EveryLaw, IsTabulatedToTenToTheMinusEight) {
  const ForceLaw law = force_law(law_, interaction_);
  const ExactBranch free(law.free, compliance(interaction_), -1.0);
  const ExactBranch attached(law.attached, compliance(interaction_), 1.0);
  int looked_at = 0;
  for (double distance = 1e-15; distance < 4e-6; distance *= 1.07) {
    const double above = figures_.z_jtc.si + distance, below = figures_.z_joc.si - distance;
    if (free.reaches(above)) {
      const double exact = free.force(above);
      ASSERT_NEAR(tables_->free.force(Length(above)).si, exact, 1e-8 * std::max(scale_, std::abs(exact))) << distance;
      ++looked_at;
    }
    if (attached.reaches(below)) {
      const double exact = attached.force(below);
      ASSERT_NEAR(tables_->attached.force(Length(below)).si, exact, 1e-8 * std::max(scale_, std::abs(exact)))
          << distance;
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 600);
}

TEST_P(EveryLaw, PullsLessTheFartherAFreeTipIs) {
  Force last = tables_->free.force(figures_.z_jtc);
  for (double distance = 1e-13; distance < 1.0; distance *= 1.02) {
    const Force force = tables_->free.force(figures_.z_jtc + Length(distance));
    ASSERT_GE(force, last) << distance;
    ASSERT_LE(force, 0_nN);
    last = force;
  }
}

// The force itself need not fall all the way: a smooth law (JKR, Lennard-Jones) passes its strongest pull before a
// lever lets go. But a tip that rests goes where it is taken.
TEST_P(EveryLaw, SinksDeeperTheDeeperAnAttachedTipIsTaken) {
  const double c = compliance(interaction_);
  double last = figures_.z_joc.si + c * figures_.force_before_joc.si;
  Force deepest;
  for (double distance = 1e-13; distance < 1e-3; distance *= 1.02) {
    const Length z = figures_.z_joc - Length(distance);
    deepest = tables_->attached.force(z);
    const double height = z.si + c * deepest.si;
    ASSERT_LE(height, last + 1e-9 * c * std::max(scale_, std::abs(deepest.si))) << distance;
    last = height;
  }
  EXPECT_GT(deepest, 0_nN);
}

TEST_P(EveryLaw, HasFiguresOnItsTables) {
  const auto near = [this](Force actual, Force expected) { EXPECT_NEAR(actual.si, expected.si, 1e-8 * scale_); };
  near(tables_->free.force(figures_.z_jtc), figures_.force_before_jtc);
  near(tables_->attached.force(figures_.z_jtc), figures_.force_after_jtc);
  near(tables_->attached.force(figures_.z_joc), figures_.force_before_joc);
  near(tables_->free.force(figures_.z_joc), figures_.force_after_joc);
}

TEST_P(EveryLaw, LosesInTheLoopWhatItsJumpsDropAndItsAreaHolds) {
  if (!figures_.hysteretic) {
    EXPECT_EQ(figures_.loop_energy.si, 0.0);
    EXPECT_EQ(figures_.z_jtc, figures_.z_joc);
    return;
  }
  EXPECT_LT(figures_.z_jtc, figures_.z_joc);
  EXPECT_GE(figures_.lost_at_jtc.si, 0.0);
  EXPECT_GE(figures_.lost_at_joc.si, 0.0);
  EXPECT_NEAR((figures_.lost_at_jtc + figures_.lost_at_joc) / figures_.loop_energy, 1.0, 1e-12);

  // Simpson over t, Z = z_jtc + width (3 t^2 - 2 t^3), which takes the square roots out of both ends
  const double width = (figures_.z_joc - figures_.z_jtc).si;
  constexpr int kSteps = 20'000;
  double sum = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const Length z = figures_.z_jtc + Length(width * t * t * (3.0 - 2.0 * t));
    const double weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * (tables_->free.force(z) - tables_->attached.force(z)).si * 6.0 * t * (1.0 - t) * width;
  }
  EXPECT_NEAR(sum / 3.0 / kSteps / figures_.loop_energy.si, 1.0, 2e-9);
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<Law, std::size_t>>& test) {
  return std::string(name_of(std::get<0>(test.param))) + "_" + std::to_string(std::get<1>(test.param));
}
INSTANTIATE_TEST_SUITE_P(LawTables, EveryLaw,
                         testing::Combine(testing::ValuesIn(curve_laws()), testing::Range<std::size_t>(0, 5)),
                         name_of_case);

TEST(LawTables, OfThePaperAreTheClosedForms) {
  const auto tables = build_law_tables(Law::Paper, kContacts[1]);
  const ApproachRetractEvents events = approach_retract_events(kContacts[1]);
  for (const double z : {-1e-6, -3e-9, 0.0, 1e-9, 20e-9}) {
    EXPECT_EQ(tables->free.force(Length(z)), 0_nN);
    EXPECT_NEAR(tables->attached.force(Length(z)).si, -events.effective_stiffness.si * z, 1e-12 * std::abs(z) * 0.1);
  }
  EXPECT_EQ(tables->figures.z_jtc, events.z_jtc);
  EXPECT_EQ(tables->figures.z_joc, events.z_joc);
  EXPECT_EQ(tables->figures.loop_energy, events.loop_energy);
}

TEST(LawTables, OfHaoFoldWhereThePaperSaysWhateverTheSupport) {
  for (const std::size_t i : {0U, 1U}) {
    const auto tables = build_law_tables(Law::Hao, kContacts[i]);
    const ApproachRetractEvents events = approach_retract_events(kContacts[i]);
    EXPECT_NEAR(tables->figures.z_jtc / events.z_jtc, 1.0, 1e-13);
    EXPECT_NEAR(tables->figures.force_before_jtc / events.f_fold, -1.0, 1e-7);
    EXPECT_NEAR(tables->figures.z_joc / events.z_joc, 1.0, 1e-13);
  }
}

TEST(LawTables, CloseTheLoopAtTheCriticalStiffnessAndNotBelow) {
  for (const Law law : {Law::Dmt, Law::LennardJones}) {
    ContactParameters contact = kContacts[0];
    const Stiffness critical = build_law_tables(law, contact)->figures.critical_stiffness;
    contact.spring_constant = 1.0001 * critical;
    EXPECT_FALSE(build_law_tables(law, contact)->figures.hysteretic);
    contact.spring_constant = 0.9999 * critical;
    const CycleFigures below = build_law_tables(law, contact)->figures;
    EXPECT_TRUE(below.hysteretic);
    EXPECT_GT(below.loop_energy, Energy());
    EXPECT_LT(below.z_joc - below.z_jtc, Length(1e-12));

    // a support adds its compliance, and one softer than the law's steepest attraction keeps the loop open indefinitely
    contact.sample_stiffness = 2.0 * critical;
    EXPECT_NEAR(build_law_tables(law, contact)->figures.critical_stiffness / critical, 2.0, 1e-6);
    contact.sample_stiffness = 0.5 * critical;
    EXPECT_TRUE(std::isinf(build_law_tables(law, contact)->figures.critical_stiffness.si));
  }
}

// A lever so soft that it lets go 1.4 mm above the sample, where the law has no points any more.
TEST(LawTables, LetTheForceFallOnBeyondTheLaw) {
  for (const Law law : {Law::Hao, Law::Dmt}) {
    ContactParameters soft = kContacts[0];
    soft.spring_constant = Stiffness(1e-6);
    const CycleFigures figures = build_law_tables(law, soft)->figures;
    ASSERT_GT(figures.z_joc, Length(1.1e-3));
    const Force attraction = soft.hamaker * soft.tip_radius / (6.0 * figures.z_joc * figures.z_joc);
    EXPECT_NEAR(figures.force_after_joc / attraction, -1.0, 1e-4);
  }
}

TEST(LawTables, TakeFixedGripsForAnInfiniteSpringConstant) {
  ContactParameters grips = kContacts[2];
  grips.spring_constant = kRigid;
  const auto jkr = build_law_tables(Law::Jkr, grips);
  EXPECT_TRUE(jkr->figures.hysteretic);
  EXPECT_EQ(jkr->figures.tip_height_before_joc, jkr->figures.z_joc);
  const auto dmt = build_law_tables(Law::Dmt, grips);
  EXPECT_FALSE(dmt->figures.hysteretic);
  const Length gap = dmt->contact_gap + 1_nm;
  const Force attraction = grips.hamaker * grips.tip_radius / (6.0 * gap * gap);
  EXPECT_NEAR(dmt->free.force(gap) / attraction, -1.0, 1e-8);
  // such a lever is invalid everywhere else
  EXPECT_THROW(validate(grips), UnphysicalValue);
}

std::string refusal(Law law, const ContactParameters& contact) {
  try {
    build_law_tables(law, contact);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LawTables, RefuseWhatHasNoLaw) {
  ContactParameters grips = kContacts[0];
  grips.spring_constant = kRigid;
  EXPECT_THAT(refusal(Law::Hao, grips), HasSubstr("hao has a rigid contact"));
  ContactParameters weak = kContacts[0];
  weak.mean_surface_energy = 0.2_mJ_per_m2;
  EXPECT_THAT(refusal(Law::Hao, weak), HasSubstr("adhesion is too weak: jump-off-contact at"));
  ContactParameters slime = kContacts[4];
  slime.spring_constant = Stiffness(1e-5);
  slime.mean_surface_energy = SurfaceEnergy(20.0);
  slime.reduced_modulus = Pressure(10.0);
  EXPECT_THAT(refusal(Law::Dmt, slime), HasSubstr("the sample is too soft: a tip that jumps to contact at"));
  ContactParameters negative = kContacts[0];
  negative.tip_radius = -1_nm;
  EXPECT_THAT(refusal(Law::Dmt, negative), HasSubstr("tip radius"));
  EXPECT_THAT(refusal(Law::Measured, kContacts[0]), HasSubstr("measured"));
}

}  // namespace law_tables_test
}  // namespace afm::physics
