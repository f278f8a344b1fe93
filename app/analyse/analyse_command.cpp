// SPDX-License-Identifier: Apache-2.0
#include "app/analyse/analyse_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/analyse/analyse_image.h"
#include "app/analyse/fit_batch.h"
#include "app/analyse/fit_options.h"
#include "app/analyse/reading_options.h"
#include "app/options/command.h"
#include "app/options/enum_option.h"
#include "app/options/levelling_option.h"
#include "app/options/quantity_option.h"
#include "app/options/standard_output.h"
#include "core/enumerators.h"
#include "core/file_kind.h"
#include "core/file_names.h"
#include "core/json_text.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/curve_file.h"
#include "curves/curve_report.h"
#include "curves/image_file.h"
#include "curves/table_columns.h"
#include "curves/unread_kinds.h"
#include "physics/friction/friction.h"
#include "physics/quantity_text.h"
#include "servo/session_friction.h"

namespace afm::app {

namespace {

using core::wrong_usage;
core::Result<curves::AnalysedCurve> load_analysed(const std::string& file, const curves::CurveReading& reading,
                                                  std::optional<physics::ContactMethod> method,
                                                  const physics::BaselineChoice& baseline) {
  auto curve = curves::load_curve(file, reading);
  if (!curve) return tl::unexpected(curve.error());
  auto analysed = curves::analysed(file, std::move(*curve), method, baseline);
  if (analysed) analysed->name = std::filesystem::path(file).filename().string();
  return analysed;
}

std::string contact_method_names() {
  std::string names;
  for (const auto& each : physics::kContactMethods) names += (names.empty() ? "" : ", ") + std::string(each.name);
  return names;
}

enum class FileKind { Curve, Image, Session };

// Kinds of file that analyse_curve_file() reads, with their names in help and messages. The first bytes decide the
// kind.
struct FileKindRow {
  FileKind kind;
  const char* word;
  const char* one;   // noun with article, such as "an image"
  const char* many;  // plural, such as "images"
  const char* formats;
  bool (*begins)(const std::string& file);
};

constexpr std::array kFileKinds{
    FileKindRow{FileKind::Curve, "curve", "a curve", "curves", curves::kCurveFiles, curves::is_curve_file},
    FileKindRow{FileKind::Image, "image", "an image", "images", curves::kImageFiles, curves::is_image_file},
    FileKindRow{FileKind::Session, "session", "a session", "sessions", ".afms, for its friction loop",
                servo::is_session_file}};
static_assert(core::has_row_for_each(kFileKinds, &FileKindRow::kind));

std::string known_files() {
  std::string text;
  for (const FileKindRow& row : kFileKinds)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", row.word, row.formats);
  return text;
}

// An Igor file may hold an image or a curve: tries the image first, because its requirements are stricter.
const FileKindRow* row_of(const std::string& file) {
  const auto found =
      std::find_if(kFileKinds.rbegin(), kFileKinds.rend(), [&](const FileKindRow& row) { return row.begins(file); });
  return found != kFileKinds.rend() ? &*found : nullptr;
}

bool is_text(std::string_view bytes) {
  return std::none_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c < ' ' && std::isspace(c) == 0; });
}

core::Result<FileKind> kind_of(const std::string& file) {
  if (const FileKindRow* row = row_of(file)) return row->kind;
  const auto beginning = core::read_beginning(file, core::kFileKindBytes);
  if (!beginning) return tl::unexpected(beginning.error());
  std::error_code unknown;
  const std::string kind = curves::unread_kind_of(*beginning, std::filesystem::file_size(file, unknown));
  const std::string what = !kind.empty() ? kind
                           : is_text(*beginning)
                               ? "of no known kind; a table of numbers needs --columns \"height:um force:nN\""
                               : "of no known kind";
  return core::failure(core::ErrorCategory::BadInputFile,
                       fmt::format("cannot analyse {}: it is {}; known are {}", file, what, known_files()));
}

// An option that applies to only one kind of file.
struct OptionOfKind {
  Option option;
  std::string name;
  FileKind kind;
};

