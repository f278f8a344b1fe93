// SPDX-License-Identifier: Apache-2.0
#include "curves/lever/lever_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "curves/curve_report.h"
#include "curves/uncertainty_text.h"
#include "fits/uncertainty.h"
#include "physics/flexural_modes.h"
#include "physics/sader.h"
#include "physics/units.h"

namespace afm::curves {

namespace {

using core::wrong_usage;

constexpr double kRoomTemperature_k = 298.15;

// Spring constant (L2) k_B T/(s^2 A), s the sensitivity, 1 for a spectrum in metres.
double uncorrected_k(const LeverInputs& in) {
  const double energy_j = physics::thermal_energy(physics::Temperature(*in[LeverInput::Temperature])).si;
  const double sensitivity = in[LeverInput::Sensitivity].value_or(1.0);
  return energy_j / (sensitivity * sensitivity * *in[LeverInput::Area]);
}

// Spring constant (L3), the mode's factor times (L2). A contact of stiffness c makes the sensitivity larger by 1 + k/c
// (L4), so that k = k' (1 + k/c)^2 for the k' of the measured sensitivity; NaN if c is below 4 k'.
double thermal_k(const LeverInputs& in) {
  const double k = *in[LeverInput::ModeFactor] * uncorrected_k(in);
  if (!in[LeverInput::ContactStiffness]) return k;
  const double u = k / *in[LeverInput::ContactStiffness];
  return 4.0 * k / std::pow(1.0 + std::sqrt(1.0 - 4.0 * u), 2);
}

double sader_k(const LeverInputs& in) {
  return physics::sader_spring_constant(
             physics::Length(*in[LeverInput::Length]), physics::Length(*in[LeverInput::Width]),
             physics::Frequency(*in[LeverInput::Resonance]), *in[LeverInput::QualityFactor],
             {physics::Density(*in[LeverInput::Density]), physics::Viscosity(*in[LeverInput::Viscosity])})
      .si;
}

// Spring constant (L6), Sader and others, Rev. Sci. Instrum. 87, 093711 (2016).
double gci_k(const LeverInputs& in) {
  return *in[LeverInput::GciCoefficient] * *in[LeverInput::QualityFactor] * std::pow(*in[LeverInput::Resonance], 1.3);
}

using Formula = std::function<double(const LeverInputs&)>;

// Share of one input's uncertainty in a result, by a central difference.
double share_of(const InputUncertainty& uncertainty, const LeverInputs& in, const Formula& formula) {
  constexpr double kStep = 1e-5;
  constexpr std::array kFactors{1.0 - kStep, 1.0 + kStep};
  const double relative = uncertainty.is_share ? uncertainty.value : uncertainty.value / *in[uncertainty.input];
  const auto log_at = [&](double factor) {
    LeverInputs moved(in);
    *moved[uncertainty.input] *= factor;
    return std::log(formula(moved));
  };
  return fits::error_share(relative, kFactors, {log_at(kFactors[0]), log_at(kFactors[1])});
}

CalibratedConstant calibrated(const LeverInputs& in, const std::vector<InputUncertainty>& uncertainties,
                              const Formula& formula) {
  CalibratedConstant result{.k_n_per_m = formula(in)};
  result.shares.reserve(uncertainties.size());
  for (const InputUncertainty& each : uncertainties) result.shares.push_back(share_of(each, in, formula));
  result.relative_uncertainty = fits::sum_of_shares(result.shares);
  return result;
}

core::Result<void> fit_spectrum(const LeverOptions& options, LeverCalibration& result) {
  auto spectrum =
      options.spectrum ? core::Result<Spectrum>(*options.spectrum) : load_spectrum(options.thermal, options.reading);
  if (!spectrum) return tl::unexpected(spectrum.error());
  std::erase_if(spectrum->rows, [&](const SpectrumRow& row) {
    return row.frequency_hz < options.low_hz || row.frequency_hz > options.high_hz;
  });
  std::vector<fits::SpectrumPoint> points;
  points.reserve(spectrum->rows.size());
  for (const SpectrumRow& row : spectrum->rows) points.push_back({row.frequency_hz, row.density});
  std::string why;
  auto fit = fits::fit_thermal(points, options.averages, why);
  if (!fit) {
    return core::failure(
        core::ErrorCategory::BadInputFile,
        fmt::format("cannot fit the spectrum {}: {}; give --range around the first resonance", options.thermal, why));
  }
  result.spectrum = std::move(*spectrum);
  result.fit = std::move(*fit);
  LeverInputs& in = result.inputs;
  const fits::Oscillator& oscillator = result.fit->oscillator;
  in[LeverInput::Area] = oscillator.area;
  // Sader's and GCI's are those of the first mode
  if (options.mode == 1) {
    if (!in[LeverInput::Resonance]) in[LeverInput::Resonance] = oscillator.resonance_hz;
    if (!in[LeverInput::QualityFactor]) in[LeverInput::QualityFactor] = oscillator.quality_factor;
  }
  if (!in[LeverInput::ModeFactor]) in[LeverInput::ModeFactor] = physics::virtual_thermal_share(options.mode);
  return {};
}

// Calibration used for reading a curve with deflections in volts; it cancels.
constexpr physics::Stiffness kAnyStiffness(1.0);
constexpr double kAnySensitivity = 1e-7;

// Sensitivity with which the contact slope is that of a rigid sample.
core::Result<double> sensitivity_of(const std::string& file, CurveReading reading) {
  const auto refused = [&](const char* why) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("cannot take a sensitivity from {}: {}", file, why));
  };
  auto curve = load_curve(file, reading);
  if (!curve) {
    reading.spring_constant = kAnyStiffness;
    reading.sensitivity_m_per_v = kAnySensitivity;
    curve = load_curve(file, reading);
  }
  if (!curve) return tl::unexpected(curve.error());
  const auto sensitivity = curve->metadata.sensitivity_m_per_v;
  const auto spring = curve->metadata.spring_constant;
  if (!sensitivity || !spring) return refused("it has forces alone, without their sensitivity and spring constant");
  const auto found = analysed(file, std::move(*curve));
  if (!found) return tl::unexpected(found.error());
  const auto slope = found->features.contact_slope;
  if (!slope || !(slope->si > 0.0)) return refused("it has no contact slope");
  return *sensitivity * (*spring / *slope);
}

