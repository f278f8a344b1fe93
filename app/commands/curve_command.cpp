// SPDX-License-Identifier: Apache-2.0
#include "app/commands/curve_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "app/options/command.h"
#include "app/options/standard_output.h"
#include "core/file_names.h"
#include "core/log.h"
#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/curve_output.h"
#include "curves/curve_report.h"
#include "curves/image_output.h"
#include "curves/plot_units.h"
#include "curves/sweep.h"
#include "curves/tapping/tapping_sweep.h"
#include "physics/quantity_text.h"

namespace afm::app {
namespace {

using core::wrong_usage;

constexpr std::array kOwnFormats{"csv", "json", "svg"};  // formats of this command; the others are those of curve files

std::vector<std::string> file_format_words() {
  std::vector<std::string> words;
  for (const curves::WritableFormat& row : curves::writable_formats()) words.emplace_back(row.word);
  return words;
}

// The words after --format.
std::vector<std::string> format_words() {
  std::vector<std::string> words(kOwnFormats.begin(), kOwnFormats.end());
  for (std::string& word : file_format_words()) words.push_back(std::move(word));
  return words;
}

std::optional<curves::WritableFormat> file_format_of(std::string_view word) {
  for (const curves::WritableFormat& row : curves::writable_formats()) {
    if (row.word == word) return row;
  }
  return std::nullopt;
}

// Refuses the name of an image, and the replacement of a curve by something else.
core::Result<void> check_out(const CurveOptions& options, std::string_view format) {
  const std::string& out = options.out;
  if (options.format.empty() && format == "csv" && core::is_named_as_another(out, ".csv")) {
    return wrong_usage(fmt::format(
        "--out {}: a curve is written in no such format; name one that ends in .csv, .json, .svg, .tab or .h5", out));
  }
  if (curves::image_format(out)) {
    return wrong_usage(fmt::format(
        "--out {}: this is a name for an image; take one that ends in .csv, .json, .svg, .tab or .h5", out));
  }
  if ((format == "svg" || format == "json") && curves::is_curve_file(out)) {
    return wrong_usage(fmt::format("--out {}: it is a curve, which would be lost; name a new file", out));
  }
  return {};
}

core::Result<std::string> output_format(const CurveOptions& options) {
  if (options.json && !options.format.empty() && options.format != "json") {
    return wrong_usage(fmt::format("--json and --format {} exclude each other; remove one", options.format));
  }
  if (options.json) return "json";
  if (!options.format.empty()) return options.format;
  std::string name(options.out);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  for (const std::string& word : format_words()) {
    if (name.ends_with("." + word)) return word;
  }
  return "csv";
}

core::Result<void> write_text(const std::string& text, const std::string& path) {
  return path.empty() ? write_stdout(text) : core::write_file(path, text);
}

// Puts the measured curve on the model, with both contact points together and its baseline at zero force, because an
// instrument's zero is not a property of the contact.
core::Result<void> add_overlay(const std::string& file, const curves::CurveRun& run, curves::SvgPlot& plot) {
  auto recorded = curves::load_curve(file);
  if (!recorded) return tl::unexpected(recorded.error());
  const auto measured = curves::analysed("measured", std::move(*recorded));
  if (!measured) return tl::unexpected(measured.error());
  if (!measured->features.contact_point) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("--overlay {}: the curve has no contact point to align with the model's", file));
  }
  const auto model = physics::analyse(physics::points_of(run.curve.samples), physics::ForceZero::True);
  const physics::Length model_contact = model.contact_point.value_or(physics::Length());
  for (curves::SvgLine& line : curves::curve_lines(*measured, std::string(curves::distinct_color(1)))) {
    for (auto& point : line.points) point.x += model_contact.si * curves::kNmPerM;
    plot.lines.push_back(std::move(line));
  }
  const physics::CurveFeatures& found = measured->features;
  core::log_line(
      fmt::format("{} is shifted by {} in Z, which aligns its contact point ({}{}) with the model's at {}, and by {} "
                  "in force, which brings its baseline ({} at the far end, tilt {}) to zero",
                  file, physics::format_quantity(model_contact - *found.contact_point, physics::kLengthUnits, 4),
                  physics::name_of(found.contact_method), found.contact_doubtful ? ", doubtful" : "",
                  physics::format_quantity(model_contact, physics::kLengthUnits, 4),
                  physics::format_quantity(-found.baseline.level, physics::kForceUnits, 4),
                  physics::format_quantity(found.baseline.level, physics::kForceUnits, 4),
                  physics::format_quantity(found.baseline.tilt, physics::kStiffnessUnits, 4)));
  return {};
}

