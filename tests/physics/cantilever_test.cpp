// SPDX-License-Identifier: Apache-2.0
// Invariant: the drawn beam has the shape of the physics
#include "physics/cantilever.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "physics/beam_shape.h"
#include "physics/contact_parameters.h"
#include "physics/flexural_modes.h"
#include "physics/sader.h"
#include "physics/thermal_noise.h"

// The shader's own text, compiled as C++: a four-vector and two functions of GLSL are all that it needs. Its literals
// are doubles here.
namespace shader {

struct vec4 {
  float x, y, z, w;
};
double clamp(double value, double low, double high) { return value < low ? low : value > high ? high : value; }
double max(double a, double b) { return a > b ? a : b; }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include "beam.glsl"
#pragma GCC diagnostic pop

}  // namespace shader

namespace afm::physics {
namespace cantilever_test {

using namespace literals;
using testing::HasSubstr;

const RectangularLever kContactLever{450_um, 50_um, 2_um, 169_GPa, Density(2330)};

TEST(BeamShape, IsClampedAtTheBaseAndOneAtTheEnd) {
  EXPECT_EQ(beam_deflection(0.0), 0.0);
  EXPECT_EQ(beam_slope(0.0), 0.0);
  EXPECT_EQ(beam_deflection(1.0), 1.0);
  EXPECT_EQ(beam_slope(1.0), 1.5);
}

TEST(BeamShape, IsFlatBeforeTheClampAndStraightBeyondTheLoad) {
  EXPECT_EQ(beam_deflection(-0.3), 0.0);
  EXPECT_EQ(beam_slope(-0.3), 0.0);
  EXPECT_DOUBLE_EQ(beam_deflection(1.4), 1.0 + 1.5 * 0.4);
  EXPECT_EQ(beam_slope(1.4), 1.5);
}

TEST(BeamShape, HasTheSlopeOfItsDifferences) {
  constexpr double kStep = 1e-6;
  for (double xi = -0.2; xi < 1.5; xi += 0.01) {
    const double difference = (beam_deflection(xi + kStep) - beam_deflection(xi - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(beam_slope(xi), difference, 2e-6) << xi;
  }
}

// E I w'' is the moment of the load, which falls from F L at the clamp to zero at the end.
TEST(BeamShape, CarriesTheMomentOfItsLoad) {
  const Force load = 1_nN;
  const double bending = 169e9 * 50e-6 * std::pow(2e-6, 3) / 12.0;
  const Length end = load / spring_constant(kContactLever);
  constexpr double kStep = 1e-5;
  for (const double xi : {0.0, 0.3, 0.8}) {
    const double curvature = (beam_slope(xi + kStep) - beam_slope(xi)) / kStep * end.si / std::pow(450e-6, 2);
    EXPECT_NEAR(bending * curvature, (load * kContactLever.length).si * (1.0 - xi), 1e-17) << xi;
  }
}

TEST(BeamShape, IsWhatTheShaderDraws) {
  constexpr float kLength = 0.25F, kEnd = -0.5F;
  const shader::vec4 bend{1.0F / kLength, kEnd, 0.0F, 0.0F};
  for (double xi = -0.25; xi <= 1.5; xi += 0.03125) {
    const auto x = static_cast<float>(xi) * kLength;
    EXPECT_NEAR(static_cast<double>(shader::beam_deflection(bend, x)), -0.5 * beam_deflection(xi), 1e-7) << xi;
    EXPECT_NEAR(static_cast<double>(shader::beam_slope(bend, x)), -0.5 * 4.0 * beam_slope(xi), 1e-6) << xi;
  }
}

TEST(FlexuralModes, SolveTheirEquation) {
  EXPECT_NEAR(flexural_root(1), 1.875104068711961, 1e-14);
  EXPECT_NEAR(flexural_root(2), 4.694091132974175, 1e-14);
  for (int mode = 1; mode <= 30; ++mode) {
    const double a = flexural_root(mode);
    EXPECT_NEAR(std::cos(a) + 1.0 / std::cosh(a), 0.0, 1e-13) << mode;
    EXPECT_GT(a, (mode - 1) * std::numbers::pi);
    EXPECT_LT(a, mode * std::numbers::pi);
  }
}

TEST(FlexuralModes, ShareAllOfTheThermalNoise) {
  double deflection = 0.0, virtual_deflection = 0.0;
  for (int mode = 1; mode <= 400; ++mode) {
    deflection += thermal_share(mode);
    virtual_deflection += virtual_thermal_share(mode);
  }
  EXPECT_NEAR(deflection, 1.0, 1e-8);
  // the series converges as 1/n
  EXPECT_NEAR(virtual_deflection, 4.0 / 3.0, 16.0 / (3.0 * std::pow(std::numbers::pi, 2) * 400.0) * 1.01);
}

TEST(FlexuralModes, AreCountedFromOne) { EXPECT_THROW(flexural_root(0), std::invalid_argument); }

TEST(Cantilever, ResonatesAsItsEffectiveMassOnItsSpring) {
  const Mass mass = kContactLever.density * kContactLever.length * kContactLever.width * kContactLever.thickness;
  const Mass effective = 3.0 / std::pow(flexural_root(1), 4) * mass;
  const double angular = std::sqrt(spring_constant(kContactLever) / effective / (1_Hz * 1_Hz));
  EXPECT_NEAR(vacuum_resonance(kContactLever).si, angular / (2.0 * std::numbers::pi), 1e-9);
}

TEST(Cantilever, IsEightTimesAsStiffWhenTwiceAsThickOrHalfAsLong) {
  RectangularLever thick = kContactLever, small = kContactLever;
  thick.thickness = 2.0 * thick.thickness;
  small.length = 0.5 * small.length;
  EXPECT_DOUBLE_EQ(spring_constant(thick) / spring_constant(kContactLever), 8.0);
  EXPECT_DOUBLE_EQ(spring_constant(small) / spring_constant(kContactLever), 8.0);
}

// Two slender arms, side by side, are two rectangular levers.
TEST(Cantilever, OfVShapeWithNarrowArmsIsTwoParallelBeams) {
  const VShapedLever slender{200_um, 1_um, 10_nm, 600_nm, 169_GPa};
  const RectangularLever arm{200_um, 10_nm, 600_nm, 169_GPa, Density(2330)};
  EXPECT_NEAR(spring_constant(slender) / spring_constant(arm), 2.0, 1e-4);
}

TEST(Cantilever, IsStifferTheMoreItIsTilted) {
  EXPECT_EQ(tilted_spring_constant(0.1_N_per_m, 0.0), 0.1_N_per_m);
  const double eleven_degrees = 11.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(tilted_spring_constant(0.1_N_per_m, eleven_degrees).si, 0.10378, 1e-5);
}

TEST(Cantilever, RefusesWhatCannotBeBuilt) {
  RectangularLever lever = kContactLever;
  lever.thickness = -2_um;
  try {
    validate(lever);
    FAIL();
  } catch (const UnphysicalValue& error) {
    EXPECT_EQ(error.field(), "thickness");
    EXPECT_STREQ(error.what(), "thickness -2 um is not within 10 nm to 10 mm");
  }
  lever = kContactLever;
  lever.young_modulus = Pressure(std::nan(""));
  EXPECT_THROW(validate(lever), UnphysicalValue);
  EXPECT_NO_THROW(validate(kContactLever));

  VShapedLever arms{100_um, 100_um, 60_um, 600_nm, 169_GPa};
  EXPECT_THROW(validate(arms), UnphysicalValue);
  arms.arm_width = 20_um;
  EXPECT_NO_THROW(validate(arms));
}

// Sader's own limits: in a thin fluid the added mass is that of a plate in an ideal one, Gamma = 1; slow flow damps
// more than it loads.
TEST(HydrodynamicFunction, TendsToThatOfAnIdealFluid) {
  const auto thin = hydrodynamic_function(1e4), slow = hydrodynamic_function(1e-2);
  EXPECT_NEAR(thin.real(), 1.0, 0.05);
  EXPECT_LT(thin.imag(), 0.05);
  EXPECT_GT(slow.imag(), slow.real());
}

TEST(HydrodynamicFunction, FallsAsTheReynoldsNumberRises) {
  auto before = hydrodynamic_function(1e-6);
  for (double power = -5.9; power <= 4.0; power += 0.1) {
    const auto gamma = hydrodynamic_function(std::pow(10.0, power));
    EXPECT_LT(gamma.imag(), before.imag()) << power;
    EXPECT_LT(gamma.real(), before.real()) << power;
    EXPECT_GT(gamma.imag(), 0.0) << power;
    before = gamma;
  }
}

TEST(HydrodynamicFunction, RefusesWhatItWasNotFittedFor) {
  for (const double bad : {0.0, -1.0, 1e5, std::nan("")}) {
    EXPECT_THROW(hydrodynamic_function(bad), std::invalid_argument) << bad;
  }
}

TEST(ThermalNoise, InAWideBandIsAllOfIt) {
  for (const double quality : {0.1, 0.5, 0.5000001, 1.0, 2.5, 400.0}) {
    const LeverDynamics lever{12_kHz, quality, 298_K};
    const double all = thermal_deflection(0.1_N_per_m, 298_K).si;
    EXPECT_NEAR(thermal_deflection_below(Frequency(12e9), 0.1_N_per_m, lever).si, all, 1e-5 * all) << quality;
    EXPECT_LT(thermal_deflection_below(12_kHz, 0.1_N_per_m, lever).si, all) << quality;
  }
}

TEST(ThermalNoise, InANarrowBandIsThatOfAWhiteForceOnASpring) {
  const LeverDynamics lever{12_kHz, 2.5, 298_K};
  const double white = std::sqrt(thermal_force_spectrum(0.1_N_per_m, lever).si * 10.0) / 0.1;
  EXPECT_NEAR(thermal_deflection_below(10_Hz, 0.1_N_per_m, lever).si, white, 1e-5 * white);
}

TEST(LeverDynamics, RefusesWhatNoLeverHas) {
  const LeverDynamics good{12_kHz, 2.5, 298_K};
  EXPECT_NO_THROW(validate(good));
  LeverDynamics bad = good;
  bad.quality_factor = 0.0;
  try {
    validate(bad);
    FAIL();
  } catch (const UnphysicalValue& error) {
    EXPECT_EQ(error.field(), "quality_factor");
    EXPECT_STREQ(error.what(), "quality factor 0 is not within 0.01 to 1e7");
  }
  bad = good;
  bad.temperature = Temperature(-1.0);
  EXPECT_THROW(validate(bad), UnphysicalValue);
  bad = good;
  bad.resonance = Frequency(std::nan(""));
  EXPECT_THROW(validate(bad), UnphysicalValue);
}

}  // namespace cantilever_test
}  // namespace afm::physics