// WrongUsage if an option lacks an input.
core::Result<void> require(const LeverInputs& in, std::string_view option, std::initializer_list<LeverInput> inputs) {
  for (const LeverInput input : inputs) {
    if (!in[input]) return wrong_usage(fmt::format("{} needs --{}", option, row_of(input).name));
  }
  return {};
}

core::Result<void> check_uncertainties(const LeverOptions& options, const LeverInputs& in) {
  for (const InputUncertainty& each : options.uncertainties) {
    const LeverInputRow& row = row_of(each.input);
    if (!in[each.input])
      return wrong_usage(fmt::format("--uncertainty {}: nothing here is computed from it", row.name));
    if (!each.is_share && each.value > kMostUncertainty * *in[each.input]) {
      return wrong_usage(
          fmt::format("--uncertainty {}: it is more than {:g} % of the value", row.name, 100.0 * kMostUncertainty));
    }
  }
  return {};
}

ThermalConstant thermal_constant(const LeverOptions& options, const LeverCalibration& result) {
  const LeverInputs& in = result.inputs;
  ThermalConstant thermal;
  thermal.corrected = calibrated(in, options.uncertainties, thermal_k);
  thermal.uncorrected_n_per_m = uncorrected_k(in);
  const auto k_of_area = [&](double area) {
    LeverInputs moved(in);
    moved[LeverInput::Area] = area;
    return thermal_k(moved);
  };
  thermal.interval_n_per_m = {k_of_area(result.fit->area.high), k_of_area(result.fit->area.low)};
  const double floor_area = result.fit->oscillator.floor * (result.fit->high_hz - result.fit->low_hz);
  thermal.floor_bias = 1.0 / (1.0 + floor_area / result.fit->oscillator.area) - 1.0;
  for (const InputUncertainty& each : options.uncertainties) {
    if (each.input != LeverInput::Sensitivity) continue;
    // the force is k s V, and the sensitivity in it that of a rigid contact
    const Formula force = [](const LeverInputs& moved) {
      const double k = thermal_k(moved);
      return k * *moved[LeverInput::Sensitivity] /
             (moved[LeverInput::ContactStiffness] ? 1.0 + k / *moved[LeverInput::ContactStiffness] : 1.0);
    };
    thermal.force_by_sensitivity = share_of(each, in, force);
  }
  return thermal;
}

