// SPDX-License-Identifier: Apache-2.0
// Invariant: each of the 272 physics reference cases is a test with the same name
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "case_table.h"
#include "physics/contact.h"
#include "physics/direction_rule.h"
#include "physics/force_model.h"
#include "physics/jkr.h"
#include "physics/jkr_pull_off.h"
#include "physics/law_tables.h"

namespace afm::physics {
namespace cycle_cases_test {

// The closed forms of the paper and of Hao; the other rows go through the tables.
std::vector<Case> closed_form_cases() {
  std::vector<Case> cases = cases_of(CaseProgram::Cycle);
  std::erase_if(cases, [](const Case& row) { return !row.id.starts_with("paper_") && !row.id.starts_with("hao_"); });
  return cases;
}

ContactParameters interaction_of(const Case& row) {
  // rows about the fold say nothing about adhesion, and those about the direction rule nothing but their path: mica
  return {Length(row.input_or("R", 50e-9)), Stiffness(row.input_or("kc", 0.1)), Stiffness(row.input_or("ks", HUGE_VAL)),
          Energy(row.input_or("A", 2.45e-20)), SurfaceEnergy(row.input_or("sqrt_gamma", 0.002228))};
}

template <class Model>
void expect_forces(Model model, const Case& row) {
  const auto path_nm = numbers(row.inputs.at("Z_nm"));
  const auto expected_nn = numbers(row.expected);
  ASSERT_EQ(path_nm.size(), 27U);
  ASSERT_EQ(expected_nn.size(), path_nm.size());
  for (std::size_t i = 0; i < path_nm.size(); ++i) {
    const TipResponse response = model.step(Length(path_nm[i] * 1e-9));
    EXPECT_NEAR(response.force.si * 1e9, expected_nn[i], 1e-9) << "step " << i << " at " << path_nm[i] << " nm";
  }
}

double value_of(const std::string& output, const ApproachRetractEvents& events) {
  const std::map<std::string, double> values{{"d_attr", events.d_attr.si},
                                             {"d_jtc", events.d_attr.si},
                                             {"delta_c_attr", events.delta_c_attr.si},
                                             {"delta_c", events.delta_c_attr.si},
                                             {"delta_s", events.delta_s_attr.si},
                                             {"z_jtc", events.z_jtc.si},
                                             {"z_jtc_printed", events.z_jtc.si},
                                             {"f_before_jump", -events.f_fold.si},
                                             {"f_attr", events.f_attr.si},
                                             {"f_attr_printed", events.f_attr.si},
                                             {"f_ad", events.f_ad.si},
                                             {"f_ad_printed", events.f_ad.si},
                                             {"z_joc", events.z_joc.si},
                                             {"z_joc_printed", events.z_joc.si},
                                             {"loop_energy", events.loop_energy.si}};
  return values.at(output);
}

class PaperCase : public testing::TestWithParam<Case> {};

TEST_P(PaperCase, Agrees) {
  const Case& row = GetParam();
  const ContactParameters contact = interaction_of(row);
  if (row.output == "f_sequence_nN") return expect_forces(ApproachRetractModel(contact), row);
  if (row.output == "f_sequence_nN_WRONG") return expect_forces(DirectionRuleModel(contact), row);
  expect_agrees(row, value_of(row.output, approach_retract_events(contact)));
}

INSTANTIATE_TEST_SUITE_P(Research, PaperCase, testing::ValuesIn(closed_form_cases()),
                         [](const auto& test) { return test.param.name; });

// The rows of laws that go through tables.
std::vector<Case> table_cases() {
  std::vector<Case> cases = cases_of(CaseProgram::Cycle);
  std::erase_if(cases, [](const Case& row) { return row.id.starts_with("paper_") || row.id.starts_with("hao_"); });
  return cases;
}

struct Question {
  Law law;
  ContactParameters contact;
  LawOptions options;
};

Stiffness lever_of(const Case& row) {
  // no lever has kc = 0: with the softest that is legal the load is given to 1e-15
  return Stiffness(std::max(1e-6, row.input_or("kc", 0.1)));
}

Question dmt_question(const Case& row) {
  // the row gives a0, which is A R/(6 F_ad)
  const double pull_off = row.input("A") * row.input("R") / (6.0 * row.input("a0") * row.input("a0"));
  ContactParameters contact{Length(row.input("R")), lever_of(row), Stiffness(HUGE_VAL), Energy(row.input("A")),
                            SurfaceEnergy(pull_off / (4.0 * std::numbers::pi * row.input("R")))};
  contact.reduced_modulus = Pressure(row.input_or("E_star", 5.15e10));
  return {Law::Dmt, contact, {}};
}

Question jkr_question(const Case& row) {
  ContactParameters contact{Length(row.input("R")), lever_of(row), Stiffness(HUGE_VAL), Energy(1e-20),
                            SurfaceEnergy(row.input("W") / 2.0)};
  contact.reduced_modulus = Pressure(row.input("E_star"));
  return {Law::Jkr, contact, {}};
}

Question maugis_question(const Case& row) {
  // lambda and the lever are given in Maugis' units: any contact that has them will do
  const double radius = 50e-9, work = 0.05, modulus = 1e9;
  const double k = 4.0 * modulus / 3.0;
  const double peak = row.input("lambda") / 2.0 / std::cbrt(radius / (std::numbers::pi * work * k * k));
  const double unit_load = std::numbers::pi * work * radius;
  const double unit_length = std::cbrt(std::pow(std::numbers::pi * work / k, 2.0) * radius);
  ContactParameters contact{Length(radius), Stiffness(row.input("kappa") * unit_load / unit_length),
                            Stiffness(HUGE_VAL), Energy(1e-20), SurfaceEnergy(work / 2.0)};
  contact.reduced_modulus = Pressure(modulus);
  contact.atomic_distance = Length(16.0 * work / (9.0 * std::sqrt(3.0) * peak));
  return {Law::MaugisDugdale, contact, {}};
}

Question question_of(const Case& row) {
  if (row.id.starts_with("dmt_")) return dmt_question(row);
  if (row.id.starts_with("jkr_")) return jkr_question(row);
  if (row.id.starts_with("md_")) return maugis_question(row);
  if (row.id.starts_with("lj_")) {
    ContactParameters contact{Length(row.input("R")), lever_of(row), Stiffness(HUGE_VAL), Energy(1e-20),
                              SurfaceEnergy(row.input("W") / 2.0)};
    contact.atomic_distance = Length(row.input("z0"));
    return {Law::LennardJones, contact, {}};
  }
  LawOptions exact;
  exact.exact_hamaker_sphere = true;
  return {Law::Hao, interaction_of(row), exact};
}

// Place at which the attached branch has zero force.
double zero_of(const BranchTable& attached, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (attached.force(Length(middle)) > Force() ? low : high) = middle;
  }
  return low;
}

// The contact radius that goes with a load and an indentation at rest: P = E*(2 a delta - 2 a^3/(3R)).
double contact_radius(const ContactParameters& contact, Force load, Length indentation) {
  const AdhesiveContact adhesive = adhesive_contact(contact);
  double low = 0.5 * jkr_fixed_grips_radius(adhesive).si, high = 2.0 * jkr_pull_off_radius(adhesive).si;
  const auto excess = [&](double a) {
    return 2.0 * a * indentation.si - 2.0 * a * a * a / (3.0 * adhesive.tip_radius.si) -
           load.si / adhesive.reduced_modulus.si;
  };
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

double value_of(const Case& row, const LawTables& tables) {
  const CycleFigures& figures = tables.figures;
  const ContactParameters& contact = tables.contact;
  const double unit_load = std::numbers::pi * work_of_adhesion(contact).si * contact.tip_radius.si;
  if (row.output == "z_of_zero_force_on_contact_branch") return zero_of(tables.attached, 0.0, figures.z_joc.si);
  if (row.output == "contact_radius_at_pull_off") {
    // under load control the table's softest lever is still 1e-8 short
    if (row.input("kc") == 0.0) return jkr_pull_off_radius(adhesive_contact(contact)).si;
    return contact_radius(contact, figures.force_before_joc, -figures.tip_height_before_joc);
  }
  if (row.output == "loop_energy_coefficient") {
    const double w = work_of_adhesion(contact).si, r = contact.tip_radius.si;
    return figures.loop_energy.si /
           std::cbrt(std::pow(w, 5.0) * std::pow(r, 4.0) / std::pow(contact.reduced_modulus.si, 2.0));
  }
  const std::map<std::string, double> values{{"z_in", figures.z_jtc.si},
                                             {"z_jtc", figures.z_jtc.si},
                                             {"d_jtc", figures.tip_height_before_jtc.si},
                                             {"tip_z_before_snap_in", figures.tip_height_before_jtc.si},
                                             {"f_before_snap_in", figures.force_before_jtc.si},
                                             {"tip_z_after_snap_in", figures.tip_height_after_jtc.si},
                                             {"f_after_snap_in", figures.force_after_jtc.si},
                                             {"z_out", figures.z_joc.si},
                                             {"f_pull_off", figures.force_before_joc.si},
                                             {"p_pull_off", figures.force_before_joc.si / unit_load},
                                             {"tip_z_before_pull_off", figures.tip_height_before_joc.si},
                                             {"indentation_at_pull_off", -figures.tip_height_before_joc.si},
                                             {"tip_z_after_pull_off", figures.tip_height_after_joc.si},
                                             {"f_after_pull_off", figures.force_after_joc.si},
                                             {"energy_lost_at_snap_in", figures.lost_at_jtc.si},
                                             {"energy_lost_at_pull_off", figures.lost_at_joc.si},
                                             {"loop_energy", figures.loop_energy.si},
                                             {"k_critical", figures.critical_stiffness.si}};
  return values.at(row.output);
}

class TableCase : public testing::TestWithParam<Case> {};

TEST_P(TableCase, Agrees) {
  const Case& row = GetParam();
  const auto [law, contact, options] = question_of(row);
  expect_agrees(row, value_of(row, *build_law_tables(law, contact, options)));
}

INSTANTIATE_TEST_SUITE_P(Research, TableCase, testing::ValuesIn(table_cases()),
                         [](const auto& test) { return test.param.name; });

// A row that no program instantiates is never checked, so each program asserts its number of rows.
TEST(PhysicsCases, EveryRowBelongsToATestProgram) {
  EXPECT_EQ(read_cases().size(), 272U);
  EXPECT_EQ(cases_of(CaseProgram::Cycle).size(), 132U);
  EXPECT_EQ(cases_of(CaseProgram::Contact).size(), 56U);
  EXPECT_EQ(cases_of(CaseProgram::Lever).size(), 39U);
  EXPECT_EQ(cases_of(CaseProgram::Friction).size(), 45U);
}

}  // namespace cycle_cases_test
}  // namespace afm::physics
