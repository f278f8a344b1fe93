// SPDX-License-Identifier: Apache-2.0
#include "app/commands/scan_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "app/options/command.h"
#include "app/options/enum_option.h"
#include "app/options/levelling_option.h"
#include "app/options/quantity_option.h"
#include "app/options/standard_output.h"
#include "core/log.h"
#include "core/version.h"
#include "core/whole_file.h"
#include "curves/angle_units.h"
#include "curves/image_file.h"
#include "curves/image_output.h"
#include "exhibit/scan/image_picture.h"
#include "physics/imaging/scan_artefact.h"
#include "physics/imaging/scan_truth.h"
#include "render/image_file.h"

namespace afm::app {
namespace {

using core::wrong_usage;
using physics::ScanImage;

constexpr int kFewestPixels = 2;
constexpr const char* kNoMaterial =
    "--material is required, such as mica or gold; or name a sample of your own with --sample";
constexpr std::size_t kManyLines = 1024;  // scans with at least this many lines take seconds and report progress

struct DirectionName {
  const char* name;
  physics::SlowDirection direction;
};
constexpr std::array kDirections{DirectionName{"down", physics::SlowDirection::Down},
                                 DirectionName{"up", physics::SlowDirection::Up}};

// An image, its settings, and the lines with each detected artefact.
struct Scan {
  ScanImage image;
  physics::ScanSettings settings;
  std::map<physics::ScanArtefact, std::size_t> lines_with;
  double time_s = 0;
  physics::Scanner::Surface surface{};
};

physics::ScanSettings settings_of(const ScanOptions& options, const curves::ContactSetup& setup,
                                  const exhibit::ScanSurface& surface) {
  physics::ScanSettings settings;
  settings.spring_constant = setup.material.contact.spring_constant;
  settings.adhesion = physics::Force(surface.pull_off_force_n);
  settings.snap_in = physics::Length(surface.snap_in_m);
  settings.feedback = options.feedback;
  for (const auto& [field, si] : options.settings) field->set(settings, si);
  return settings;
}

physics::TipShape tip_of(const ScanOptions& options, const curves::ContactSetup& setup,
                         const physics::ScanSettings& settings) {
  physics::TipShape tip = options.tip;
  tip.radius = setup.material.contact.tip_radius;
  tip.second_apex_distance = settings.second_apex_distance;
  tip.second_apex_height = settings.second_apex_height;
  return tip;
}

std::string words(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

void describe(const ScanOptions& options, const curves::ContactSetup& setup, const physics::TipShape& tip, Scan& scan) {
  auto& metadata = scan.image.metadata;
  metadata.emplace_back("Material", setup.material.name);
  if (!options.sample.file.empty()) {
    metadata.emplace_back("Sample", std::filesystem::path(options.sample.file).filename().string());
    metadata.emplace_back("Levelling", physics::text_of(options.sample.reading.levelling).word);
  }
  metadata.emplace_back("Model", setup.used_model());
  metadata.emplace_back("Tip", physics::name_of(tip.kind));
  metadata.emplace_back("Tip radius", physics::format_quantity(tip.radius, physics::kLengthUnits));
  if (tip.kind != physics::TipKind::Paraboloid && tip.kind != physics::TipKind::Sphere) {
    metadata.emplace_back("Tip half angle", physics::format_si(tip.half_angle_rad, curves::kAngleUnits.units));
  }
  for (const physics::ScanField& field : physics::kScanFields) {
    metadata.emplace_back(words(field.name), field.text(field.get(scan.settings)));
  }
  metadata.emplace_back("Feedback", scan.settings.feedback == physics::Feedback::On ? "on" : "off");
  metadata.emplace_back("Slow direction", options.direction == physics::SlowDirection::Down ? "down" : "up");
  metadata.emplace_back("Seed", std::to_string(options.seed));
}

core::Result<Scan> take_scan(const ScanOptions& options) {
  const auto setup = contact_setup(options.contact);
  if (!setup) return tl::unexpected(setup.error());
  const auto surface =
      exhibit::scan_surface(*setup, tip_of(options, *setup, {}), options.contact.assets_dir, options.sample);
  if (!surface) return tl::unexpected(surface.error());

  Scan scan;
  scan.settings = settings_of(options, *setup, *surface);
  scan.surface = surface->height_m;
  physics::ScanArea area;
  const double drawn_m = std::min(surface->width_m, surface->depth_m);
  area.width = area.height = options.size.si > 0.0 ? options.size : physics::Length(drawn_m);
  area.x_centre = options.x_centre;
  area.y_centre = options.y_centre;
  area.columns = area.rows = options.pixels;
  if (area.width.si > drawn_m * (1.0 + 1e-9)) {
    core::log_line(fmt::format("the sample {} is {} wide; beyond its rim the image is level, as it is felt there",
                               options.sample.file.empty() ? "of " + setup->material.name : options.sample.file,
                               physics::format_quantity(physics::Length(drawn_m), physics::kLengthUnits, 3)));
  }
  try {
    physics::Scanner scanner(area, scan.settings, surface->height_m, options.seed);
    scanner.begin_frame(options.direction);
    std::size_t lines = 0;
    physics::NewestLines newest;
    scan.image = physics::scan_frame(scanner, [&](const physics::ScanLine& line) {
      newest.add(line, scanner.time().si);
      ++scan.lines_with[physics::main_artefact({scan.settings, area, scanner.loop().largest_integral_gain()},
                                               newest.evidence())];
      ++lines;
      if (area.rows >= kManyLines && lines % (area.rows / 8) == 0 && lines < area.rows) {
        core::log_line(fmt::format("scanned {} of {} lines", lines, area.rows));
      }
      return true;
    });
    scan.time_s = scanner.time().si;
  } catch (const physics::UnphysicalValue& error) {
    return wrong_usage(error.what());
  }
  const physics::TipShape tip = tip_of(options, *setup, scan.settings);
  describe(options, *setup, tip, scan);
  if (options.show_truth) physics::add_truth(tip, physics::noise_of_height(scan.settings), scan.image);
  return scan;
}

nlohmann::json json_of(const physics::ImageChannel& channel) {
  const auto count = static_cast<double>(channel.values.size());
  double mean = 0.0, square = 0.0;
  for (const double value : channel.values) mean += value / count;
  for (const double value : channel.values) square += (value - mean) * (value - mean) / count;
  const auto [least, most] = std::minmax_element(channel.values.begin(), channel.values.end());
  return {{"name", channel.name},     {"unit", channel.unit}, {"mean", mean},
          {"rms", std::sqrt(square)}, {"min", *least},        {"max", *most}};
}

nlohmann::json json_of(const Scan& scan) {
  nlohmann::json settings, channels = nlohmann::json::array(), artefacts = nlohmann::json::object(), metadata;
  for (const physics::ScanField& field : physics::kScanFields) {
    settings[std::string(field.json_key)] = field.get(scan.settings);
  }
  settings["feedback"] = scan.settings.feedback == physics::Feedback::On;
  for (const physics::ImageChannel& channel : scan.image.channels) channels.push_back(json_of(channel));
  for (const auto& [artefact, lines] : scan.lines_with) artefacts[std::string(physics::name_of(artefact))] = lines;
  for (const auto& [key, value] : scan.image.metadata) metadata[key] = value;
  return nlohmann::json{{"columns", scan.image.columns},
                        {"rows", scan.image.rows},
                        {"width_m", scan.image.width_m},
                        {"height_m", scan.image.height_m},
                        {"x_offset_m", scan.image.x_offset_m},
                        {"y_offset_m", scan.image.y_offset_m},
                        {"time_s", scan.time_s},
                        {"settings", settings},
                        {"metadata", metadata},
                        {"channels", channels},
                        {"lines_with", artefacts}};
}

// The same grid without artefacts: at time zero, so that drift is one.
ScanImage true_image_of(const Scan& scan) {
  ScanImage image(scan.image);
  image.channels = {{"Height without artefacts", "m", {}}};
  for (std::size_t row = 0; row < image.rows; ++row) {
    const double y_m =
        image.y_offset_m - (static_cast<double>(row) + 0.5) * image.height_m / static_cast<double>(image.rows);
    for (std::size_t column = 0; column < image.columns; ++column) {
      const double x_m =
          image.x_offset_m + (static_cast<double>(column) + 0.5) * image.width_m / static_cast<double>(image.columns);
      image.channels.front().values.push_back(scan.surface(x_m, y_m));
    }
  }
  return image;
}

core::Result<void> keep_channel(const std::string& name, ScanImage& image) {
  const auto chosen = std::find_if(image.channels.begin(), image.channels.end(),
                                   [&](const physics::ImageChannel& channel) { return channel.name == name; });
  if (chosen == image.channels.end()) {
    std::string names;
    for (const physics::ImageChannel& channel : image.channels) names += (names.empty() ? "" : ", ") + channel.name;
    return wrong_usage(fmt::format("--channel {}: the image has no such channel; choose {}", name, names));
  }
  image.channels = {*chosen};
  return {};
}

core::Result<void> check(const ScanOptions& options) {
  if (options.contact.material.empty()) {
    return wrong_usage(kNoMaterial);
  }
  if (options.out.empty() && options.picture.empty() && !options.json) {
    return wrong_usage("the image would be lost; name a file with --out, or add --json for its figures");
  }
  if (!options.out.empty() && !curves::image_format(options.out)) {
    return wrong_usage(fmt::format("--out {}: name a file that ends in .gwy or .gsf", options.out));
  }
  if (!options.picture.empty() && !options.picture.ends_with(".png")) {
    return wrong_usage(fmt::format("--picture {}: name a file that ends in .png", options.picture));
  }
  return {};
}

}  // namespace

core::Result<void> write_scan_command(const ScanOptions& options) {
  if (const auto checked = check(options); !checked) return checked;
  auto scan = take_scan(options);
  if (!scan) return tl::unexpected(scan.error());
  if (!options.channel.empty()) {
    if (const auto kept = keep_channel(options.channel, scan->image); !kept) return kept;
  }
  if (!options.picture.empty()) {
    const auto written = render::write_png(exhibit::picture_of(scan->image, 0), options.picture);
    if (!written) return written;
  }
  if (!options.out.empty()) {
    const bool one_channel = curves::image_format(options.out) == curves::ImageFormat::Gsf;
    const auto written =
        core::write_file(options.out, one_channel ? curves::gsf_bytes(scan->image, 0) : curves::gwy_bytes(scan->image));
    if (!written) return written;
  }
  return options.json ? write_stdout(json_of(*scan).dump(2) + "\n") : core::Result<void>{};
}

core::Result<TrueScan> scan_with_truth(const ScanOptions& options) {
  if (options.contact.material.empty()) return wrong_usage(kNoMaterial);
  const auto scan = take_scan(options);
  if (!scan) return tl::unexpected(scan.error());
  nlohmann::json truth = json_of(*scan);
  truth["kind"] = "image";
  truth["software"] = "TouchAFM";
  truth["software_version"] = core::kVersion;
  truth["seed"] = options.seed;
  truth["surface"] = std::filesystem::path(options.out).filename().string() + ".truth.gwy";
  return TrueScan{curves::gwy_bytes(scan->image), curves::gwy_bytes(true_image_of(*scan)), truth.dump(2) + "\n"};
}

namespace {

void add_area_options(OptionList& command, ScanOptions& options) {
  using physics::Length;
  const QuantityRange<Length> sizes{Length(1e-10), Length(1e-4)}, places{Length(-1e-4), Length(1e-4)};
  quantity_option(
      command, "--size", [&options](Length size) { options.size = size; }, physics::kLengthUnits,
      "width and height of the image; default: those of the drawn sample", std::optional(sizes));
  quantity_option(
      command, "--x", [&options](Length x) { options.x_centre = x; }, physics::kLengthUnits,
      "middle of the image, to the right of the sample's; default: 0nm", std::optional(places));
  quantity_option(
      command, "--y", [&options](Length y) { options.y_centre = y; }, physics::kLengthUnits,
      "middle of the image, above the sample's; default: 0nm", std::optional(places));
  command.add_option("--pixels", options.pixels, "pixels a line, and lines; 4096 take half a minute and 1.6 GB")
      .within(kFewestPixels, static_cast<int>(physics::kMostScanPixels))
      .show_default()
      .type_name("NUMBER");
  enum_option(command, "--direction", options.direction, "a direction", kDirections, &DirectionName::name,
              &DirectionName::direction, "where the slow scan goes; default: down");
}

void add_own_sample_options(OptionList& command, ScanOptions& options) {
  Option sample = command.add_option(
      "--sample", options.sample.file,
      fmt::format("scan your own sample at its own size: a glTF model with a node for the role surface, or a measured "
                  "image ({}); without --tip an image is taken as an apex traced it, as it is felt, with --tip as the "
                  "sample itself; the file's first bytes decide",
                  curves::kImageFiles));
  sample.type_name("FILE");
  for (Option& option : add_channel_options(command, options.sample.reading.image.channel,
                                            options.sample.reading.levelling, "--sample-channel")) {
    option.needs(sample);
  }
}

void add_setting_options(OptionList& command, ScanOptions& options) {
  const physics::ScanSettings usual;
  for (const physics::ScanField& field : physics::kScanFields) {
    // already an option of the contact
    if (curves::find_contact_parameter(field.option) != nullptr) continue;
    const bool of_material = field.name == "adhesion" || field.name == "snap_in";
    const QuantityDomain domain{field.units->sort, field.units->units,
                                QuantityRange<double>{field.smallest, field.largest}};
    si_option(
        command, "--" + std::string(field.option),
        [&options, &field](double si) { options.settings.emplace_back(&field, si); }, domain,
        fmt::format("{}; default: {}", field.help, of_material ? "the material's" : field.text(field.get(usual))));
  }
  command.add_flag(
      "--no-feedback", [&options] { options.feedback = physics::Feedback::Off; },
      "keep the z scanner where it engaged, so that the error shows the relief");
}

Option add_tip_options(OptionList& command, ScanOptions& options) {
  const Option tip = enum_option(command, "--tip", options.tip.kind, "a tip", physics::kTipKinds,
                                 &physics::TipKindName::name, &physics::TipKindName::kind,
                                 "shape of the tip; its radius is --tip-radius; default: paraboloid, as it is felt");
  si_option(
      command, "--tip-angle", [&options](double rad) { options.tip.half_angle_rad = rad; },
      {curves::kAngleUnits.sort, curves::kAngleUnits.units,
       QuantityRange<double>{std::numbers::pi / 180.0, std::numbers::pi * 0.45}},
      "half angle of a cone or a pyramid, between axis and face; default: 17.189 deg");
  return tip;
}

void add_output_options(OptionList& command, ScanOptions& options) {
  command.add_flag("--show-truth", options.show_truth,
                   "add what the image reveals: the sample as far as the tip reached it, where that is certain, and "
                   "the tip that the image alone gives away");
  command
      .add_option(
          "--channel", options.channel,
          "write only the channel of this name, such as \"Height\" or \"Error (retrace)\"; default: all; in .gsf, "
          "the height")
      .type_name("NAME");
  command.add_flag("--json", options.json, "print settings and figures of every channel in SI units as JSON");
  command.add_option("--picture", options.picture, "write the height, or the channel, as a picture (PNG) to FILE")
      .writable_file()
      .type_name("FILE");
  command
      .add_option("--out", options.out,
                  "write the image to FILE: .gwy with every channel and all parameters, or .gsf with one channel")
      .writable_file()
      .type_name("FILE");
}

}  // namespace

Option add_scan_options(OptionList& command, ScanOptions& options, const CommandContext& context) {
  command
      .add_option("--material", options.contact.material,
                  "mica, gold or any other of touchafm material; with --sample, it supplies lever, tip and adhesion; "
                  "default there: mica")
      .type_name("MATERIAL");
  add_own_sample_options(command, options);
  add_area_options(command, options);
  add_setting_options(command, options);
  Option tip = add_tip_options(command, options);
  add_contact_options(command, options.contact, context);
  command.add_option("--seed", options.seed, "seed of the noise; the same seed gives the same image")
      .show_default()
      .type_name("NUMBER");
  return tip;
}

void complete(ScanOptions& options, bool tip_is_given) {
  options.sample.is_traced = !tip_is_given;
  if (options.contact.material.empty() && !options.sample.file.empty()) options.contact.material = "mica";
}

void add_scan_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "scan", "take an image of a sample with the virtual microscope, with its artefacts, as .gwy or .gsf");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<ScanOptions>();
  const Option tip = add_scan_options(command, *options, context);
  add_output_options(command, *options);
  command.footer(
      "Lever, tip and adhesion are the material's; each parameter overrides its own.\n"
      "example: touchafm scan --material mica --size 40nm --pixels 256 --rate 2Hz --out image.gwy\n"
      "example: touchafm scan --material gold --rate 20Hz --integral-gain 200/s --picture blurred.png --json\n"
      "example: touchafm scan --sample grating.gwy --tip cone --tip-radius 20nm --rate 1Hz --out image.gwy");
  command.when_chosen([options, tip] {
    complete(*options, tip.given());
    return write_scan_command(*options);
  });
}

}  // namespace afm::app
