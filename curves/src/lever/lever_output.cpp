// SPDX-License-Identifier: Apache-2.0
#include "curves/lever/lever_output.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/written_by.h"
#include "physics/cantilever.h"
#include "physics/flexural_modes.h"
#include "physics/thermal_noise.h"

namespace afm::curves {

namespace {

using physics::format_quantity;
using LeverJson = nlohmann::ordered_json;

constexpr int kLeverDigits = 4;

std::string stiffness_text(double n_per_m) {
  return format_quantity(physics::Stiffness(n_per_m), physics::kStiffnessUnits, kLeverDigits);
}
std::string frequency_text(double hz) {
  return format_quantity(physics::Frequency(hz), physics::kFrequencyUnits, kLeverDigits + 2);
}
std::string sensitivity_text(double m_per_v) {
  return physics::format_si(m_per_v, lever_units::kSensitivities, kLeverDigits);
}
std::string percent_text(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

class LeverLines {
 public:
  void line(std::string_view title, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), "{:<24}{:>18}\n", title, value);
  }
  void title(std::string_view text) {
    fmt::format_to(std::back_inserter(text_), "{}{}\n", text_.size() > 0 ? "\n" : "", text);
  }
  void note(std::string_view text) { fmt::format_to(std::back_inserter(text_), "  {}\n", text); }
  std::string text() const { return fmt::to_string(text_); }