core::Result<std::string> curve_text(const CurveOptions& options, const curves::CurveRun& run,
                                     const std::string& format) {
  if (format == "json") return curves::curve_json(run).dump(2) + "\n";
  if (format == "csv") return curves::curve_csv(run);
  if (format == "svg") {
    curves::SvgPlot plot = curves::curve_plot(run);
    if (!options.overlay.empty()) {
      if (const auto added = add_overlay(options.overlay, run, plot); !added) return tl::unexpected(added.error());
    }
    return curves::svg(plot);
  }
  const auto file_format = file_format_of(format);
  if (!file_format) {
    return wrong_usage(fmt::format("unknown format \"{}\"; choose {}", format, fmt::join(format_words(), ", ")));
  }
  return curves::curve_bytes(file_format->format, curves::recorded_curve(run));
}

core::Result<void> write_curve(const CurveOptions& options, const curves::ContactSetup& setup,
                               const std::string& format) {
  if (!options.overlay.empty() && format != "svg") return wrong_usage("--overlay needs a plot; add --format svg");
  const auto file_format = file_format_of(format);
  if (file_format && file_format->binary && options.out.empty()) {
    return wrong_usage(fmt::format("--format {} is binary; name a file with --out", format));
  }
  curves::PathOptions path = options.path;
  path.events_only = format == "json";
  const auto run = curves::run_curve(setup, path);
  if (!run) return tl::unexpected(run.error());
  if (!run->curve.samples.empty() && run->curve.samples.back().phase == physics::Phase::Attached &&
      run->figures.hysteretic) {
    core::log_line("the cycle ends below the pull-off, with the tip still attached; raise --from to close the loop");
  }
  const auto text = curve_text(options, *run, format);
  if (!text) return tl::unexpected(text.error());
  return write_text(*text, options.out);
}

core::Result<void> write_sweep(const CurveOptions& options, const curves::ContactSetup& setup,
                               const std::string& format) {
  if (format != "csv" && format != "json") {
    return wrong_usage(fmt::format("a sweep is written as csv or json, not {}", format));
  }
  if (!options.overlay.empty()) return wrong_usage("--overlay needs a single curve; remove --sweep");
  if (options.sweeps.size() > 2) return wrong_usage("a sweep varies at most two parameters");
  std::vector<curves::SweepAxis> axes;
  for (const std::string& text : options.sweeps) {
    const auto axis = curves::parse_sweep_axis(text, setup.model);
    if (!axis) return wrong_usage("--sweep " + axis.error().message);
    if (!axes.empty() && axes.front().parameter == axis->parameter) {
      return wrong_usage(fmt::format("--sweep {}: this parameter is swept already", axis->parameter->option));
    }
    axes.push_back(*axis);
  }
  const auto rows = curves::run_sweep(setup, axes, options.path);
  if (!rows) return tl::unexpected(rows.error());
  return write_text(
      format == "json" ? curves::sweep_json(setup, axes, *rows).dump(1) + "\n" : curves::sweep_csv(setup, axes, *rows),
      options.out);
}

// Refuses a number that the sweep would replace.
core::Result<void> check_swept(const CurveOptions& options) {
  for (const std::string& sweep : options.sweeps) {
    const std::string name = sweep.substr(0, sweep.find('='));
    const auto value = options.contact.values.find(name);
    const bool given = name == "free-amplitude" ? !options.tapping.numbers.free_amplitude.empty()
                                                : value != options.contact.values.end() && !value->second.empty();
    if (!given) continue;
    return wrong_usage(fmt::format("--sweep {}: --{} is given, too, and has no effect; remove one", sweep, name));
  }
  return {};
}

// Sets each swept value to the sweep's first, so that the user need not give it as well.
curves::ContactOptions with_swept_values(curves::ContactOptions contact, const std::vector<std::string>& sweeps) {
  for (const std::string& sweep : sweeps) {
    const std::size_t equals = sweep.find('='), colon = sweep.find(':');
    if (!contact.material.empty() || equals == std::string::npos || colon == std::string::npos || colon < equals)
      continue;
    if (curves::find_contact_parameter(sweep.substr(0, equals)) == nullptr) continue;
    std::string& value = contact.values[sweep.substr(0, equals)];
    if (value.empty()) value = sweep.substr(equals + 1, colon - equals - 1);
  }
  return contact;
}

// Same for the free amplitude in tapping mode.
CurveOptions with_swept_amplitude(CurveOptions options) {
  for (const std::string& sweep : options.sweeps) {
    if (options.tapping.numbers.free_amplitude.empty()) {
      options.tapping.numbers.free_amplitude = curves::swept_free_amplitude(sweep);
    }
  }
  return options;
}

core::Result<void> write_tapping(const CurveOptions& options, const std::string& format) {
  if (const auto checked = check_tapping_options(options.tapping); !checked) return checked;
  if (!options.overlay.empty()) {
    return wrong_usage(fmt::format("--overlay has no effect on --mode {}; remove it", options.tapping.mode));
  }
  if (!options.sweeps.empty()) {
    if (!options.path.speed.empty()) {
      return wrong_usage("--speed has no effect with --sweep in --mode tapping: the swing is at rest; remove it");
    }
    if (const auto checked = curves::check_path(options.tapping, options.path); !checked) return checked;
  }
  const auto text = options.sweeps.empty()
                        ? tapping_text(options.tapping, options.contact, options.path, format)
                        : tapping_sweep_text(options.tapping, with_swept_values(options.contact, options.sweeps),
                                             options.sweeps, format);
  if (!text) return tl::unexpected(text.error());
  return write_text(*text, options.out);
}

