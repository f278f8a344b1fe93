// SPDX-License-Identifier: Apache-2.0
// The lab's cases K05 to K11, by the code of `touchafm lever`.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "curves/lever/lever_calibration.h"
#include "curves/lever/lever_output.h"
#include "physics/flexural_modes.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace lever_calibration_test {

using testing::HasSubstr;
using testing::Not;

// A spectrum without scatter.
std::string spectrum_file(const support::ScratchFolder& folder, const fits::Oscillator& oscillator, const char* units,
                          double low_hz, double high_hz) {
  std::string text = std::string("Hz ") + units + "\n";
  constexpr int kCount = 2000;
  for (int i = 0; i < kCount; ++i) {
    const double hz = std::lerp(low_hz, high_hz, static_cast<double>(i) / (kCount - 1));
    text += fmt::format("{} {}\n", hz, fits::density_at(oscillator, hz));
  }
  return folder.write("spectrum.txt", text);
}

LeverCalibration calibrated(const LeverOptions& options) {
  const auto result = calibrate(options);
  EXPECT_TRUE(result) << result.error().message;
  return result.value_or(LeverCalibration{});
}

class Lever : public testing::Test {
 protected:
  // K06: 60 nm/V, an area of 1.2e-5 V^2, 298.15 K.
  LeverOptions tuned() {
    LeverOptions options;
    options.thermal = spectrum_file(folder_, {70e3, 150.0, 1.2e-5, 1e-12}, "V2/Hz", 50e3, 90e3);
    options.inputs[LeverInput::Sensitivity] = 60e-9;
    options.inputs[LeverInput::Temperature] = 298.15;
    return options;
  }

  support::ScratchFolder folder_;
};

TEST(BeamFactors, AreThoseOfButtAndJaschke) {
  const double shares[] = {0.9706881801, 0.0247158288, 0.003152463982};
  const double virtual_shares[] = {0.8174347866, 0.2510671478, 0.08630963814};
  for (int mode = 1; mode <= 3; ++mode) {
    EXPECT_NEAR(physics::thermal_share(mode), shares[mode - 1], 1e-4 * shares[mode - 1]);
    EXPECT_NEAR(physics::virtual_thermal_share(mode), virtual_shares[mode - 1], 1e-4 * virtual_shares[mode - 1]);
  }
  EXPECT_NEAR(physics::optical_lever_ratio(1), 1.089715963, 1e-4);
}

TEST_F(Lever, HasTheConstantOfItsThermalNoise) {
  const LeverOptions options = tuned();
  const LeverCalibration result = calibrated(options);
  ASSERT_TRUE(result.thermal);
  EXPECT_NEAR(result.thermal->corrected.k_n_per_m, 0.07789103327, 1e-4 * 0.0779);
  EXPECT_NEAR(result.thermal->uncorrected_n_per_m, 0.09528715263, 1e-4 * 0.0953);
  EXPECT_NEAR(
      result.thermal->uncorrected_n_per_m * physics::thermal_share(1) / std::pow(physics::optical_lever_ratio(1), 2),
      0.07789103327, 1e-4 * 0.0779);
  const std::string text = lever_text(options, result);
  EXPECT_THAT(text, HasSubstr("77.89 mN/m"));
  EXPECT_THAT(text, HasSubstr("95.29 mN/m"));
  EXPECT_THAT(text, HasSubstr("0.9707/1.0897^2"));
  const auto json = lever_json(options, result);
  EXPECT_NEAR(json["thermal"]["spring_constant_N_per_m"].get<double>(), 0.07789103327, 1e-5);
  EXPECT_TRUE(json["sader"].is_null());
}

TEST_F(Lever, TakesTheFactorOfAVShapedLeverFromItsUser) {
  LeverOptions options = tuned();
  options.inputs[LeverInput::ModeFactor] = 0.764;
  EXPECT_NEAR(calibrated(options).thermal->corrected.k_n_per_m, 0.764 * 0.09528715263, 1e-6);
}

