// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "case_table.h"
#include "mica.h"
#include "physics/beam_shape.h"
#include "physics/cantilever.h"
#include "physics/flexural_modes.h"
#include "physics/sader.h"
#include "physics/thermal_noise.h"
#include "physics/tip_oscillator.h"

namespace afm::physics {
namespace lever_cases_test {

using namespace literals;

Mass mass(const RectangularLever& lever) { return lever.density * lever.length * lever.width * lever.thickness; }

// Mass of a point on the lever's spring that resonates at the lever's first frequency.
Mass effective_mass(const RectangularLever& lever) {
  const Frequency angular = 2.0 * std::numbers::pi * vacuum_resonance(lever);
  return spring_constant(lever) / (angular * angular);
}

// dw/dx at the end: the tangent of the angle of the end and the tip.
double end_slope(Length lever_length, Length end_deflection) {
  return beam_slope(1.0) * (end_deflection / lever_length);
}

// Displacement of the reflected spot of an optical lever on a detector: a mirror rotates a ray by twice its own angle.
Length spot_displacement(Length lever_length, Length detector_distance, Length end_deflection) {
  return 2.0 * end_slope(lever_length, end_deflection) * detector_distance;
}

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
  if (row.output == "chi") return optical_lever_ratio(1);
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

// vdW-DMT under fixed grips, or no force at all where the row knows none.
std::shared_ptr<const TipForce> surface_of(const Case& row) {
  ContactParameters contact = elastic_mica();
  Law law = Law::Hertz;
  if (row.inputs.contains("A")) {
    law = Law::Dmt;
    contact.hamaker = Energy(row.input("A"));
    contact.tip_radius = Length(row.input("R"));
    // the rows without their own contact end before it; mica's is used
    const double a0 = row.input_or("a0", 3.818813079e-10);
    contact.mean_surface_energy =
        SurfaceEnergy(row.input("A") / (24.0 * std::numbers::pi * a0 * a0));  // F_ad = A R/(6 a0^2) = 4 pi R gamma
    contact.reduced_modulus = Pressure(row.input_or("E_star", 5.15e10));
  }
  return std::make_shared<const TipForce>(*fixed_grips(law, contact), 14_nN);
}

LeverDynamics lever_of(const Case& row) {
  if (!row.inputs.contains("gamma")) {
    return {Frequency(row.input("f0")), row.input("Q"), Temperature(row.input_or("T", 0.0))};
  }
  // no mass: Q so low that the velocity decays 400 times as fast as the lever moves, at the same k/(w0 Q)
  constexpr double kQuality = 0.05;
  const double w0 = row.input("kc") / (kQuality * row.input("gamma"));
  return {Frequency(w0 / (2.0 * std::numbers::pi)), kQuality, Temperature()};
}

TipOscillator oscillator_of(const Case& row, const std::shared_ptr<const TipForce>& surface, std::uint64_t seed = 1) {
  const Stiffness k(row.input("kc"));
  const LeverDynamics lever = lever_of(row);
  return {surface, k, lever, TipOscillator::longest_sub_step(*surface, k, lever), seed};
}

// Between two sub-steps, where the tip passes a height.
struct Passing {
  Length base;
  Velocity velocity;
};
Passing ramp_down_to(Length height, TipOscillator& tip) {
  for (;;) {
    const Length base = tip.base(), above = tip.height();
    const Velocity velocity = tip.velocity();
    tip.sub_step();
    if (tip.height() > height) continue;
    const double share = (above - height) / (above - tip.height());
    return {base + share * (tip.base() - base), velocity + share * (tip.velocity() - velocity)};
  }
}

// Released at rest from x0 with no surface.
double ring_down_value(const Case& row) {
  const LeverDynamics lever = lever_of(row);
  const double damped_period = 1.0 / (lever.resonance.si * std::sqrt(1.0 - 0.25 / std::pow(lever.quality_factor, 2)));
  constexpr int kSubSteps = 5000;  // number per period
  const Length base = 10_um;
  TipOscillator tip(surface_of(row), Stiffness(row.input_or("kc", 0.1)), lever, Time(damped_period / kSubSteps), 1);
  tip.place(base, base + Length(row.input_or("x0", -14e-9)), Velocity());
  if (row.output == "deflection") {
    for (int i = 0; i < row.input("n") * kSubSteps; ++i) tip.sub_step();
    return tip.deflection().si;
  }

  // the zeros of a ring-down are half a damped period apart
  std::vector<double> zeros;
  for (int i = 0; zeros.size() < 41; ++i) {
    const double before = tip.deflection().si;
    tip.sub_step();
    const double after = tip.deflection().si;
    if ((before < 0.0) != (after < 0.0)) zeros.push_back(i + before / (before - after));
  }
  return kSubSteps * 20.0 / damped_period / (zeros.back() - zeros.front());
}

double ramp_value(const Case& row) {
  TipOscillator tip = oscillator_of(row, surface_of(row));
  tip.settle(Length(row.input("Z0")), Velocity(-row.input("v")));
  const Passing passing = ramp_down_to(Length(row.input("z_stop")), tip);
  if (row.output.starts_with("z_base")) return passing.base.si;
  if (row.output == "tip_velocity_there") return passing.velocity.si;
  Force peak;
  while (tip.velocity() < Velocity()) {
    tip.sub_step();
    bool attached = tip.attached();
    peak = std::max(peak, tip.surface()(tip.height(), attached));
  }
  if (row.output == "tip_z_at_first_turning_point") return tip.height().si;
  if (row.output == "first_peak_contact_force") return peak.si;
  throw std::invalid_argument("no value of a ramp " + row.name);
}

double long_run_deflection(const Case& row) {
  TipOscillator tip = oscillator_of(row, surface_of(row));
  tip.settle(10_um, Velocity());
  const auto steps = static_cast<long>(
      2.0 / TipOscillator::longest_sub_step(tip.surface(), Stiffness(row.input("kc")), lever_of(row)).si);
  double sum = 0.0;
  for (long i = 0; i < steps; ++i) {
    tip.sub_step();
    sum += tip.deflection().si * tip.deflection().si;
  }
  return std::sqrt(sum / static_cast<double>(steps));
}

// Mean and standard deviation of Z over the jumps to contact of many noisy ramps.
double snap_in_statistics(const Case& row) {
  constexpr int kRuns = 400;
  const auto surface = surface_of(row);
  double sum = 0.0, squares = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    TipOscillator tip = oscillator_of(row, surface, 1000 + static_cast<std::uint64_t>(run));
    tip.settle(Length(row.input("Z0")), Velocity(-row.input("v")));
    const double z = ramp_down_to(Length(row.input("z_stop")), tip).base.si;
    sum += z;
    squares += z * z;
  }
  const double mean = sum / kRuns;
  return row.output.starts_with("mean") ? mean : std::sqrt((squares - kRuns * mean * mean) / (kRuns - 1));
}

double value_of(const Case& row) {
  if (row.id.starts_with("beam")) return beam_value(row);
  if (row.id == "dyn_01") return ring_down_value(row);
  if (row.id.starts_with("dyn")) return ramp_value(row);
  if (row.id == "thermal_04") return long_run_deflection(row);
  if (row.id == "thermal_05") return snap_in_statistics(row);
  return thermal_value(row);
}

class LeverCase : public testing::TestWithParam<Case> {};

TEST_P(LeverCase, Agrees) { expect_agrees(GetParam(), value_of(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Research, LeverCase, testing::ValuesIn(cases_of(CaseProgram::Lever)),
                         [](const auto& test) { return test.param.name; });

TEST(LeverCases, F13TurnsABeamByTwiceTheSlopeOfTheEnd) {
  EXPECT_NEAR(end_slope(200_um, 1_nm) / 7.5e-6, 1.0, 1e-9);
  EXPECT_NEAR(spot_displacement(200_um, Length(30e-3), 1_nm).si / 4.5e-7, 1.0, 1e-9);
}

}  // namespace lever_cases_test
}  // namespace afm::physics