core::Result<void> compute_constants(const LeverOptions& options, LeverCalibration& result) {
  const LeverInputs& in = result.inputs;
  const std::vector<InputUncertainty>& uncertainties = options.uncertainties;
  if (const auto checked = check_uncertainties(options, in); !checked) return checked;
  if (options.sader) {
    auto checked = require(in, "--sader",
                           {LeverInput::Length, LeverInput::Width, LeverInput::Resonance, LeverInput::QualityFactor,
                            LeverInput::Density, LeverInput::Viscosity});
    if (!checked) return checked;
    try {
      result.sader = calibrated(in, uncertainties, sader_k);
    } catch (const std::invalid_argument& unknown) {
      return wrong_usage(fmt::format("--sader: {}; check --width, --resonance and the fluid", unknown.what()));
    }
  }
  if (in[LeverInput::GciCoefficient]) {
    const auto checked = require(in, "--gci", {LeverInput::Resonance, LeverInput::QualityFactor});
    if (!checked) return checked;
    result.gci = calibrated(in, uncertainties, gci_k);
  }
  if (!result.fit) return {};
  if (!result.spectrum->in_volts && in[LeverInput::Sensitivity]) {
    return wrong_usage(fmt::format("{} is in metres already; leave the sensitivity out", options.thermal));
  }
  if (!result.spectrum->in_volts || in[LeverInput::Sensitivity]) {
    result.thermal = thermal_constant(options, result);
    if (!std::isfinite(result.thermal->corrected.k_n_per_m)) {
      return wrong_usage("--contact-stiffness is below four times the spring constant: the sensitivity says nothing");
    }
  } else if (!result.spring_constant_n_per_m()) {
    return wrong_usage(
        fmt::format("{} is in volts; give --sensitivity or --sensitivity-from, or a spring constant by "
                    "--sader, --gci or --spring-constant",
                    options.thermal));
  }
  return {};
}

void find_sensitivity(LeverCalibration& result) {
  const LeverInputs& in = result.inputs;
  const auto k = result.spring_constant_n_per_m();
  if (in[LeverInput::Sensitivity]) {
    result.sensitivity = SensitivityFound{.measured_m_per_v = *in[LeverInput::Sensitivity]};
    if (k && in[LeverInput::ContactStiffness]) {
      result.sensitivity->corrected_m_per_v =
          *in[LeverInput::Sensitivity] / (1.0 + *k / *in[LeverInput::ContactStiffness]);
    }
  } else if (result.fit && result.spectrum->in_volts && k) {
    // (L5) the sensitivity that gives the known spring constant
    const double measured_m_per_v = std::sqrt(*in[LeverInput::ModeFactor] * uncorrected_k(in) / *k);
    result.sensitivity = SensitivityFound{.measured_m_per_v = measured_m_per_v, .without_contact = true};
  }
}

// Option, the result on which it acts, and whether that is present.
struct Acting {
  std::string_view option;
  bool is_given, acts;
  std::string_view on;
};

// WrongUsage for an option without effect.
core::Result<void> check_acting(const LeverOptions& options, const LeverCalibration& result) {
  const LeverInputs& given = options.inputs;
  const bool has_k = result.spring_constant_n_per_m().has_value();
  const bool is_calibrated = result.thermal || result.sader || result.gci;
  const bool rigid = !given[LeverInput::ContactStiffness];
  const bool has_resonance = has_k && result.inputs[LeverInput::Resonance] && result.inputs[LeverInput::QualityFactor];
  const std::array inputs{
      Acting{"--sensitivity", given[LeverInput::Sensitivity].has_value(), result.thermal || (has_k && !rigid),
             "a spectrum in volts (--thermal), or the correction by --contact-stiffness"},
      Acting{"--contact-stiffness", !rigid, result.inputs[LeverInput::Sensitivity] && has_k,
             "a sensitivity (--sensitivity or --sensitivity-from) with a spring constant"},
      Acting{"--temperature", given[LeverInput::Temperature].has_value(), has_k, "a spring constant"},
      Acting{"--resonance", given[LeverInput::Resonance].has_value(), has_resonance,
             "a spring constant, together with --quality-factor"},
      Acting{"--quality-factor", given[LeverInput::QualityFactor].has_value(), has_resonance,
             "a spring constant, together with --resonance"},
      Acting{"--tilt", given[LeverInput::Tilt].has_value(), is_calibrated,
             "a spring constant that is calibrated by --thermal, --sader or --gci"},
      Acting{"--bandwidth", options.bandwidth_hz.has_value(), has_resonance,
             "a spring constant with resonance and quality factor"}};
  for (const Acting& each : inputs) {
    if (each.is_given && !each.acts) {
      return wrong_usage(
          fmt::format("{} has no effect here; it needs {}. Leave it out, or give that", each.option, each.on));
    }
  }
  return {};
}

