// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "case_table.h"
#include "physics/contact.h"
#include "physics/direction_rule.h"
#include "physics/force_model.h"

namespace afm::physics {
namespace {

// The closed forms of the paper and of Hao; the other rows go through the tables.
std::vector<Case> closed_form_cases() {
  std::vector<Case> cases = cases_of(CaseProgram::Cycle);
  std::erase_if(cases, [](const Case& row) { return !row.id.starts_with("paper_") && !row.id.starts_with("hao_"); });
  return cases;
}

Interaction interaction_of(const Case& row) {
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
  const Interaction interaction = interaction_of(row);
  if (row.output == "f_sequence_nN") return expect_forces(ApproachRetractModel(interaction), row);
  if (row.output == "f_sequence_nN_WRONG") return expect_forces(DirectionRuleModel(interaction), row);
  expect_agrees(row, value_of(row.output, approach_retract_events(interaction)));
}

INSTANTIATE_TEST_SUITE_P(Research, PaperCase, testing::ValuesIn(closed_form_cases()),
                         [](const auto& test) { return test.param.name; });

// A row that nobody instantiates is a row that nobody checks: each program asserts how many it takes.
TEST(PhysicsCases, EveryRowBelongsToATestProgram) {
  EXPECT_EQ(read_cases().size(), 227U);
  EXPECT_EQ(cases_of(CaseProgram::Cycle).size(), 132U);
  EXPECT_EQ(cases_of(CaseProgram::Contact).size(), 56U);
  EXPECT_EQ(cases_of(CaseProgram::Lever).size(), 39U);
}

}  // namespace
}  // namespace afm::physics
