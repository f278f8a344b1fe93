// SPDX-License-Identifier: Apache-2.0
#include "imaging/scan_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "core/check.h"
#include "core/log.h"
#include "core/written_by.h"
#include "curves/angle_units.h"
#include "curves/tapping/tapping_output.h"
#include "physics/imaging/scan_truth.h"

namespace afm::imaging {
namespace {

using core::wrong_usage;
using physics::ScanImage;

constexpr std::size_t kManyLines = 1024;  // number of lines from which a scan takes seconds and reports progress

physics::ScanSettings settings_of(const ScanRequest& request, const curves::ContactSetup& setup,
                                  const ScanSurface& surface) {
  physics::ScanSettings settings;
  settings.spring_constant = setup.material.contact.spring_constant;
  settings.adhesion = physics::Force(surface.pull_off_force_n);
  settings.snap_in = physics::Length(surface.snap_in_m);
  settings.feedback = request.feedback;
  for (const auto& [field, si] : request.settings) field->set(settings, si);
  return settings;
}

physics::TipShape tip_of(const ScanRequest& request, const curves::ContactSetup& setup,
                         const physics::ScanSettings& settings) {
  physics::TipShape tip = request.tip;
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

bool taps(const ScanRequest& request) { return request.tapping.mode == "tapping"; }

// True for settings that tapping mode does not use, because the law of force decides instead.
bool only_in_contact(const physics::ScanField& field) {
  return field.name == "setpoint" || field.name == "adhesion" || field.name == "snap_in" || field.name == "friction";
}

// The amplitude that the feedback keeps, given as a share of the free amplitude or a length.
core::Result<physics::Length> setpoint_of(const std::string& text, physics::Length free_amplitude) {
  const auto share = physics::parse_si(text, "a share", physics::kPlainNumber.units, physics::Infinity::Refused);
  if (const double* number = std::get_if<double>(&share)) return *number * free_amplitude;
  const auto length = physics::parse_quantity(text, physics::kLengthUnits);
  if (length.value) return *length.value;
  return wrong_usage(
      fmt::format("--setpoint {}: --mode tapping takes a share of the free amplitude, such as 0.8, or "
                  "an amplitude, such as 16nm",
                  text));
}

core::Result<physics::TappingDetector> detector_of(const ScanRequest& request, const curves::ContactSetup& setup) {
  const auto driven = curves::driven_sample(setup, request.tapping.numbers);
  if (!driven) return tl::unexpected(driven.error());
  const physics::DrivenLever& lever = driven->lever;
  const auto setpoint =
      setpoint_of(request.amplitude_setpoint.empty() ? "0.8" : request.amplitude_setpoint, lever.free_amplitude);
  if (!setpoint) return tl::unexpected(setpoint.error());
  try {
    return physics::TappingDetector(driven->surface, lever, *setpoint);
  } catch (const physics::UnphysicalValue& error) {
    return wrong_usage(error.what());
  }
}

// Method in the words of --method of touchafm curve.
const char* method_of(const physics::TappingDetector& detector) { return detector.is_direct() ? "direct" : "averaged"; }

void describe(const ScanRequest& request, const curves::ContactSetup& setup, const physics::TipShape& tip, Scan& scan) {
  auto& metadata = scan.image.metadata;
  metadata.emplace_back("Software", core::written_by());
  metadata.emplace_back("Material", setup.material.name);
  if (!request.sample.file.empty()) {
    metadata.emplace_back("Sample", std::filesystem::path(request.sample.file).filename().string());
    metadata.emplace_back("Levelling", physics::text_of(request.sample.reading.levelling).word);
  }
  metadata.emplace_back("Model", setup.used_model());
  metadata.emplace_back("Tip", physics::name_of(tip.kind));
  metadata.emplace_back("Tip radius", physics::format_quantity(tip.radius, physics::kLengthUnits));
  if (tip.kind != physics::TipKind::Paraboloid && tip.kind != physics::TipKind::Sphere) {
    metadata.emplace_back("Tip half angle", physics::format_si(tip.half_angle_rad, curves::kAngleUnits.units));
  }
  metadata.emplace_back("Mode", request.tapping.mode);
  if (scan.tapping) {
    const physics::DrivenLever& lever = scan.tapping->lever();
    const auto add = [&](const char* name, const auto& quantity, const auto& units) {
      metadata.emplace_back(name, physics::format_quantity(quantity, units));
    };
    add("Free amplitude", lever.free_amplitude, physics::kLengthUnits);
    add("Amplitude setpoint", physics::Length(scan.tapping->setpoint_m()), physics::kLengthUnits);
    add("Resonance", lever.resonance, physics::kFrequencyUnits);
    add("Drive", lever.ratio * lever.resonance, physics::kFrequencyUnits);
    metadata.emplace_back("Quality factor", fmt::format("{:g}", lever.quality_factor));
    metadata.emplace_back("Method", method_of(*scan.tapping));
    const auto conventions = curves::tapping_conventions();
    for (const auto& [key, text] : conventions.items()) {
      metadata.emplace_back("Convention of " + key, text.get<std::string>());
    }
  }
  for (const physics::ScanField& field : physics::kScanFields) {
    if (scan.tapping && only_in_contact(field)) continue;
    metadata.emplace_back(words(field.name), field.text(field.get(scan.settings)));
  }
  metadata.emplace_back("Feedback", scan.settings.feedback == physics::Feedback::On ? "on" : "off");
  metadata.emplace_back("Slow direction", request.direction == physics::SlowDirection::Down ? "down" : "up");
  metadata.emplace_back("Seed", std::to_string(request.seed));
  for (const scene::SourcedValue& source : setup.material.sources) {
    metadata.emplace_back("Source of " + source.key,
                          fmt::format("{}, {}{}", source.value, source.source, source.estimated ? " (estimated)" : ""));
  }
}

nlohmann::json channel_json(const physics::ImageChannel& channel) {
  const auto count = static_cast<double>(channel.values.size());
  double mean = 0.0, square = 0.0;
  for (const double value : channel.values) mean += value / count;
  for (const double value : channel.values) square += (value - mean) * (value - mean) / count;
  const auto [least, most] = std::minmax_element(channel.values.begin(), channel.values.end());
  return {{"name", channel.name},     {"unit", channel.unit}, {"mean", mean},
          {"rms", std::sqrt(square)}, {"min", *least},        {"max", *most}};
}

// States and forces of one pass, whose channels and keys have these endings.
void add_pass(const Scan& scan, std::string_view of_channel, std::string_view of_key, double free_deg,
              nlohmann::json& result) {
  const auto values_of = [&](std::string_view name) -> const std::vector<double>& {
    const std::string wanted = fmt::format("{}{}", name, of_channel);
    const auto& channels = scan.image.channels;
    const auto found = std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.name == wanted; });
    AFM_CHECK(found != channels.end());
    return found->values;
  };
  const std::vector<double>&phase_deg = values_of("Phase"), &peak_n = values_of("Peak force");
  std::size_t changes = 0;
  for (std::size_t row = 0; row < scan.image.rows; ++row) {
    changes +=
        physics::changes_of_state(std::span(phase_deg).subspan(row * scan.image.columns, scan.image.columns), free_deg);
  }
  const auto attracted = std::count_if(phase_deg.begin(), phase_deg.end(), [&](double deg) { return deg > free_deg; });
  result[fmt::format("regime_changes{}", of_key)] = changes;
  result[fmt::format("attractive_share{}", of_key)] =
      static_cast<double>(attracted) / static_cast<double>(phase_deg.size());
  result[fmt::format("largest_peak_force{}_N", of_key)] = *std::max_element(peak_n.begin(), peak_n.end());
}

nlohmann::json tapping_json(const Scan& scan) {
  const physics::DrivenLever& lever = scan.tapping->lever();
  const double free_deg = lever.free_phase * 180.0 / std::numbers::pi;
  nlohmann::json result{{"free_amplitude_m", lever.free_amplitude.si},
                        {"setpoint_m", scan.tapping->setpoint_m()},
                        {"setpoint_ratio", scan.tapping->setpoint_m() / lever.free_amplitude.si},
                        {"resonance_Hz", lever.resonance.si},
                        {"frequency_Hz", (lever.ratio * lever.resonance).si},
                        {"quality_factor", lever.quality_factor},
                        {"method", method_of(*scan.tapping)},
                        {"free_phase_deg", free_deg},
                        {"relaxation_time_s", lever.relaxation().si},
                        {"integral_gain_without_overshoot_per_s", 0.25 / lever.relaxation().si},
                        {"conventions", curves::tapping_conventions()}};
  add_pass(scan, "", "", free_deg, result);
  add_pass(scan, " (retrace)", "_retrace", free_deg, result);
  return result;
}

}  // namespace