 private:
  fmt::memory_buffer text_;
};

// Adds lines on a constant with its uncertainty, and on the constant along the sample's normal.
void constant_lines(const LeverOptions& options, const LeverInputs& in, const CalibratedConstant& constant,
                    LeverLines& lines) {
  if (!options.uncertainties.empty())
    lines.line("  uncertainty of inputs", percent_text(constant.relative_uncertainty));
  if (!in[LeverInput::Tilt]) return;
  const physics::Stiffness k(constant.k_n_per_m);
  lines.line("  along the normal", stiffness_text(physics::tilted_spring_constant(k, *in[LeverInput::Tilt]).si));
}

void spectrum_lines(const LeverOptions& options, const LeverCalibration& result, LeverLines& lines) {
  const fits::ThermalFit& fit = *result.fit;
  const fits::Oscillator& oscillator = fit.oscillator;
  const char* const unit = result.spectrum->in_volts ? "V" : "m";
  lines.title(fmt::format("thermal noise of {}, {} points from {} to {}", options.thermal, fit.points,
                          frequency_text(fit.low_hz), frequency_text(fit.high_hz)));
  const auto interval = [&](const std::string& low, const std::string& high) {
    lines.line("  95 % from", low);
    lines.line("  to", high);
  };
  lines.line("resonance f0", frequency_text(oscillator.resonance_hz));
  interval(frequency_text(fit.resonance_hz.low), frequency_text(fit.resonance_hz.high));
  lines.line("quality factor Q", fmt::format("{:.4g}", oscillator.quality_factor));
  interval(fmt::format("{:.4g}", fit.quality_factor.low), fmt::format("{:.4g}", fit.quality_factor.high));
  lines.line(fmt::format("area of mode {}", options.mode), fmt::format("{:.4g} {}^2", oscillator.area, unit));
  interval(fmt::format("{:.4g} {}^2", fit.area.low, unit), fmt::format("{:.4g} {}^2", fit.area.high, unit));
  lines.line("floor", fmt::format("{:.3g} {}^2/Hz", oscillator.floor, unit));
  interval(fmt::format("{:.3g} {}^2/Hz", fit.floor.low, unit), fmt::format("{:.3g} {}^2/Hz", fit.floor.high, unit));
  if (fit.seen_averages) lines.line("averages by the scatter", fmt::format("{:.3g}", *fit.seen_averages));
  if (fit.neighbour_factor > 1.0) {
    lines.note(fmt::format("neighbours are correlated, as by a window: all variances are {:.2f} times larger",
                           fit.neighbour_factor));
  }
  for (const fits::FoundInSpectrum& found : fit.doubts) {
    lines.note(fmt::format("doubtful: {} {:.3g} (limit {:.3g})",
                           fits::kSpectrumDoubts.at(static_cast<std::size_t>(found.doubt)).name, found.figure,
                           found.limit));
  }
}

void thermal_lines(const LeverOptions& options, const LeverCalibration& result, LeverLines& lines) {
  const LeverInputs& in = result.inputs;
  const ThermalConstant& thermal = *result.thermal;
  lines.title("spring constant by the thermal noise");
  lines.line("uncorrected k_B T/<x^2>", stiffness_text(thermal.uncorrected_n_per_m));
  if (options.inputs[LeverInput::ModeFactor]) {
    lines.line("correction, given", fmt::format("{:.4g}", *in[LeverInput::ModeFactor]));
  } else {
    lines.line("correction", fmt::format("{:.4f}", *in[LeverInput::ModeFactor]));
    lines.note(fmt::format("= {:.4f}/{:.4f}^2: share of the mode over chi^2, one correction and not two",
                           physics::thermal_share(options.mode), physics::optical_lever_ratio(options.mode)));
  }
  lines.line("spring constant k", stiffness_text(thermal.corrected.k_n_per_m));
  lines.line("  95 % from", stiffness_text(thermal.interval_n_per_m.low));
  lines.line("  to", stiffness_text(thermal.interval_n_per_m.high));
  constant_lines(options, in, thermal.corrected, lines);
  if (thermal.force_by_sensitivity > 0.0) {
    lines.line("  forces by sensitivity", percent_text(thermal.force_by_sensitivity));
  }
  lines.note(
      fmt::format("if the floor were noise of the lever, k would be off by {:.3g} %", 100.0 * thermal.floor_bias));
  lines.note("the interval covers only the scatter of the spectrum");
}

// Reasons to doubt Sader's method (docs/lever.md).
std::vector<std::string> sader_doubts(const LeverInputs& in) {
  constexpr double kLeastAspect = 3.0, kLeastQuality = 1.0;
  std::vector<std::string> doubts;
  const double aspect = *in[LeverInput::Length] / *in[LeverInput::Width];
  if (aspect < kLeastAspect) {
    doubts.push_back(
        fmt::format("the lever is {:.2g} times as long as it is wide, and the method is for {:g} and more{}", aspect,
                    kLeastAspect, aspect < 1.0 ? ": are length and width exchanged?" : ""));
  }
  if (*in[LeverInput::QualityFactor] <= kLeastQuality)
    doubts.emplace_back("the method is for quality factors well above 1");
  return doubts;
}

// Noise of the free lever at the tip.
struct FreeNoise {
  physics::Length deflection;
  physics::Force force;
  std::optional<double> force_density_n_per_root_hz;
  std::optional<physics::Length> deflection_below;
};

FreeNoise noise_of(const LeverOptions& options, const LeverCalibration& result) {
  const LeverInputs& in = result.inputs;
  const physics::Stiffness k(*result.spring_constant_n_per_m());
  const physics::Temperature temperature(*in[LeverInput::Temperature]);
  FreeNoise noise{physics::thermal_deflection(k, temperature), physics::thermal_force(k, temperature), {}, {}};
  if (!in[LeverInput::Resonance] || !in[LeverInput::QualityFactor]) return noise;
  const physics::LeverDynamics lever{physics::Frequency(*in[LeverInput::Resonance]), *in[LeverInput::QualityFactor],
                                     temperature};
  noise.force_density_n_per_root_hz = std::sqrt(physics::thermal_force_spectrum(k, lever).si);
  if (options.bandwidth_hz) {
    noise.deflection_below = physics::thermal_deflection_below(physics::Frequency(*options.bandwidth_hz), k, lever);
  }
  return noise;
}

void noise_lines(const LeverOptions& options, const LeverCalibration& result, LeverLines& lines) {
  const FreeNoise noise = noise_of(options, result);
  lines.title("thermal noise of the free lever");
  lines.line("deflection, rms", format_quantity(noise.deflection, physics::kLengthUnits, 3));
  lines.line("force, rms", format_quantity(noise.force, physics::kForceUnits, 3));
  if (noise.force_density_n_per_root_hz) {
    lines.line(
        "force density",
        format_quantity(physics::Force(*noise.force_density_n_per_root_hz), physics::kForceUnits, 3) + "/sqrt(Hz)");
  }
  if (noise.deflection_below) {
    lines.line("below " + frequency_text(*options.bandwidth_hz),
               format_quantity(*noise.deflection_below, physics::kLengthUnits, 3));
  }
}

LeverJson json_of(const std::optional<double>& value) { return value ? LeverJson(*value) : LeverJson(); }
LeverJson finite(double value) { return std::isfinite(value) ? LeverJson(value) : LeverJson(); }
LeverJson json_of(const fits::Interval& interval) { return {interval.low, interval.high}; }

LeverJson json_of(const LeverOptions& options, const LeverInputs& in, const CalibratedConstant& constant) {
  LeverJson json{{"spring_constant_N_per_m", constant.k_n_per_m},
                 {"relative_uncertainty_of_inputs",
                  options.uncertainties.empty() ? LeverJson() : LeverJson(constant.relative_uncertainty)}};
  json["along_the_normal_N_per_m"] =
      in[LeverInput::Tilt]
          ? LeverJson(physics::tilted_spring_constant(physics::Stiffness(constant.k_n_per_m), *in[LeverInput::Tilt]).si)
          : LeverJson();
  return json;
}

LeverJson spectrum_json(const LeverOptions& options, const LeverCalibration& result) {
  const fits::ThermalFit& fit = *result.fit;
  const std::string squared = result.spectrum->in_volts ? "V2" : "m2";
  LeverJson json{{"points", fit.points},
                 {"from_Hz", fit.low_hz},
                 {"to_Hz", fit.high_hz},
                 {"mode", options.mode},
                 {"resonance_Hz", fit.oscillator.resonance_hz},
                 {"resonance_95_percent_Hz", json_of(fit.resonance_hz)},
                 {"quality_factor", fit.oscillator.quality_factor},
                 {"quality_factor_95_percent", json_of(fit.quality_factor)},
                 {"area_" + squared, fit.oscillator.area},
                 {"area_95_percent_" + squared, json_of(fit.area)},
                 {"area_relative_deviation", fit.area_deviation},
                 {"floor_" + squared + "_per_Hz", fit.oscillator.floor},
                 {"floor_95_percent_" + squared + "_per_Hz", json_of(fit.floor)},
                 {"averages", finite(fit.averages)},
                 {"averages_by_scatter", json_of(fit.seen_averages)},
                 {"neighbour_factor", fit.neighbour_factor},
                 {"doubts", LeverJson::array()}};
  for (const fits::FoundInSpectrum& found : fit.doubts) {
    json["doubts"].push_back({{"reason", fits::kSpectrumDoubts.at(static_cast<std::size_t>(found.doubt)).name},
                              {"figure", finite(found.figure)},
                              {"limit", found.limit}});
  }
  return json;
}

LeverJson thermal_json(const LeverOptions& options, const LeverCalibration& result) {
  const ThermalConstant& thermal = *result.thermal;
  LeverJson json = json_of(options, result.inputs, thermal.corrected);
  json["spring_constant_95_percent_N_per_m"] = json_of(thermal.interval_n_per_m);
  json["uncorrected_N_per_m"] = thermal.uncorrected_n_per_m;
  json["correction"] = *result.inputs[LeverInput::ModeFactor];
  const bool given = options.inputs[LeverInput::ModeFactor].has_value();
  json["mode_share"] = given ? LeverJson() : LeverJson(physics::thermal_share(options.mode));
  json["chi"] = given ? LeverJson() : LeverJson(physics::optical_lever_ratio(options.mode));
  json["error_without_floor"] = thermal.floor_bias;
  json["relative_uncertainty_of_forces_by_sensitivity"] = thermal.force_by_sensitivity;
  return json;
}

}  // namespace

