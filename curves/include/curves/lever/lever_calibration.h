// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "curves/curve_file.h"
#include "curves/lever/lever_inputs.h"
#include "curves/spectrum_file.h"
#include "fits/thermal_fit.h"
#include "physics/sader.h"

// Calibration of a lever (docs/lever.md).
namespace afm::curves {

struct FluidRow {
  std::string_view name;
  physics::Fluid fluid;
};
// Fluids at 25 degrees Celsius: air as in Sader's published program, water by IAPWS 2008.
inline constexpr std::array kFluids{FluidRow{"air", {physics::Density(1.18), physics::Viscosity(1.86e-5)}},
                                    FluidRow{"water", {physics::Density(997.0), physics::Viscosity(8.90e-4)}}};

// Standard uncertainty of an input: a share of its value, or in SI.
struct InputUncertainty {
  LeverInput input;
  double value;
  bool is_share;
};

struct LeverOptions {
  LeverInputs inputs;
  std::string thermal;               // file of a spectrum, or the name of `spectrum`; empty: no spectrum
  std::optional<Spectrum> spectrum;  // spectrum that is used instead of a file
  SpectrumReading reading;
  double low_hz = 0.0, high_hz = 1e12;
  std::optional<double> averages;
  int mode = 1;
  bool sader = false;
  std::optional<physics::Fluid> fluid;  // fluid of Sader's method; empty: air
  std::string curve;                    // file whose contact slope is the sensitivity; empty: none
  CurveReading curve_reading;
  std::optional<double> bandwidth_hz;
  std::vector<InputUncertainty> uncertainties;

  // Limits of the numbers above that are no inputs.
  static constexpr double kLeastAverages = 1.0, kMostAverages = 1e9;
  static constexpr int kHighestMode = 10;
  static constexpr double kLeastBandwidthHz = 1e-3, kMostBandwidthHz = 1e8;
};

// A spring constant, and the standard uncertainty by those of the inputs, to the first order.
struct CalibratedConstant {
  double k_n_per_m = 0;
  double relative_uncertainty = 0;
  std::vector<double> shares{};  // relative uncertainty of k from each uncertainty of the options
};

struct ThermalConstant {
  CalibratedConstant corrected;
  fits::Interval interval_n_per_m;  // 95 % interval, from the statistics only
  double uncorrected_n_per_m = 0;   // k_B T/(sensitivity^2 area), without the corrections
  double floor_bias = 0;            // relative error of k if the floor were taken for the lever's noise
  double force_by_sensitivity = 0;  // uncertainty of a force k s V over that of the sensitivity s, both relative
};

struct SensitivityFound {
  double measured_m_per_v = 0;
  std::optional<double> corrected_m_per_v{};  // sensitivity on a rigid contact; empty: the contact was rigid
  bool without_contact = false;               // true: from the spectrum and a spring constant
};

struct LeverCalibration {
  LeverInputs inputs;                // inputs, completed by defaults, spectrum and curve
  std::optional<Spectrum> spectrum;  // rows of the spectrum within the range
  std::optional<fits::ThermalFit> fit;
  std::optional<ThermalConstant> thermal;
  std::optional<CalibratedConstant> sader, gci;
  std::optional<SensitivityFound> sensitivity;

  // The constant used for further results: thermal, Sader's, GCI's, or the known one.
  std::optional<double> spring_constant_n_per_m() const;
};

// Reads the files and computes whatever the options determine. WrongUsage if they lack an input, or if one, or an
// uncertainty, has no effect; BadInputFile for files that are none, or without a resonance or a contact.
core::Result<LeverCalibration> calibrate(const LeverOptions& options);

}  // namespace afm::curves