void add_output_options(OptionList& command, CurveOptions& options) {
  command.add_flag("--json", options.json, "print the events in SI units as JSON instead of the samples");
  command
      .add_option("--format", options.format,
                  fmt::format("{}, or for other programs {}; default: from the ending of --out, otherwise csv",
                              fmt::join(kOwnFormats, ", "), fmt::join(file_format_words(), ", ")))
      .one_of(format_words())
      .type_name("FORMAT");
  command
      .add_option("--overlay", options.overlay,
                  "measured curve to draw over the model, with --format svg; its contact point is aligned with the "
                  "model's and its baseline with zero; stderr reports both shifts")
      .type_name("FILE");
  command.add_option("--out", options.out, "write to FILE instead of stdout").writable_file().type_name("FILE");
}

}  // namespace

core::Result<void> write_curve_command(const CurveOptions& options) {
  if (const auto checked = check_swept(options); !checked) return checked;
  const auto format = output_format(options);
  if (!format) return tl::unexpected(format.error());
  if (const auto checked = check_out(options, *format); !checked) return checked;
  if (options.tapping.mode != "contact") return write_tapping(with_swept_amplitude(options), *format);
  if (const auto checked = check_tapping_options(options.tapping); !checked) return tl::unexpected(checked.error());
  const auto setup = contact_setup(with_swept_values(options.contact, options.sweeps));
  if (!setup) return tl::unexpected(setup.error());
  return options.sweeps.empty() ? write_curve(options, *setup, *format) : write_sweep(options, *setup, *format);
}

void add_curve_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "curve", "compute an approach-retract cycle as CSV, JSON events or a file for other programs; or run a sweep");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<CurveOptions>();
  command
      .add_option("--material", options->contact.material,
                  "a name that touchafm material lists; without it, give every parameter that the model needs")
      .type_name("MATERIAL");
  add_contact_options(command, options->contact, context);
  add_tapping_options(command, options->tapping);
  const Option from =
      command
          .add_option("--from", options->path.from,
                      "start and end, above the snap-in, in m, mm, um, nm or pm; default: 10 % above the pull-off")
          .type_name("LENGTH");
  const Option to = command
                        .add_option("--to", options->path.to,
                                    "turning point, below --from, in m, mm, um, nm or pm; default: -5nm, or deeper if "
                                    "the sample still attracts there")
                        .type_name("LENGTH");
  const Option step = command
                          .add_option("--step", options->path.step,
                                      "distance between samples in m, mm, um, nm or pm; at most 10 million samples; "
                                      "default: 0.01nm, or 1/20000 of a longer path")
                          .type_name("LENGTH");
  command
      .add_option(
          "--speed", options->path.speed,
          "speed of the base: m/s, mm/s, um/s; dynamic models: 1um/s by default; tapping: by default at rest at "
          "each height")
      .type_name("VELOCITY");
  command
      .add_option("--seed", options->path.seed,
                  "seed of the thermal noise of dynamic models; the same seed gives the same curve")
      .type_name("NUMBER");
  command
      .add_option("--sweep", options->sweeps,
                  "key=from:to:count computes the events of one cycle for each value of a parameter (its option "
                  "without the dashes); append :log for equal ratios; repeat for a grid; at most a million points; "
                  "tapping: the regimes, also over free-amplitude and the height z")
      .excludes(from)
      .excludes(to)
      .excludes(step)
      .one_value_each()
      .type_name("KEY=RANGE");
  add_output_options(command, *options);
  command.footer(
      "Each parameter overrides that of the material or the probe.\n"
      "example: touchafm curve --material mica --spring-constant 0.2N/m --from 20nm --to -5nm --out mica.csv\n"
      "example: touchafm curve --mode tapping --free-amplitude 20nm --resonance 300kHz --quality-factor 400 "
      "--model dmt --spring-constant 40N/m --tip-radius 20nm --hamaker 64zJ --contact-gap 0.165nm --reduced-modulus "
      "1.5GPa --json\n"
      "example: touchafm curve --mode tapping --sweep free-amplitude=5nm:40nm:36 --sweep z=2nm:42nm:41 --resonance "
      "300kHz --quality-factor 400 --model dmt --spring-constant 40N/m --tip-radius 20nm --hamaker 64zJ --contact-gap "
      "0.165nm --reduced-modulus 1.5GPa --out map.svg\n"
      "example: touchafm curve --material pdms-air --sweep spring-constant=0.01N/m:100N/m:50:log --out sweep.csv");
  command.when_chosen([options] { return write_curve_command(*options); });
}

}  // namespace afm::app