std::string lever_text(const LeverOptions& options, const LeverCalibration& result) {
  LeverLines lines;
  const LeverInputs& in = result.inputs;
  if (result.fit) spectrum_lines(options, result, lines);
  if (result.sensitivity) {
    const SensitivityFound& sensitivity = *result.sensitivity;
    lines.title(sensitivity.without_contact ? "sensitivity by the thermal noise and the spring constant"
                : !options.curve.empty()    ? "sensitivity by the contact slope of " + options.curve
                                            : "sensitivity");
    lines.line("sensitivity", sensitivity_text(sensitivity.measured_m_per_v));
    if (sensitivity.corrected_m_per_v) {
      lines.line("  of a rigid contact", sensitivity_text(*sensitivity.corrected_m_per_v));
      const double over = sensitivity.measured_m_per_v / *sensitivity.corrected_m_per_v;
      lines.note(
          fmt::format("the measured one is {:.4g} times that; forces with it and its k would be {:.4g} times the true",
                      over, 1.0 / over));
    }
  }
  if (result.thermal) thermal_lines(options, result, lines);
  if (result.sader) {
    lines.title("spring constant by Sader's method");
    lines.line("spring constant k", stiffness_text(result.sader->k_n_per_m));
    constant_lines(options, in, *result.sader, lines);
    for (const std::string& doubt : sader_doubts(in)) lines.note("doubtful: " + doubt);
  }
  if (result.gci) {
    lines.title("spring constant by the Global Calibration Initiative, A Q f^1.3");
    lines.line("spring constant k", stiffness_text(result.gci->k_n_per_m));
    constant_lines(options, in, *result.gci, lines);
  }
  if (result.spring_constant_n_per_m()) noise_lines(options, result, lines);
  return lines.text();
}