TEST_F(Lever, HasTheConstantOfASpectrumInNanometres) {
  LeverOptions options;
  options.inputs[LeverInput::Temperature] = 298.15;
  options.thermal = spectrum_file(folder_, {70e3, 150.0, 1.2e-5 * 3600.0, 1e-12 * 3600.0}, "nm2/Hz", 50e3, 90e3);
  EXPECT_NEAR(calibrated(options).thermal->corrected.k_n_per_m, 0.07789103327, 1e-4 * 0.0779);
}

// K08: a lever of 0.3 N/m on a contact of 30 N/m reads a sensitivity that is 1.01 times the true one.
TEST_F(Lever, CorrectsTheComplianceOfTheContact) {
  LeverOptions options;
  options.inputs[LeverInput::Temperature] = 298.15;
  options.inputs[LeverInput::Sensitivity] = 60.6e-9;
  options.inputs[LeverInput::ContactStiffness] = 30.0;
  const double area = physics::virtual_thermal_share(1) * 1.380649e-23 * 298.15 / (0.3 * 60e-9 * 60e-9);
  options.thermal = spectrum_file(folder_, {70e3, 150.0, area, 1e-5 * area}, "V2/Hz", 50e3, 90e3);
  const LeverCalibration result = calibrated(options);
  EXPECT_NEAR(result.thermal->corrected.k_n_per_m, 0.3, 1e-7);
  ASSERT_TRUE(result.sensitivity->corrected_m_per_v);
  EXPECT_NEAR(*result.sensitivity->corrected_m_per_v, 60e-9, 1e-16);
  // forces with the measured sensitivity and its k
  LeverOptions rigid = options;
  rigid.inputs[LeverInput::ContactStiffness] = {};
  EXPECT_NEAR(calibrated(rigid).thermal->corrected.k_n_per_m * 60.6e-9 / (0.3 * 60e-9), 0.9900990099, 1e-7);

  options.inputs[LeverInput::ContactStiffness] = 1.0;
  EXPECT_EQ(calibrate(options).error().category, core::ErrorCategory::WrongUsage);
}

// K10: 3 % of sensitivity, 2 % of area, 1 K.
TEST_F(Lever, HasTheUncertaintyOfItsInputs) {
  LeverOptions options = tuned();
  options.uncertainties = {
      {LeverInput::Sensitivity, 0.03, true}, {LeverInput::Area, 0.02, true}, {LeverInput::Temperature, 1.0, false}};
  const LeverCalibration result = calibrated(options);
  EXPECT_NEAR(result.thermal->corrected.relative_uncertainty, 0.06333442529, 1e-6 * 0.0633);
  EXPECT_NEAR(result.thermal->force_by_sensitivity, 0.03, 1e-6 * 0.03);
}

// K11: a floor that is taken for the lever's noise makes k too small.
TEST_F(Lever, SaysWhatTheFloorWouldDo) {
  LeverOptions options;
  options.inputs[LeverInput::Temperature] = 298.15;
  const double area = 1.380649e-23 * 298.15 / 0.1;
  options.thermal = spectrum_file(folder_, {12e3, 2.5, area, 1e-26}, "m2/Hz", 1e3, 40e3);
  const LeverCalibration result = calibrated(options);
  EXPECT_NEAR(result.thermal->uncorrected_n_per_m, 0.1, 1e-6);
  EXPECT_NEAR(100.0 * result.thermal->floor_bias, -0.9385366784, 1e-3 * 0.9385);
}

// Sader's published program, with its air: the lever of 397 um and 29 um.
TEST_F(Lever, HasSadersConstantWithTheResonanceOfTheSpectrum) {
  LeverOptions options;
  options.sader = true;
  LeverInputs& in = options.inputs;
  in[LeverInput::Temperature] = 298.15;
  in[LeverInput::Length] = 397e-6;
  in[LeverInput::Width] = 29e-6;
  in[LeverInput::Density] = 1.18;
  in[LeverInput::Viscosity] = 1.86e-5;
  EXPECT_EQ(calibrate(options).error().category, core::ErrorCategory::WrongUsage);
  options.thermal = spectrum_file(folder_, {17.36e3, 55.5, 1.2e-5, 1e-12}, "V2/Hz", 12e3, 23e3);
  const LeverCalibration result = calibrated(options);
  ASSERT_TRUE(result.sader);
  const double k = result.sader->k_n_per_m;
  EXPECT_NEAR(k, 0.157307, 1e-4 * k);
  // the sensitivity without a contact
  ASSERT_TRUE(result.sensitivity && result.sensitivity->without_contact);
  const double expected = std::sqrt(physics::virtual_thermal_share(1) * 1.380649e-23 * 298.15 / (k * 1.2e-5));
  EXPECT_NEAR(result.sensitivity->measured_m_per_v, expected, 1e-5 * expected);
}