core::Result<void> check_options(const std::string& file, const std::vector<OptionOfKind>& options) {
  const FileKindRow* kind = row_of(file);
  for (const OptionOfKind& row : options) {
    if (kind == nullptr || !row.option.given() || row.kind == kind->kind) continue;
    return wrong_usage(fmt::format("{} is for {}, and {} is {}; leave it out", row.name,
                                   kFileKinds[static_cast<std::size_t>(row.kind)].many, file, kind->one));
  }
  return {};
}

// A fit of several files, or one whose --out is no picture, so that a pattern may match one file.
bool wants_table(const std::vector<std::string>& files, const AnalyseOptions& options) {
  return files.size() > 1 || (options.fit.shape && !options.out.empty() && !core::has_ending(options.out, ".svg"));
}

// True for "fit.png" and "fits.csv", which are not yet folders.
bool looks_like_a_file(const std::string& name) {
  std::error_code none;
  return !std::filesystem::is_directory(name, none) &&
         (core::is_named_as_another(name, ".svg") || core::has_ending(name, ".csv") || core::has_ending(name, ".tsv") ||
          core::has_ending(name, ".txt") || core::has_ending(name, ".json"));
}

core::Result<void> check_batch(const AnalyseOptions& options, const std::vector<OptionOfKind>& of_kind) {
  if (!options.fit.shape) return wrong_usage("several files are for a fit; add --fit SHAPE, or name one file");
  if (options.out.empty()) return wrong_usage("several files need --out FOLDER, for the table of their fits");
  if (core::has_ending(options.out, ".svg")) {
    return wrong_usage(
        fmt::format("--out {}: several files need a folder for their table, not a picture", options.out));
  }
  if (looks_like_a_file(options.out)) {
    return wrong_usage(fmt::format(
        "--out {}: this looks like the name of a file, and a table of fits needs a folder; a picture of one "
        "fit ends in .svg",
        options.out));
  }
  if (options.json) return wrong_usage("--json is for one file; the table has every number");
  if (!options.beside.empty()) return wrong_usage("--beside is for one file; leave it out");
  for (const OptionOfKind& row : of_kind) {
    if (row.option.given() && row.name == std::string_view("--curve")) {
      return wrong_usage(
          "--curve is for one curve, and a table has all of them; leave it out, or name a picture, --out FILE.svg");
    }
    if (row.option.given() && row.kind != FileKind::Curve) {
      return wrong_usage(fmt::format("{} is for {}, and a fit is for curves; leave it out", row.name,
                                     kFileKinds[static_cast<std::size_t>(row.kind)].many));
    }
  }
  return {};
}

// Checks the file of a plot: an older plot is replaced, a measurement never.
core::Result<void> check_plot(const std::string& path) {
  if (core::is_named_as_another(path, ".svg")) {
    return wrong_usage(fmt::format("--out {}: name a file that ends in .svg, which it will be", path));
  }
  if (const auto writable = core::check_writable(path); !writable) {
    return wrong_usage("--out: " + writable.error().message);
  }
  if (row_of(path) == nullptr) return {};
  return wrong_usage(
      fmt::format("--out {}: it is {}, which a plot would replace; name a new file", path, row_of(path)->one));
}

// Parses "0um:1.5um", distances from the outermost point of the approach.
core::Result<physics::WayRange> parse_way_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto from = physics::parse_quantity(text.substr(0, colon), physics::kLengthUnits);
  const auto to =
      physics::parse_quantity(colon == std::string::npos ? "" : text.substr(colon + 1), physics::kLengthUnits);
  if (!from.value || !to.value || from.value->si < 0.0 || *from.value >= *to.value) {
    return wrong_usage(fmt::format("\"{}\" is not a range of distances from the outermost point, such as 0um:1.5um{}",
                                   text, text.find(',') == std::string::npos ? "" : ", with decimal points"));
  }
  return physics::WayRange{*from.value, *to.value};
}

// Adds options that write into `baseline` while the parser lives.
template <class Add>
void add_baseline_options(OptionList& command, physics::BaselineChoice& baseline, const Add& add) {
  add("--baseline",
      enum_option(command, "--baseline", baseline.shape, "a baseline", physics::kBaselineShapes,
                  &physics::BaselineShapeName::name, &physics::BaselineShapeName::shape,
                  "force without contact: a tilted line, a flat one, or a line with waves, the interference of the "
                  "laser; default: tilted"));
  const auto read_range = [&baseline](const std::string& text) -> core::Result<void> {
    const auto range = parse_way_range(text);
    if (!range) return tl::unexpected(range.error());
    baseline.range = *range;
    return {};
  };
  add("--baseline-range",
      command
          .add_parsed_option("--baseline-range", read_range,
                             "part of the approach for the baseline, as distances from its outermost point: 0um:1.5um; "
                             "default: all that stays on one line")
          .type_name("RANGE"));
}