LeverJson lever_json(const LeverOptions& options, const LeverCalibration& result) {
  LeverJson json;
  core::name_software(json);
  json["temperature_K"] = json_of(result.inputs[LeverInput::Temperature]);
  json["spectrum"] = result.fit ? spectrum_json(options, result) : LeverJson();
  json["sensitivity_m_per_V"] = result.sensitivity ? LeverJson(result.sensitivity->measured_m_per_v) : LeverJson();
  json["sensitivity_of_a_rigid_contact_m_per_V"] =
      result.sensitivity ? json_of(result.sensitivity->corrected_m_per_v) : LeverJson();
  json["thermal"] = result.thermal ? thermal_json(options, result) : LeverJson();
  json["sader"] = result.sader ? json_of(options, result.inputs, *result.sader) : LeverJson();
  if (result.sader) json["sader"]["doubts"] = sader_doubts(result.inputs);
  json["gci"] = result.gci ? json_of(options, result.inputs, *result.gci) : LeverJson();
  json["noise"] = LeverJson();
  if (!result.spring_constant_n_per_m()) return json;
  const FreeNoise noise = noise_of(options, result);
  json["noise"] = {
      {"deflection_m", noise.deflection.si},
      {"force_N", noise.force.si},
      {"force_density_N_per_root_Hz", json_of(noise.force_density_n_per_root_hz)},
      {"deflection_below_bandwidth_m", noise.deflection_below ? LeverJson(noise.deflection_below->si) : LeverJson()}};
  return json;
}

SvgPlot lever_plot(const LeverCalibration& result) {
  constexpr double kHzPerKhz = 1e3;
  const bool volts = result.spectrum->in_volts;
  const double squared = volts ? 1.0 : 1e18;
  SvgLine measured{"measured", std::string(distinct_color(0)), LineStyle::Solid, {}};
  SvgLine model{"oscillator and floor", std::string(distinct_color(1)), LineStyle::Solid, {}};
  for (const SpectrumRow& row : result.spectrum->rows) {
    measured.points.push_back({row.frequency_hz / kHzPerKhz, row.density * squared});
    model.points.push_back(
        {row.frequency_hz / kHzPerKhz, fits::density_at(result.fit->oscillator, row.frequency_hz) * squared});
  }
  SvgPlot plot;
  plot.title = "Thermal noise of the free lever";
  plot.x_label = "frequency (kHz)";
  plot.y_label = volts ? "power density (V^2/Hz)" : "power density (nm^2/Hz)";
  plot.lines = {std::move(measured), std::move(model)};
  plot.x_scale = plot.y_scale = AxisScale::Logarithmic;
  return plot;
}

}  // namespace afm::curves