TEST_F(Lever, HasTheConstantOfTheGlobalCalibrationInitiative) {
  LeverOptions options;
  LeverInputs& in = options.inputs;
  in[LeverInput::Temperature] = 298.15;
  in[LeverInput::GciCoefficient] = 2.0 / (150.0 * std::pow(70e3, 1.3));
  in[LeverInput::Resonance] = 77e3;
  in[LeverInput::QualityFactor] = 300.0;
  in[LeverInput::Tilt] = 0.19198621771937624;  // 11 degrees
  const LeverCalibration result = calibrated(options);
  const double k = 4.0 * std::pow(1.1, 1.3);
  EXPECT_NEAR(result.gci->k_n_per_m, k, 1e-9 * k);
  const double along = lever_json(options, result)["gci"]["along_the_normal_N_per_m"].get<double>();
  EXPECT_NEAR(along, k * 1.0377837046, 1e-8 * k);
}

TEST_F(Lever, HasTheSensitivityOfAContactSlope) {
  LeverOptions options;
  // a hard sample, on which the lever bends as its base moves, read with 1.25 times the true sensitivity
  curves::RecordedCurve curve;
  for (int i = 0; i <= 200; ++i) {
    const double z_m = 1e-6 - 2e-8 * i;
    const double bent_m = std::max(-z_m, 0.0);
    curve.points.push_back({physics::Length(z_m), physics::Force(1.25 * 0.3 * bent_m), physics::Branch::Approach});
  }
  curve.metadata.spring_constant = physics::Stiffness(0.3);
  curve.metadata.sensitivity_m_per_v = 75e-9;
  options.curve = folder_.file("glass.tab");
  ASSERT_TRUE(curves::write_curve(options.curve, curves::CurveFormat::Tab, curve));
  EXPECT_NEAR(calibrated(options).sensitivity->measured_m_per_v, 60e-9, 1e-12);

  curve.metadata.sensitivity_m_per_v.reset();
  ASSERT_TRUE(curves::write_curve(options.curve, curves::CurveFormat::Tab, curve));
  EXPECT_THAT(calibrate(options).error().message, HasSubstr("forces alone"));
}

