// SPDX-License-Identifier: Apache-2.0
#include "imaging/scan_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/log.h"
#include "curves/angle_units.h"
#include "physics/imaging/scan_truth.h"

namespace afm::imaging {
namespace {

using core::wrong_usage;
using physics::ScanImage;

constexpr std::size_t kManyLines = 1024;  // scans with at least this many lines take seconds and report progress

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

void describe(const ScanRequest& request, const curves::ContactSetup& setup, const physics::TipShape& tip, Scan& scan) {
  auto& metadata = scan.image.metadata;
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
  for (const physics::ScanField& field : physics::kScanFields) {
    metadata.emplace_back(words(field.name), field.text(field.get(scan.settings)));
  }
  metadata.emplace_back("Feedback", scan.settings.feedback == physics::Feedback::On ? "on" : "off");
  metadata.emplace_back("Slow direction", request.direction == physics::SlowDirection::Down ? "down" : "up");
  metadata.emplace_back("Seed", std::to_string(request.seed));
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

}  // namespace

void complete(ScanRequest& request, bool tip_is_given) {
  request.sample.is_traced = !tip_is_given;
  if (request.contact.material.empty() && !request.sample.file.empty()) request.contact.material = "mica";
}

core::Result<void> check(const ScanRequest& request) {
  if (!request.contact.material.empty()) return {};
  return wrong_usage("--material is required, such as mica or gold; or name a sample of your own with --sample");
}

core::Result<Scan> take_scan(const ScanRequest& request, const std::stop_token& stop) {
  if (const auto checked = check(request); !checked) return tl::unexpected(checked.error());
  const auto setup = contact_setup(request.contact);
  if (!setup) return tl::unexpected(setup.error());
  const auto surface = scan_surface(*setup, tip_of(request, *setup, {}), request.contact.assets_dir, request.sample);
  if (!surface) return tl::unexpected(surface.error());

  Scan scan;
  scan.settings = settings_of(request, *setup, *surface);
  scan.surface = surface->height_m;
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
    physics::Scanner scanner(area, scan.settings, surface->height_m, request.seed);
    scanner.begin_frame(request.direction);
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
  settings["feedback"] = scan.settings.feedback == physics::Feedback::On;
  for (const physics::ImageChannel& channel : scan.image.channels) channels.push_back(channel_json(channel));
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

}  // namespace afm::imaging
