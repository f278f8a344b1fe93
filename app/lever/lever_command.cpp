// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/options/command.h"
#include "app/options/curve_fit_options.h"
#include "app/options/enum_option.h"
#include "app/options/quantity_option.h"
#include "app/options/standard_output.h"
#include "app/options/uncertainty_option.h"
#include "core/json_text.h"
#include "core/whole_file.h"
#include "curves/lever/lever_calibration.h"
#include "curves/lever/lever_output.h"
#include "curves/uncertainty_text.h"

namespace afm::app {

namespace {

using core::wrong_usage;

using curves::LeverInput;
using curves::LeverInputRow;
using curves::LeverInputs;
using curves::LeverOptions;

constexpr QuantityRange<physics::Frequency> kBandwidths{physics::Frequency(LeverOptions::kLeastBandwidthHz),
                                                        physics::Frequency(LeverOptions::kMostBandwidthHz)};

// Options of the command beyond those of a calibration.
struct LeverCommand {
  LeverOptions lever;
  std::vector<std::string> uncertainty_texts;  // "sensitivity=3%"
  bool json = false;
  std::string out;
};

core::Result<void> read_range(const std::string& text, LeverOptions& options) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return wrong_usage(fmt::format("\"{}\" is not a range, such as 5kHz:20kHz", text));
  const auto low = physics::parse_quantity(std::string_view(text).substr(0, colon), physics::kFrequencyUnits);
  const auto high = physics::parse_quantity(std::string_view(text).substr(colon + 1), physics::kFrequencyUnits);
  if (!low.value) return wrong_usage(low.error);
  if (!high.value) return wrong_usage(high.error);
  if (!(low.value->si >= 0.0 && low.value->si < high.value->si)) {
    return wrong_usage(fmt::format("{} does not go up from a frequency to a higher one", text));
  }
  options.low_hz = low.value->si;
  options.high_hz = high.value->si;
  return {};
}

// True for inputs that can have an uncertainty. The tilt is no part of k, and a known k has no calibration.
bool may_be_uncertain(LeverInput input) { return input != LeverInput::Tilt && input != LeverInput::SpringConstant; }

std::string uncertain_names() {
  std::string names;
  for (const LeverInputRow& row : curves::kLeverInputs) {
    if (may_be_uncertain(row.input)) names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  return names;
}

core::Result<void> read_uncertainties(const std::vector<std::string>& texts, LeverOptions& options) {
  std::vector<curves::UncertainKey> keys;
  std::vector<LeverInput> inputs;
  for (const LeverInputRow& row : curves::kLeverInputs) {
    if (!may_be_uncertain(row.input)) continue;
    keys.push_back({row.name, row.units.units});
    inputs.push_back(row.input);
  }
  const auto parsed = curves::parse_uncertainties(texts, keys);
  if (!parsed) return tl::unexpected(parsed.error());
  for (const curves::KeyUncertainty& each : *parsed) {
    options.uncertainties.push_back({inputs[each.key], each.value, each.is_share});
  }
  return {};
}

// Adds the options of the table of inputs.
void add_inputs(OptionList& command, const Option& thermal, const Option& sader, LeverInputs& inputs) {
  for (const LeverInputRow& row : curves::kLeverInputs) {
    if (row.help.empty()) continue;
    Option added = si_option(
        command, fmt::format("--{}", row.name), [&inputs, input = row.input](double si) { inputs[input] = si; },
        {row.units.sort, row.units.units, row.range},
        row.of.empty() ? std::string(row.help) : fmt::format("with {}: {}", row.of, row.help));
    if (row.of == "--thermal") added.needs(thermal);
    if (row.of == "--sader") added.needs(sader);
  }
}

Option add_thermal_options(OptionList& command, LeverOptions& options) {
  Option thermal = command
                       .add_option("--thermal", options.thermal,
                                   "text file with the power spectrum of the free lever: frequency and density, with "
                                   "their units in a heading, such as Hz and V2/Hz, nm2/Hz or V/sqrt(Hz)")
                       .type_name("FILE");
  command
      .add_option("--units", options.reading.units,
                  "with --thermal: units of frequency and density instead of the heading's")
      .needs(thermal)
      .type_name("UNITS such as \"kHz, V2/Hz\"");
  command
      .add_option("--column", options.reading.column,
                  "with --thermal: column of the density; the first holds the frequency")
      .needs(thermal)
      .within(2, static_cast<int>(curves::kMostSpectrumColumns))
      .show_default();
  command
      .add_parsed_option(
          "--range", [&options](const std::string& text) { return read_range(text, options); },
          "with --thermal: frequencies to fit, around one resonance, such as 5kHz:20kHz; default: all")
      .needs(thermal)
      .type_name("RANGE");
  command
      .add_option("--averages", options.averages,
                  "with --thermal: number of averaged spectra; default: from their scatter")
      .needs(thermal)
      .within(LeverOptions::kLeastAverages, LeverOptions::kMostAverages);
  command.add_option("--mode", options.mode, "with --thermal: flexural mode of the resonance")
      .needs(thermal)
      .within(1, LeverOptions::kHighestMode)
      .show_default();
  return thermal;
}

core::Result<void> calibrate_lever(LeverCommand command) {
  LeverOptions& options = command.lever;
  if (const auto read = read_uncertainties(command.uncertainty_texts, options); !read) return read;
  const auto result = curves::calibrate(options);
  if (!result) return tl::unexpected(result.error());
  if (!command.out.empty()) {
    curves::SvgPlot plot = curves::lever_plot(*result);
    plot.about = curves::lever_text(options, *result);
    if (const auto written = core::write_file(command.out, curves::svg(plot)); !written) return written;
  }
  return command.json ? write_stdout(core::json_text(curves::lever_json(options, *result), 2) + "\n")
                      : write_report(curves::lever_text(options, *result));
}

}  // namespace

void add_lever_command(OptionList& program, const CommandContext&) {
  OptionList command =
      program.add_command("lever", "calibrate a lever: spring constant by thermal noise, Sader or GCI, sensitivity");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<LeverCommand>();
  LeverOptions& lever = options->lever;
  const Option thermal = add_thermal_options(command, lever);
  const Option sader =
      command.add_flag("--sader", lever.sader, "spring constant of a rectangular lever by Sader's method");
  enum_option(command, "--fluid", lever.fluid, "a fluid", curves::kFluids, &curves::FluidRow::name,
              &curves::FluidRow::fluid, "with --sader: fluid around the lever, at 25 degrees Celsius; default: air")
      .needs(sader);
  add_inputs(command, thermal, sader, lever.inputs);
  const Option curve =
      command
          .add_option(
              "--sensitivity-from", lever.curve,
              "force curve on a hard sample, whose contact slope gives the sensitivity instead of --sensitivity")
          .type_name("FILE");
  command.add_option("--curve", lever.curve_reading.index, "number of the curve in an .h5 file, from 0")
      .needs(curve)
      .show_default()
      .type_name("INDEX");
  add_columns_option(command, lever.curve_reading).option.needs(curve);
  quantity_option(
      command, "--bandwidth", [&lever](physics::Frequency hz) { lever.bandwidth_hz = hz.si; }, physics::kFrequencyUnits,
      "also print the thermal noise below this frequency", std::optional(kBandwidths));
  uncertainty_option(
      command, options->uncertainty_texts, "sensitivity=3% or temperature=1K",
      "standard uncertainty of an input, in per cent or in its unit: " + uncertain_names() + "; one option for each");
  command.add_flag("--json", options->json, "print JSON in SI units; null marks a value that was not computed");
  command.add_option("--out", options->out, "write a plot of spectrum and model (SVG) to FILE")
      .picture_file(".svg")
      .needs(thermal)
      .type_name("FILE");
  command.footer(
      "docs/lever.md has the equations and their limits.\n"
      "example: touchafm lever --thermal spectrum.txt --sensitivity 60nm/V --range 5kHz:20kHz --out spectrum.svg\n"
      "         touchafm lever --thermal spectrum.txt --sensitivity-from glass.jpk-force --uncertainty sensitivity=3%\n"
      "         touchafm lever --sader --length 120um --width 30um --resonance 70kHz --quality-factor 150\n"
      "         touchafm lever --thermal spectrum.txt --sader --length 120um --width 30um");
  command.when_chosen([options] { return calibrate_lever(*options); });
}

}  // namespace afm::app
