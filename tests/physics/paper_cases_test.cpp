// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "case_table.h"
#include "physics/contact.h"
#include "physics/direction_rule.h"
#include "physics/force_model.h"

namespace afm::physics {
namespace {

std::vector<Case> cases() { return read_cases(AFM_SOURCE_DIR "/tests/physics/data/paper_cases.csv"); }

Interaction interaction_of(const Case& row) {
  const auto number = [&](const char* name, double otherwise) {
    const auto input = row.inputs.find(name);
    return input == row.inputs.end() ? otherwise : std::stod(input->second);
  };
  // rows about the fold say nothing about adhesion, and those about the direction rule nothing but their path: mica
  return {Length(number("R", 50e-9)), Stiffness(number("kc", 0.1)), Stiffness(number("ks", HUGE_VAL)),
          Energy(number("A", 2.45e-20)), SurfaceEnergy(number("sqrt_gamma", 0.002228))};
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(text);
  for (double value; stream >> value;) values.push_back(value);
  return values;
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
  const double expected = std::stod(row.expected);
  EXPECT_NEAR(value_of(row.output, approach_retract_events(interaction)), expected,
              row.relative_tolerance * std::abs(expected));
}

INSTANTIATE_TEST_SUITE_P(Research, PaperCase, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.id + "_" + test.param.output; });

TEST(PaperCases, AreAllThere) { EXPECT_EQ(cases().size(), 45U); }

}  // namespace
}  // namespace afm::physics
