// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "curves/lever/lever_calibration.h"
#include "curves/lever/lever_output.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/errors.h"
#include "python/json.h"
#include "python/long_work.h"
#include "python/numbers.h"
#include "python/result_type.h"

namespace afm::python {

namespace {

namespace py = pybind11;
using curves::LeverCalibration;
using curves::LeverOptions;

// touchafm.Lever.
struct Lever {
  LeverOptions options;
  LeverCalibration found;
};

// Spectrum from a file, or as frequencies in Hz and densities in m^2/Hz or V^2/Hz.
using Thermal = std::variant<std::filesystem::path, std::pair<GivenArray, GivenArray>>;

curves::Spectrum spectrum_of(const std::pair<GivenArray, GivenArray>& columns, bool in_volts) {
  const auto& [frequencies, densities] = columns;
  if (frequencies.size() != densities.size() || frequencies.size() == 0) {
    refuse(fmt::format("thermal: {} frequencies and {} densities", frequencies.size(), densities.size()));
  }
  // the same checks as for a file
  std::string text = in_volts ? "Hz V2/Hz\n" : "Hz m2/Hz\n";
  for (py::ssize_t i = 0; i < frequencies.size(); ++i) {
    text += fmt::format("{} {}\n", frequencies.data()[i], densities.data()[i]);
  }
  return value_of(curves::parse_spectrum(text, "thermal"), FaultOf::Data);
}

// ValueError with the name of the argument unless it is left out or within `least` to `most`.
void within(std::string_view name, std::optional<double> given, double least, double most) {
  if (!given || (*given >= least && *given <= most)) return;
  refuse(fmt::format("{}: {:g} is not within {:g} to {:g}; leave it out, or give such a number", name, *given, least,
                     most));
}

// Origin of a failed calibration's fault: given arrays, if it remains without the file of a curve.
FaultOf fault_of(const LeverOptions& options, const core::Error& error) {
  if (!options.spectrum) return FaultOf::File;
  LeverOptions without_curve(options);
  without_curve.curve.clear();
  const auto again = curves::calibrate(without_curve);
  return !again && again.error().message == error.message ? FaultOf::Data : FaultOf::File;
}

void set_inputs(const py::kwargs& given, curves::LeverInputs& inputs) {
  for (const auto& [option, si] : numbers_of(given)) {
    const curves::LeverInputRow* found = nullptr;
    for (const curves::LeverInputRow& row : curves::kLeverInputs) {
      if (row.name == option && !row.help.empty()) found = &row;
    }
    if (found == nullptr) unknown_keyword("lever", keyword_of(option));
    const curves::QuantityDomain domain{found->units.sort, found->units.units, found->range};
    const std::string why = curves::refusal(si, fmt::format("{}", si), domain);
    if (!why.empty()) refuse(fmt::format("--{}: {}", option, why));
    inputs[found->input] = si;
  }
}

Lever make_lever(const std::optional<Thermal>& thermal, const std::string& unit, std::optional<double> low,
                 std::optional<double> high, std::optional<double> averages, int mode, bool sader,
                 const std::optional<std::string>& fluid, const std::optional<std::filesystem::path>& sensitivity_from,
                 std::optional<double> bandwidth, const py::kwargs& given) {
  LeverOptions options;
  if (unit != "m" && unit != "V") refuse(fmt::format("unit: \"{}\" is neither \"m\" nor \"V\"", unit));
  within("mode", mode, 1, LeverOptions::kHighestMode);
  within("averages", averages, LeverOptions::kLeastAverages, LeverOptions::kMostAverages);
  within("bandwidth", bandwidth, LeverOptions::kLeastBandwidthHz, LeverOptions::kMostBandwidthHz);
  if (thermal) {
    options.thermal = "thermal";
    if (const auto* file = std::get_if<std::filesystem::path>(&*thermal)) options.thermal = file->string();
    if (const auto* columns = std::get_if<1>(&*thermal)) options.spectrum = spectrum_of(*columns, unit == "V");
  }
  options.low_hz = low.value_or(options.low_hz);
  options.high_hz = high.value_or(options.high_hz);
  if (!(options.low_hz >= 0.0 && options.low_hz < options.high_hz)) {
    refuse(fmt::format("low, high: {} to {} Hz does not go up from a frequency to a higher one", options.low_hz,
                       options.high_hz));
  }
  options.averages = averages;
  options.mode = mode;
  options.sader = sader;
  if (fluid) {
    for (const curves::FluidRow& row : curves::kFluids) {
      if (row.name == *fluid) options.fluid = row.fluid;
    }
    if (!options.fluid) refuse(fmt::format("unknown fluid \"{}\"; choose air or water", *fluid));
  }
  if (sensitivity_from) options.curve = sensitivity_from->string();
  options.bandwidth_hz = bandwidth;
  set_inputs(given, options.inputs);
  auto found = long_work([options](const std::stop_token&) { return curves::calibrate(options); });
  const FaultOf fault = found ? FaultOf::File : fault_of(options, found.error());
  return {std::move(options), value_of(std::move(found), fault)};
}

}  // namespace

void add_levers(py::module_& module) {
  py::class_<Lever>(module, "Lever", plain_type(), py::is_final(), "A calibrated lever. SI. Immutable.")
      .def_property_readonly(
          "k", [](const Lever& self) { return self.found.spring_constant_n_per_m(); },
          "Spring constant, N/m: by the thermal noise, else Sader's, else GCI's, else the known one; None without.")
      .def_property_readonly(
          "k_interval",
          [](const Lever& self) -> std::optional<std::pair<double, double>> {
            if (!self.found.thermal) return std::nullopt;
            const fits::Interval& interval = self.found.thermal->interval_n_per_m;
            return std::pair(interval.low, interval.high);
          },
          "95 % interval of the thermal spring constant, N/m, by the scatter of the spectrum alone, or None.")
      .def_property_readonly(
          "sensitivity",
          [](const Lever& self) {
            return self.found.sensitivity ? std::optional(self.found.sensitivity->measured_m_per_v) : std::nullopt;
          },
          "Sensitivity of the optical lever, m/V, or None.")
      .def_property_readonly(
          "resonance",
          [](const Lever& self) {
            return self.found.fit ? std::optional(self.found.fit->oscillator.resonance_hz) : std::nullopt;
          },
          "Resonance in the spectrum, Hz, or None.")
      .def_property_readonly(
          "quality_factor",
          [](const Lever& self) {
            return self.found.fit ? std::optional(self.found.fit->oscillator.quality_factor) : std::nullopt;
          },
          "Quality factor in the spectrum, or None.")
      .def(
          "as_dict", [](const Lever& self) { return dict_of(curves::lever_json(self.options, self.found)); },
          "The JSON of touchafm lever --json.")
      .def("__repr__", [](const Lever& self) {
        const auto k = self.found.spring_constant_n_per_m();
        return k ? fmt::format("<touchafm.Lever {:.4g} N/m>", *k) : std::string("<touchafm.Lever>");
      });
  module.def(
      "lever", &make_lever, py::kw_only(), py::arg("thermal") = py::none(), py::arg("unit") = "m",
      py::arg("low") = py::none(), py::arg("high") = py::none(), py::arg("averages") = py::none(), py::arg("mode") = 1,
      py::arg("sader").noconvert() = false, py::arg("fluid") = py::none(), py::arg("sensitivity_from") = py::none(),
      py::arg("bandwidth") = py::none(),
      "Calibrates a lever, as touchafm lever does (docs/lever.md).\n\n"
      "thermal: a file, or arrays of frequencies in Hz and densities, in m^2/Hz or with unit=\"V\" in V^2/Hz;\n"
      "low and high: the part of it to fit, Hz; averages: number of averaged spectra; mode: flexural mode.\n"
      "sader=True, fluid (\"air\" or \"water\"); sensitivity_from: a curve on a hard sample; bandwidth, Hz.\n"
      "Numbers by the names of the command's options, in SI: sensitivity (m/V), contact_stiffness, temperature,\n"
      "mode_factor, spring_constant, length, width, resonance, quality_factor, density, viscosity, gci, tilt.\n"
      "Raises ValueError as the command refuses its options, DataError for a spectrum without a resonance,\n"
      "FileError if it, or the curve, is that of a file.");
}

}  // namespace afm::python