// Adds options that write into `options` while the parser lives.
std::vector<OptionOfKind> add_curve_options(OptionList& command, AnalyseOptions& options) {
  std::vector<OptionOfKind> added;
  const auto for_curves = [&added](const std::string& name, const Option& option) {
    added.push_back({option, name, FileKind::Curve});
  };
  for_curves("--beside", command
                             .add_option("--beside", options.beside,
                                         "second curve to compare with, measured or computed by touchafm curve")
                             .type_name("FILE"));
  for (const NamedOption& of_reading : add_reading_options(command, options.reading)) {
    for_curves(of_reading.name, of_reading.option);
  }
  const auto read_method = [&options](const std::string& text) -> core::Result<void> {
    const auto method = std::find_if(physics::kContactMethods.begin(), physics::kContactMethods.end(),
                                     [&](const auto& each) { return each.name == text; });
    if (method == physics::kContactMethods.end()) {
      return wrong_usage(fmt::format("unknown method \"{}\"; choose {}", text, contact_method_names()));
    }
    options.contact_method = method->method;
    return {};
  };
  for_curves("--contact-point",
             command
                 .add_parsed_option("--contact-point", read_method,
                                    "method that finds the contact point: " + contact_method_names() +
                                        "; default: zero-force if the tip is attracted before contact or the curve is "
                                        "computed, otherwise fit-polynomial")
                 .type_name("METHOD"));
  add_baseline_options(command, options.baseline, for_curves);
  for_curves("--curve",
             command.add_option("--curve", options.reading.index, "number of the curve in a file with several, from 0")
                 .show_default()
                 .type_name("INDEX"));
  for (const NamedOption& of_fit : add_fit_options(command, options.fit)) for_curves(of_fit.name, of_fit.option);
  for_curves("--threads",
             command
                 .add_option("--threads", options.threads,
                             "with --fit and a folder: threads that read and fit; the results do not depend on it; "
                             "default: one for each core")
                 .within(1, 256)
                 .type_name("NUMBER"));
  for_curves("--out", command
                          .add_option("--out", options.out,
                                      "write a plot of the curve (SVG) to FILE; with --fit a name that does not end in "
                                      ".svg is the folder of the "
                                      "table of fits")
                          .written()
                          .type_name("FILE"));
  return added;
}

}  // namespace

core::Result<void> analyse_session(const AnalyseOptions& options) {
  const auto session = servo::load_session(options.file);
  if (!session) return tl::unexpected(session.error());
  const auto loop = servo::friction_loop(*session);
  if (!loop) {
    return core::failure(core::ErrorCategory::Failed,
                         fmt::format("{}: no friction loop; choose a --friction, and rub the tip back and forth while "
                                     "it touches",
                                     options.file));
  }
  using namespace physics;
  if (options.json) {
    nlohmann::json report{
        {"material", session->material},       {"friction", text_of(session->parameters.friction.law).word},
        {"half_width_N", loop->half_width.si}, {"offset_N", loop->offset.si},
        {"slope_N_per_m", loop->slope.si},     {"dissipated_J", loop->dissipated.si}};
    core::name_software(report);
    return write_stdout(core::json_text(report, 2) + "\n");
  }
  return write_report(fmt::format(
      "{}, friction {}: the last complete loop\n"
      "  half width            {}\n"
      "  offset                {}\n"
      "  slope after the turn  {}\n"
      "  energy lost           {}\n",
      session->material, text_of(session->parameters.friction.law).word,
      format_quantity(loop->half_width, kForceUnits, 4), format_quantity(loop->offset, kForceUnits, 4),
      format_quantity(loop->slope, kStiffnessUnits, 4), format_quantity(loop->dissipated, kEnergyUnits, 4)));
}