TEST_F(Lever, SaysWhatIsMissing) {
  LeverOptions options = tuned();
  options.inputs[LeverInput::Sensitivity] = {};
  EXPECT_THAT(calibrate(options).error().message, HasSubstr("is in volts; give --sensitivity"));
  options = tuned();
  options.uncertainties = {{LeverInput::Length, 0.1, true}};
  EXPECT_THAT(calibrate(options).error().message, HasSubstr("--uncertainty length"));
  options = tuned();
  options.inputs[LeverInput::SpringConstant] = 1.0;
  EXPECT_THAT(calibrate(options).error().message, HasSubstr("--spring-constant"));
  options = tuned();
  options.high_hz = 60e3;
  EXPECT_EQ(calibrate(options).error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(calibrate(options).error().message, HasSubstr("--range"));
}

// An option without effect is refused by its name, and so is an uncertainty without a share.
TEST_F(Lever, RefusesWhatActsOnNothing) {
  LeverOptions gci;
  gci.inputs[LeverInput::GciCoefficient] = 1e-9;
  gci.inputs[LeverInput::Resonance] = 70e3;
  gci.inputs[LeverInput::QualityFactor] = 150.0;
  ASSERT_TRUE(calibrate(gci));
  const auto refusal = [](const LeverOptions& options) {
    const auto result = calibrate(options);
    return result ? std::string() : result.error().message;
  };
  LeverOptions options = gci;
  options.inputs[LeverInput::Sensitivity] = 60e-9;
  EXPECT_THAT(refusal(options), HasSubstr("--sensitivity has no effect"));
  options.inputs[LeverInput::ContactStiffness] = 30.0;
  EXPECT_EQ(refusal(options), "");
  options.inputs[LeverInput::Sensitivity] = {};
  EXPECT_THAT(refusal(options), HasSubstr("--contact-stiffness has no effect"));

  // A Q f^1.3 contains neither the sensitivity nor the temperature
  options = gci;
  options.uncertainties = {{LeverInput::QualityFactor, 0.1, true}, {LeverInput::Temperature, 1.0, false}};
  EXPECT_THAT(refusal(options), HasSubstr("--uncertainty temperature"));
  options = tuned();
  options.uncertainties = {{LeverInput::Resonance, 0.1, true}};
  EXPECT_THAT(refusal(options), HasSubstr("--uncertainty resonance"));

  // a known spring constant is not turned, and a higher mode has no quality factor of the first
  options = tuned();
  options.inputs[LeverInput::Sensitivity] = {};
  options.inputs[LeverInput::SpringConstant] = 0.1;
  EXPECT_EQ(refusal(options), "");
  options.inputs[LeverInput::Tilt] = 0.2;
  EXPECT_THAT(refusal(options), HasSubstr("--tilt has no effect"));
  options = tuned();
  options.mode = 2;
  options.bandwidth_hz = 1e3;
  EXPECT_THAT(refusal(options), HasSubstr("--bandwidth has no effect"));
}

TEST_F(Lever, DoubtsWhatSadersMethodIsNotFor) {
  LeverOptions options;
  options.sader = true;
  options.inputs[LeverInput::Length] = 30e-6;
  options.inputs[LeverInput::Width] = 120e-6;
  options.inputs[LeverInput::Resonance] = 70e3;
  options.inputs[LeverInput::QualityFactor] = 0.8;
  const auto doubtful = calibrate(options);
  ASSERT_TRUE(doubtful) << doubtful.error().message;
  EXPECT_THAT(lever_text(options, *doubtful), HasSubstr("doubtful: the lever is 0.25 times as long as it is wide"));
  EXPECT_THAT(lever_text(options, *doubtful), HasSubstr("are length and width exchanged?"));
  EXPECT_EQ(lever_json(options, *doubtful)["sader"]["doubts"].size(), 2U);
  std::swap(*options.inputs[LeverInput::Length], *options.inputs[LeverInput::Width]);
  options.inputs[LeverInput::QualityFactor] = 150.0;
  const auto fine = calibrate(options);
  ASSERT_TRUE(fine) << fine.error().message;
  EXPECT_THAT(lever_text(options, *fine), Not(HasSubstr("doubtful")));
  EXPECT_EQ(lever_json(options, *fine)["sader"]["doubts"].size(), 0U);
}

TEST_F(Lever, OfAHigherModeGivesNoResonanceToSaderAndGci) {
  LeverOptions options = tuned();
  options.mode = 2;
  const LeverCalibration result = calibrated(options);
  EXPECT_FALSE(result.inputs[LeverInput::Resonance]);
  EXPECT_EQ(lever_json(options, result).at("noise").at("force_density_N_per_root_Hz"), nullptr);
  options.inputs[LeverInput::GciCoefficient] = 1e-9;
  EXPECT_THAT(calibrate(options).error().message, HasSubstr("--gci needs --resonance"));
}

TEST_F(Lever, DrawsSpectrumAndModelOnLogarithmicAxes) {
  const curves::SvgPlot plot = lever_plot(calibrated(tuned()));
  ASSERT_EQ(plot.lines.size(), 2U);
  EXPECT_EQ(plot.lines[0].points.size(), 2000U);
  EXPECT_EQ(plot.x_scale, curves::AxisScale::Logarithmic);
  EXPECT_NEAR(plot.lines[0].points[1000].y, plot.lines[1].points[1000].y, 1e-6 * plot.lines[1].points[1000].y);
}

}  // namespace lever_calibration_test
}  // namespace afm::curves
