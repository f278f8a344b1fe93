// SPDX-License-Identifier: Apache-2.0
#include "app/commands/scan_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <variant>

#include "app/options/command.h"
#include "app/options/enum_option.h"
#include "app/options/levelling_option.h"
#include "app/options/quantity_option.h"
#include "app/options/standard_output.h"
#include "app/tapping/tapping_command.h"
#include "core/file_names.h"
#include "core/json_text.h"
#include "core/whole_file.h"
#include "core/written_by.h"
#include "curves/angle_units.h"
#include "curves/image_file.h"
#include "curves/image_output.h"
#include "exhibit/scan/image_picture.h"
#include "render/image_file.h"

namespace afm::app {
namespace {

using core::wrong_usage;

core::Result<void> check(const ScanOptions& options) {
  if (const auto checked = imaging::check(options); !checked) return checked;
  if (options.out.empty() && options.picture.empty() && !options.json) {
    return wrong_usage("the image would be lost; name a file with --out, or add --json for its figures");
  }
  if (!options.out.empty() && !curves::image_format(options.out)) {
    return wrong_usage(fmt::format("--out {}: name a file that ends in .gwy or .gsf", options.out));
  }
  if (!options.picture.empty() && !core::has_ending(options.picture, ".png")) {
    return wrong_usage(fmt::format("--picture {}: name a file that ends in .png", options.picture));
  }
  return {};
}

}  // namespace

core::Result<void> write_scan_command(const ScanOptions& options) {
  if (const auto checked = check(options); !checked) return checked;
  auto scan = imaging::take_scan(options);
  if (!scan) return tl::unexpected(scan.error());
  if (!options.channel.empty()) {
    if (const auto kept = imaging::keep_channel(options.channel, scan->image); !kept) return kept;
  }
  if (!options.picture.empty()) {
    const auto written =
        render::write_png(exhibit::picture_of(scan->image, 0), options.picture, exhibit::picture_texts(scan->image, 0));
    if (!written) return written;
  }
  if (!options.out.empty()) {
    const bool one_channel = curves::image_format(options.out) == curves::ImageFormat::Gsf;
    const auto written =
        core::write_file(options.out, one_channel ? curves::gsf_bytes(scan->image, 0) : curves::gwy_bytes(scan->image));
    if (!written) return written;
  }
  return options.json ? write_stdout(core::json_text(imaging::scan_json(*scan), 2) + "\n") : core::Result<void>{};
}

core::Result<TrueScan> scan_with_truth(const ScanOptions& options) {
  const auto scan = imaging::take_scan(options);
  if (!scan) return tl::unexpected(scan.error());
  nlohmann::json truth = imaging::scan_json(*scan);
  truth["kind"] = "image";
  core::name_software(truth);
  truth["seed"] = options.seed;
  truth["surface"] = std::filesystem::path(options.out).filename().string() + ".truth.gwy";
  return TrueScan{curves::gwy_bytes(scan->image), curves::gwy_bytes(imaging::true_image_of(*scan)),
                  core::json_text(truth, 2) + "\n"};
}

namespace {

void add_area_options(OptionList& command, ScanOptions& options) {
  using physics::Length;
  const auto lengths = [](const curves::QuantityRange<double>& range) {
    return QuantityRange<Length>{Length(range.least), Length(range.most)};
  };
  const QuantityRange<Length> sizes = lengths(imaging::kScanSizesM), places = lengths(imaging::kScanPlacesM);
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
      .within(static_cast<int>(imaging::kFewestPixels), static_cast<int>(physics::kMostScanPixels))
      .show_default()
      .type_name("NUMBER");
  enum_option(command, "--direction", options.direction, "a direction", imaging::kDirections,
              &imaging::DirectionName::name, &imaging::DirectionName::direction,
              "direction of the slow scan; default: down");
}

void add_own_sample_options(OptionList& command, ScanOptions& options) {
  Option sample = command.add_option(
      "--sample", options.sample.file,
      fmt::format("scan your own sample at its own size: a glTF model with a node for the role surface, or a measured "
                  "image ({}); without --tip an image is taken as an apex traced it, as it is felt, with --tip as the "
                  "sample itself; the file's first bytes decide; or {}, bars 10 nm high with a pitch of 200 nm on "
                  "the left and 100 nm on the right",
                  curves::kImageFiles, imaging::kGratings));
  sample.type_name("FILE");
  for (Option& option : add_channel_options(command, options.sample.reading.image.channel,
                                            options.sample.reading.levelling, "--sample-channel")) {
    option.needs(sample);
  }
}

// Returns whether the text is a number or a length.
bool is_amplitude(const std::string& text) {
  const auto share = physics::parse_si(text, "a share", physics::kPlainNumber.units, physics::Infinity::Refused);
  return std::holds_alternative<double>(share) || physics::parse_quantity(text, physics::kLengthUnits).value;
}

// Adds --setpoint: a force in contact mode; a share of the free amplitude, or an amplitude, in tapping mode.
void add_setpoint_option(OptionList& command, ScanOptions& options, const physics::ScanField& field) {
  const QuantityDomain domain{field.units->sort, field.units->units,
                              QuantityRange<double>{field.smallest, field.largest}};
  const auto read = [&options, &field, domain](const std::string& text) -> core::Result<void> {
    const auto force = curves::parse_si(text, domain);
    if (const double* si = std::get_if<double>(&force)) {
      options.settings.emplace_back(&field, *si);
    } else if (is_amplitude(text)) {
      options.amplitude_setpoint = text;
    } else {
      return wrong_usage(std::get<std::string>(force));
    }
    return {};
  };
  command
      .add_parsed_option("--" + std::string(field.option), read,
                         fmt::format("{}; default: {}; in tapping mode the amplitude that it keeps, as a share of the "
                                     "free one or a length; default: 0.8",
                                     field.help, field.text(field.get({}))))
      .type_name(fmt::format("FORCE from {}, or AMPLITUDE", curves::legal_values(domain)));
}

void add_setting_options(OptionList& command, ScanOptions& options) {
  const physics::ScanSettings usual;
  for (const physics::ScanField& field : physics::kScanFields) {
    // already an option of the contact
    if (curves::find_contact_parameter(field.option) != nullptr) continue;
    if (field.name == "setpoint") {
      add_setpoint_option(command, options, field);
      continue;
    }
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
      {curves::kAngleUnits.sort, curves::kAngleUnits.units, imaging::kTipAnglesRad},
      "half angle of a cone or a pyramid, between axis and face; default: 17.189 deg");
  return tip;
}

void add_output_options(OptionList& command, ScanOptions& options) {
  command.add_flag(
      "--show-truth", options.show_truth,
      "add channels: the highest surface that gives this image, the places where it is certain, and the bluntest "
      "tip that could have taken it");
  command
      .add_option(
          "--channel", options.channel,
          "write only the channel of this name, such as \"Height\" or \"Error (retrace)\"; default: all; in .gsf, "
          "the height")
      .type_name("NAME");
  command.add_flag("--json", options.json, "print settings and figures of every channel in SI units as JSON");
  command.add_option("--picture", options.picture, "write the height, or the channel, as a picture (PNG) to FILE")
      .picture_file(".png")
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

void add_scan_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command(
      "scan", "take an image of a sample with the virtual microscope, with its artefacts, as .gwy or .gsf");
  // shared: the parser writes into it while it lives, the chosen command reads it afterwards
  const auto options = std::make_shared<ScanOptions>();
  const Option tip = add_scan_options(command, *options, context);
  add_tapped_scan_options(command, options->tapping);
  add_output_options(command, *options);
  command.footer(
      "Lever, tip and adhesion are the material's; each parameter overrides its own.\n"
      "example: touchafm scan --material mica --size 40nm --pixels 256 --rate 2Hz --out image.gwy\n"
      "example: touchafm scan --material gold --rate 20Hz --integral-gain 200/s --picture blurred.png --json\n"
      "example: touchafm scan --material mica --mode tapping --free-amplitude 20nm --resonance 300kHz "
      "--quality-factor 400 --spring-constant 40N/m --setpoint 0.8 --integral-gain 500/s --rate 1Hz --out tapped.gwy\n"
      "example: touchafm scan --sample gratings --size 500nm --tip-radius 10nm --rate 1Hz --out image.gwy\n"
      "example: touchafm scan --sample grating.gwy --tip cone --tip-radius 20nm --rate 1Hz --out image.gwy");
  command.when_chosen([options, tip] {
    if (const auto checked = check_tapping_options(options->tapping); !checked) return checked;
    complete(*options, tip.given());
    return write_scan_command(*options);
  });
}

}  // namespace afm::app
