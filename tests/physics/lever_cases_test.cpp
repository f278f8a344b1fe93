// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "case_table.h"
#include "physics/beam_shape.h"
#include "physics/cantilever.h"
#include "physics/flexural_modes.h"
#include "physics/sader.h"
#include "physics/thermal_noise.h"

namespace afm::physics {
namespace {

double beam_value(const Case& row) {
  if (row.id == "beam_01") {
    const RectangularLever lever{Length(row.input("L")), Length(row.input("w")), Length(row.input("t")),
                                 Pressure(row.input("E")), Density(row.input("rho"))};
    if (row.output == "spring_constant") return spring_constant(lever).si;
    if (row.output == "f1_vacuum") return vacuum_resonance(lever).si;
    if (row.output == "f2_over_f1") return vacuum_resonance(lever, 2) / vacuum_resonance(lever);
    if (row.output == "m_eff_over_m") return effective_mass(lever) / mass(lever);
  }
  if (row.output == "shape") return beam_deflection(row.input("x_over_L"));
  if (row.output == "end_slope") return end_slope(Length(row.input("L")), Length(row.input("delta")));
  if (row.output == "spot_displacement") {
    return spot_displacement(Length(row.input("L")), Length(row.input("s")), Length(row.input("delta"))).si;
  }
  if (row.id == "beam_03") {
    const Fluid fluid{Density(row.input("rho")), Viscosity(row.input("eta"))};
    return sader_spring_constant(Length(row.input("L")), Length(row.input("b")), Frequency(row.input("f")),
                                 row.input("Q"), fluid)
        .si;
  }
  if (row.id == "beam_04") {
    const VShapedLever lever{Length(row.input("L")), Length(row.input("b")), Length(row.input("d")),
                             Length(row.input("t")), Pressure(row.input("E"))};
    return spring_constant(lever).si;
  }
  throw std::invalid_argument("no beam value " + row.name);
}

double thermal_value(const Case& row) {
  if (row.output == "mode_share") return thermal_share(static_cast<int>(row.input("mode")));
  if (row.output == "chi") return optical_lever_ratio();
  const Stiffness k(row.input("kc"));
  const Temperature temperature(row.input("T"));
  const double deflection = thermal_deflection(k, temperature).si;
  if (row.output == "rms_deflection") return deflection;
  if (row.output == "rms_force") return thermal_force(k, temperature).si;
  if (row.output == "rms_deflection_mode1") return deflection * std::sqrt(thermal_share(1));
  if (row.output == "rms_virtual_deflection_mode1") return deflection * std::sqrt(virtual_thermal_share(1));
  if (row.output == "rms_virtual_deflection_total") return deflection * std::sqrt(4.0 / 3.0);
  const LeverDynamics lever{Frequency(row.input("f0")), row.input("Q"), temperature};
  if (row.output == "force_noise_density") return std::sqrt(thermal_force_spectrum(k, lever).si);
  if (row.output == "rms_deflection_in_band") return thermal_deflection_below(Frequency(row.input("B")), k, lever).si;
  throw std::invalid_argument("no thermal value " + row.name);
}

std::vector<Case> closed_form_cases() {
  auto rows = cases_of(CaseProgram::Lever);
  std::erase_if(rows, [](const Case& row) {
    return row.id.starts_with("dyn") || row.id == "thermal_04" || row.id == "thermal_05";
  });
  return rows;
}

class LeverCase : public testing::TestWithParam<Case> {};

TEST_P(LeverCase, Agrees) {
  const Case& row = GetParam();
  expect_agrees(row, row.id.starts_with("beam") ? beam_value(row) : thermal_value(row));
}

INSTANTIATE_TEST_SUITE_P(Research, LeverCase, testing::ValuesIn(closed_form_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace afm::physics
