// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "physics/cantilever.h"
#include "physics/case_table.h"
#include "physics/contact_parameters.h"
#include "physics/elasticity.h"
#include "physics/friction/friction.h"
#include "physics/friction/lattice_tip.h"
#include "physics/friction/prandtl_tomlinson.h"

namespace afm::physics {
namespace friction_cases_test {

SineLattice lattice_of(const Case& row) {
  const double a = row.input("a"), k = row.input("k");
  const double amplitude = row.inputs.contains("E0")
                               ? row.input("E0")
                               : row.input("eta") * k * a * a / (2.0 * std::numbers::pi * std::numbers::pi);
  return {Length(a), Energy(amplitude), Stiffness(k)};
}

double row_of_atoms_value(const Case& row) {
  if (row.inputs.contains("F_max")) {
    const SineLattice found =
        lattice_of_loop(Length(row.input("a")), Force(row.input("F_max")), Stiffness(row.input("k_exp")));
    if (row.output == "loop_eta") return slip_parameter(found);
    if (row.output == "loop_spring") return found.spring.si;
    return found.amplitude.si;
  }
  const SineLattice lattice = lattice_of(row);
  if (row.output == "largest_force") return largest_lateral_force(lattice).si;
  if (row.output == "slope_at_rest") return slope_at_rest(lattice).si;
  if (row.output == "mean_friction") return mean_friction(lattice).si;
  if (row.inputs.contains("before")) {
    const SlipBarrier barrier = barrier_before_slip(lattice, Length(row.input("before")));
    if (row.output == "barrier_force") return barrier.force.si;
    return row.output == "barrier" ? barrier.height.si : barrier.height / thermal_energy(Temperature(row.input("T")));
  }
  const SineSlip slip = first_slip(lattice).value();
  if (row.output == "force_at_slip") return slip.force_before.si;
  if (row.output == "support_at_slip") return slip.support.si;
  if (row.output == "tip_after_slip") return slip.tip_after.si;
  if (row.output == "force_after_slip") return slip.force_after.si;
  if (row.output == "energy_lost") return slip.lost.si;
  throw std::invalid_argument("no value of a row of atoms " + row.name);
}

// The spring, by halving, at which a tip that is pulled along y = 0 begins to slip.
double stiffness_that_slips(const Case& row) {
  double low = 0.1, high = 1e3;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    const SineLattice along{Length(row.input("a")), Energy(4.0 * row.input("U")), Stiffness(middle)};
    (first_slip(along) ? low : high) = middle;
  }
  return low;
}

double hexagonal_value(const Case& row) {
  if (row.output == "stiffness_that_slips") return stiffness_that_slips(row);
  const LatticeLandscape landscape(LatticeKind::Hexagonal, Length(row.input("a")));
  const auto well = landscape.at(0.0, 0.0);
  EXPECT_NEAR(well.bend_xx, well.bend_yy, 1e-9 * well.bend_xx);
  EXPECT_NEAR(well.bend_xy, 0.0, 1e-9 * well.bend_xx);
  return row.input("U") * well.bend_xx;
}

double lever_value(const Case& row) {
  const double nu = row.input("nu");
  if (row.inputs.contains("k_n")) {
    return lateral_stiffness(Stiffness(row.input("k_n")), nu, Length(row.input("L")), Length(row.input("h"))).si;
  }
  const RectangularLever lever{Length(row.input("L")), Length(row.input("w")), Length(row.input("t")),
                               Pressure(row.input("E")), Density(3000.0)};
  const Stiffness normal = spring_constant(lever), lateral = lateral_stiffness(lever, nu, Length(row.input("h")));
  if (row.output == "normal_stiffness") return normal.si;
  return row.output == "lateral_stiffness" ? lateral.si : lateral / normal;
}

double area_value(const Case& row) {
  ContactParameters contact{Length(row.input("R")), Stiffness(0.1), Stiffness(HUGE_VAL), Energy(1e-20), {}};
  // F_ad = 4 pi R times the mean surface energy
  contact.mean_surface_energy = SurfaceEnergy(row.input("F_ad") / (4.0 * std::numbers::pi * row.input("R")));
  contact.reduced_modulus =
      reduced_modulus({Pressure(row.input("E_t")), row.input("nu_t")}, {Pressure(row.input("E_s")), row.input("nu_s")});
  const auto friction = [&](double force) {
    return row.input("tau") * contact_area(Law::Dmt, contact, Force(force)).si;
  };
  const double force = row.input("F");
  if (row.output == "area_friction") return friction(force);
  const double more = 1.001 * (force + row.input("F_ad")) - row.input("F_ad");
  return std::log(friction(more) / friction(force)) / std::log(1.001);
}

double hand_value(const Case& row) {
  if (row.output == "washboard_frequency") return row.input("v") / (row.input("scale") * row.input("a"));
  if (row.output == "hand_way") return row.input("scale") * row.input("a");
  if (row.output == "counts_per_step") return row.input("scale") * row.input("a") / row.input("count");
  const Energy lost = loop_energy(lattice_of(row), Length(row.input("stroke")));
  return row.output == "loop_energy" ? lost.si : 1e3 * lost.si * row.input("scale") * row.input("force_scale");
}

double value_of(const Case& row) {
  if (row.inputs.contains("tau")) return area_value(row);
  if (row.inputs.contains("nu")) return lever_value(row);
  if (row.inputs.contains("U")) return hexagonal_value(row);
  if (row.inputs.contains("scale")) return hand_value(row);
  return row_of_atoms_value(row);
}

class FrictionCase : public testing::TestWithParam<Case> {};

TEST_P(FrictionCase, Agrees) { expect_agrees(GetParam(), value_of(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Research, FrictionCase, testing::ValuesIn(cases_of(CaseProgram::Friction)),
                         [](const auto& test) { return test.param.name; });

}  // namespace friction_cases_test
}  // namespace afm::physics