// WrongUsage for an uncertainty without effect on any constant.
core::Result<void> check_shares(const LeverOptions& options, const LeverCalibration& result) {
  for (std::size_t i = 0; i < options.uncertainties.size(); ++i) {
    const auto has = [i](const CalibratedConstant& constant) { return constant.shares[i] > 0.0; };
    if ((result.thermal && has(result.thermal->corrected)) || (result.sader && has(*result.sader)) ||
        (result.gci && has(*result.gci))) {
      continue;
    }
    return wrong_usage(fmt::format("--uncertainty {}: no spring constant is computed from it here; leave it out",
                                   row_of(options.uncertainties[i].input).name));
  }
  return {};
}

core::Result<void> complete_fluid(const LeverOptions& options, LeverInputs& in) {
  if (options.fluid && in[LeverInput::Density] && in[LeverInput::Viscosity]) {
    return wrong_usage("--fluid has no effect with --density and --viscosity; leave it out");
  }
  if (!options.sader) return {};
  const physics::Fluid fluid = options.fluid.value_or(kFluids[0].fluid);
  if (!in[LeverInput::Density]) in[LeverInput::Density] = fluid.density.si;
  if (!in[LeverInput::Viscosity]) in[LeverInput::Viscosity] = fluid.viscosity.si;
  return {};
}

}  // namespace

std::optional<double> LeverCalibration::spring_constant_n_per_m() const {
  if (thermal) return thermal->corrected.k_n_per_m;
  if (sader) return sader->k_n_per_m;
  if (gci) return gci->k_n_per_m;
  return inputs[LeverInput::SpringConstant];
}

core::Result<LeverCalibration> calibrate(const LeverOptions& options) {
  if (options.thermal.empty() && options.curve.empty() && !options.sader &&
      !options.inputs[LeverInput::GciCoefficient]) {
    return wrong_usage("nothing to calibrate by; give --thermal, --sader, --gci or --sensitivity-from");
  }
  LeverCalibration result;
  result.inputs = options.inputs;
  if (const auto completed = complete_fluid(options, result.inputs); !completed) {
    return tl::unexpected(completed.error());
  }
  if (!result.inputs[LeverInput::Temperature]) result.inputs[LeverInput::Temperature] = kRoomTemperature_k;
  if (!options.curve.empty()) {
    if (result.inputs[LeverInput::Sensitivity]) return wrong_usage("--sensitivity and --sensitivity-from: choose one");
    const auto found = sensitivity_of(options.curve, options.curve_reading);
    if (!found) return tl::unexpected(found.error());
    result.inputs[LeverInput::Sensitivity] = *found;
  }
  if (!options.thermal.empty()) {
    if (const auto fitted = fit_spectrum(options, result); !fitted) return tl::unexpected(fitted.error());
  }
  if (const auto computed = compute_constants(options, result); !computed) return tl::unexpected(computed.error());
  if (result.inputs[LeverInput::SpringConstant] && (result.thermal || result.sader || result.gci)) {
    return wrong_usage("--spring-constant is for a lever whose constant is known; leave it out to calibrate one");
  }
  if (const auto checked = check_acting(options, result); !checked) return tl::unexpected(checked.error());
  if (const auto checked = check_shares(options, result); !checked) return tl::unexpected(checked.error());
  find_sensitivity(result);
  return result;
}

}  // namespace afm::curves
