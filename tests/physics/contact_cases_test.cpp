// SPDX-License-Identifier: Apache-2.0
// The rows of data/physics_cases.csv about the laws of force by themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "case_table.h"
#include "physics/adhesion_map.h"
#include "physics/hertz.h"
#include "physics/jkr.h"
#include "physics/maugis_dugdale.h"
#include "physics/meniscus.h"
#include "physics/van_der_waals.h"

namespace afm::physics {
namespace contact_cases_test {

AdhesiveContact contact_of(const Case& row) {
  return {Length(row.input("R")), Pressure(row.input("E_star")), SurfaceEnergy(row.input("W"))};
}

ContactParameters interaction_of(const Case& row) {
  ContactParameters contact;
  contact.tip_radius = Length(row.input("R"));
  contact.mean_surface_energy = SurfaceEnergy(row.input("W") / 2.0);
  contact.reduced_modulus = Pressure(row.input("E_star"));
  contact.atomic_distance = Length(row.input("z0"));
  return contact;
}

double van_der_waals(const Case& row, bool exact) {
  LawOptions options;
  options.exact_hamaker_sphere = exact;
  return VanDerWaals(Energy(row.input("A")), Length(row.input("R")), options).force(Length(row.input("D"))).si;
}

MaugisPoint maugis_pull_off_point(double lambda) { return maugis_point(lambda, maugis_pull_off(lambda)); }
MaugisPoint maugis_loaded_point(double lambda, double load) {
  return maugis_point(lambda, maugis_at_load(lambda, load));
}

using Outputs = std::map<std::string, std::function<double(const Case&)>>;

Outputs van_der_waals_outputs() {
  return {{"f_exact", [](const Case& row) { return van_der_waals(row, true); }},
          {"f_derjaguin", [](const Case& row) { return van_der_waals(row, false); }}};
}

Outputs dmt_outputs() {
  const auto radius = [](const Case& row) { return dmt_contact_radius(contact_of(row), Force(row.input("load"))); };
  return {{"contact_radius", [=](const Case& row) { return radius(row).si; }},
          {"contact_stiffness", [=](const Case& row) { return hertz_stiffness(contact_of(row), radius(row)).si; }}};
}

Outputs jkr_outputs() {
  const auto radius = [](const Case& row) { return jkr_contact_radius(contact_of(row), Force(row.input("load"))); };
  return {{"contact_radius", [=](const Case& row) { return radius(row).si; }},
          {"indentation", [=](const Case& row) { return jkr_indentation(contact_of(row), radius(row)).si; }}};
}

Outputs maugis_outputs() {
  const auto lambda = [](const Case& row) { return row.input("lambda"); };
  return {
      {"p_pull_off", [=](const Case& row) { return maugis_pull_off_point(lambda(row)).load; }},
      {"a_pull_off", [=](const Case& row) { return maugis_pull_off_point(lambda(row)).contact_radius; }},
      {"a_zero_load", [=](const Case& row) { return maugis_loaded_point(lambda(row), 0.0).contact_radius; }},
      {"a", [=](const Case& row) { return maugis_loaded_point(lambda(row), row.input("P")).contact_radius; }},
      {"delta", [=](const Case& row) { return maugis_loaded_point(lambda(row), row.input("P")).indentation; }},
      {"tabor_mu", [](const Case& row) { return tabor_parameter(interaction_of(row)); }},
      {"maugis_lambda", [](const Case& row) { return maugis_parameter(interaction_of(row)); }},
      {"lambda_over_mu",
       [](const Case& row) { return maugis_parameter(interaction_of(row)) / tabor_parameter(interaction_of(row)); }},
      {"sigma0_LJ_peak",
       [](const Case& row) { return cohesive_stress(SurfaceEnergy(row.input("W")), Length(row.input("z0"))).si; }},
      {"f_pull_off",
       [](const Case& row) {
         return maugis_pull_off_point(maugis_parameter(interaction_of(row))).load *
                maugis_units(contact_of(row)).load.si;
       }},
      {"contact_radius_zero_load", [](const Case& row) {
         return maugis_loaded_point(maugis_parameter(interaction_of(row)), 0.0).contact_radius *
                maugis_units(contact_of(row)).radius.si;
       }}};
}

Outputs capillary_outputs() {
  return {{"f_capillary", [](const Case& row) {
             const Meniscus meniscus{.surface_tension = SurfaceEnergy(row.input("gamma")),
                                     .contact_angle_rad = row.input("theta")};
             return capillary_force(meniscus, Length(row.input("R"))).si;
           }}};
}

class ContactCase : public testing::TestWithParam<Case> {};

TEST_P(ContactCase, Agrees) {
  const Case& row = GetParam();
  const std::map<std::string, Outputs> families{{"vdw", van_der_waals_outputs()},
                                                {"dmt", dmt_outputs()},
                                                {"jkr", jkr_outputs()},
                                                {"md", maugis_outputs()},
                                                {"cap", capillary_outputs()}};
  const std::string family = row.id.substr(0, row.id.find('_'));
  expect_agrees(row, families.at(family).at(row.output)(row));
}

INSTANTIATE_TEST_SUITE_P(Research, ContactCase, testing::ValuesIn(cases_of(CaseProgram::Contact)),
                         [](const auto& test) { return test.param.name; });

}  // namespace contact_cases_test
}  // namespace afm::physics