void complete(ScanRequest& request, bool tip_is_given) {
  request.sample.is_traced = !tip_is_given;
  if (request.contact.material.empty() && !request.sample.file.empty()) request.contact.material = "mica";
}

core::Result<void> check(const ScanRequest& request) {
  for (const auto& [field, si] : request.settings) {
    if (!taps(request) || !only_in_contact(*field)) continue;
    if (field->name == "setpoint") return tl::unexpected(setpoint_of(field->text(si), {}).error());
    return wrong_usage(fmt::format("--{} has no effect on --mode tapping; remove it", field->option));
  }
  if (!taps(request) && !request.amplitude_setpoint.empty()) {
    return wrong_usage(
        fmt::format("--setpoint {}: in contact mode it is a force, such as 2nN; in --mode tapping a "
                    "share of the free amplitude or an amplitude",
                    request.amplitude_setpoint));
  }
  if (!request.contact.material.empty()) return {};
  return wrong_usage("--material is required, such as mica or gold; or name a sample of your own with --sample");
}

core::Result<Scan> take_scan(const ScanRequest& request, const std::stop_token& stop) {
  if (const auto checked = check(request); !checked) return tl::unexpected(checked.error());
  const auto setup = taps(request) ? driven_setup(request.tapping, request.contact) : contact_setup(request.contact);
  if (!setup) return tl::unexpected(setup.error());
  const auto surface = scan_surface(*setup, tip_of(request, *setup, {}), request.contact.assets_dir, request.sample);
  if (!surface) return tl::unexpected(surface.error());

  Scan scan;
  scan.settings = settings_of(request, *setup, *surface);
  scan.surface = surface->height_m;
  if (taps(request)) {
    auto detector = detector_of(request, *setup);
    if (!detector) return tl::unexpected(detector.error());
    scan.tapping = std::move(*detector);
  }
  physics::ScanArea area;
  const double drawn_m = std::min(surface->width_m, surface->depth_m);
  area.width = area.height = request.size.si > 0.0 ? request.size : physics::Length(drawn_m);
  area.x_centre = request.x_centre;
  area.y_centre = request.y_centre;
  area.columns = area.rows = request.pixels;
  if (area.width.si > drawn_m * (1.0 + 1e-9)) {
    core::log_line(fmt::format("the sample {} is {} wide; beyond its rim the image is level, as it is felt there",
                               request.sample.file.empty() ? "of " + setup->material.name : request.sample.file,
                               physics::format_quantity(physics::Length(drawn_m), physics::kLengthUnits, 3)));
  }
  try {
    physics::Scanner scanner(area, scan.settings, surface->height_m, request.seed, scan.tapping);
    scanner.begin_frame(request.direction);
    std::size_t lines = 0;
    physics::NewestLines newest(scanner.loop().tapping());
    scan.image = physics::scan_frame(scanner, [&](const physics::ScanLine& line) {
      newest.add(line, scanner.time().si);
      ++scan.lines_with[physics::main_artefact(
          {scan.settings, area, scanner.loop().largest_integral_gain(), scanner.loop().tapping()}, newest.evidence())];
      ++lines;
      if (area.rows >= kManyLines && lines % (area.rows / 8) == 0 && lines < area.rows) {
        core::log_line(fmt::format("scanned {} of {} lines", lines, area.rows));
      }
      return !stop.stop_requested();
    });
    scan.time_s = scanner.time().si;
  } catch (const physics::UnphysicalValue& error) {
    return wrong_usage(error.what());
  }
  const physics::TipShape tip = tip_of(request, *setup, scan.settings);
  describe(request, *setup, tip, scan);
  if (request.show_truth) physics::add_truth(tip, physics::noise_of_height(scan.settings), scan.image);
  return scan;
}

nlohmann::json scan_json(const Scan& scan) {
  nlohmann::json settings, channels = nlohmann::json::array(), artefacts = nlohmann::json::object(), metadata;
  for (const physics::ScanField& field : physics::kScanFields) {
    settings[std::string(field.json_key)] = field.get(scan.settings);
  }
  if (scan.tapping) {
    for (const char* key : {"setpoint_N", "adhesion_N", "snap_in_m", "friction_coefficient"}) settings.erase(key);
  }
  settings["feedback"] = scan.settings.feedback == physics::Feedback::On;
  for (const physics::ImageChannel& channel : scan.image.channels) channels.push_back(channel_json(channel));
  for (const auto& [artefact, lines] : scan.lines_with) artefacts[std::string(physics::name_of(artefact))] = lines;
  for (const auto& [key, value] : scan.image.metadata) metadata[key] = value;
  nlohmann::json result{{"columns", scan.image.columns},
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
  if (scan.tapping) result["tapping"] = tapping_json(scan);
  core::name_software(result);
  return result;
}

// Image without artefacts on the same grid, at time zero, because drift is an artefact.
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

}  // namespace afm::imaging