core::Result<void> analyse_curve_file(const AnalyseOptions& options) {
  const auto kind = options.reading.columns ? core::Result<FileKind>(FileKind::Curve) : kind_of(options.file);
  if (!kind) return tl::unexpected(kind.error());
  if (*kind == FileKind::Session) return analyse_session(options);
  if (*kind == FileKind::Image) {
    return analyse_image_file(options.file, {{.channel = options.channel}, options.levelling}, options.json);
  }
  const auto measured = load_analysed(options.file, options.reading, options.contact_method, options.baseline);
  if (!measured) return tl::unexpected(measured.error());
  std::optional<curves::AnalysedCurve> beside;
  if (!options.beside.empty()) {
    auto other = load_analysed(options.beside, {}, {}, {});
    if (!other) return tl::unexpected(other.error());
    beside = std::move(*other);
  }
  const curves::AnalysedCurve* compared = beside ? &*beside : nullptr;
  std::optional<fits::ElasticFit> fit;
  if (options.fit.shape) {
    auto found = fit_of(*measured, options.fit);
    if (!found) return tl::unexpected(found.error());
    fit = std::move(*found);
  }
  if (!options.out.empty()) {
    curves::SvgPlot plot = curves::features_plot(*measured, compared);
    if (fit) {
      plot.lines.push_back(fit_line(*measured, *fit, options.fit));
      plot.about += fit_text(*fit, options.fit);
    }
    if (const auto written = core::write_file(options.out, curves::svg(plot)); !written) return written;
  }
  if (!options.json) {
    return write_report(curves::features_text(*measured, compared) + (fit ? fit_text(*fit, options.fit) : ""));
  }
  nlohmann::ordered_json result = curves::features_json(*measured, compared);
  if (fit) result["fit"] = fit_json(*fit, options.fit);
  return write_stdout(core::json_text(result, 2) + "\n");
}

void add_analyse_command(OptionList& program, const CommandContext&) {
  OptionList command = program.add_command(
      "analyse", "analyse a measured or computed curve, alone or compared with another, or an image");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<AnalyseOptions>();
  const auto files = std::make_shared<std::vector<std::string>>();
  command.add_option("file", *files, known_files() + "; several files, or a map, for a table: --fit SHAPE --out FOLDER")
      .required()
      .type_name("FILE");
  std::vector<OptionOfKind> of_kind = add_curve_options(command, *options);
  const auto [channel, level] = add_channel_options(command, options->channel, options->levelling);
  of_kind.push_back({channel, "--channel", FileKind::Image});
  of_kind.push_back({level, "--level", FileKind::Image});
  command.add_flag("--json", options->json, "print JSON in SI units; null marks a figure that was not found");
  command.footer(
      "docs/curves.md defines each figure.\n"
      "example: touchafm analyse gold.jpk-force --beside model.csv --out gold.svg\n"
      "         touchafm analyse gel.jpk-force --fit sphere --radius 5um --out gel.svg\n"
      "         touchafm analyse pdms.jpk-force --fit auto --radius 1um --uncertainty radius=10%\n"
      "         touchafm analyse day1/*.jpk-force --fit sphere --radius 5um --out day1-fits\n"
      "         touchafm analyse cell.jpk-qi-data --fit cone --half-angle 18deg --out cell-fits\n"
      "         touchafm analyse table.txt --columns \"height:um force:nN\" --spring-constant 0.1N/m\n"
      "         touchafm analyse mica.spm --channel \"Height Sensor\" --json");
  command.when_chosen([options, files, of_kind = std::move(of_kind)]() -> core::Result<void> {
    options->file = files->front();
    if (const auto checked = prepare(options->fit); !checked) return checked;
    if (wants_table(*files, *options)) {
      if (const auto checked = check_batch(*options, of_kind); !checked) return checked;
      return fit_files(
          *files, *options,
          options->threads > 0 ? static_cast<unsigned>(options->threads) : std::thread::hardware_concurrency());
    }
    if (const auto checked = check_options(options->file, of_kind); !checked) return checked;
    if (options->threads > 0) {
      return wrong_usage("--threads is for a table of fits: add --fit SHAPE --out FOLDER, or leave it out");
    }
    if (!options->out.empty()) {
      if (const auto checked = check_plot(options->out); !checked) return checked;
    }
    return analyse_curve_file(*options);
  });
}

}  // namespace afm::app
