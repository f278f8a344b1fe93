// SPDX-License-Identifier: Apache-2.0
#include "instrument/instrument_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/written_by.h"
#include "curves/contact_setup.h"
#include "curves/tapping/driven_setup.h"
#include "physics/lever_dynamics.h"

namespace afm::instrument {
namespace {

using core::wrong_usage;
using Json = nlohmann::ordered_json;
using Settings = InstrumentSettings;

// Row of a number that is neither the contact's nor a scan's.
struct NumberRow {
  std::string_view key;
  double smallest, largest;  // legal range, SI, both ends included
  double (*get)(const Settings& settings);
  void (*set)(Settings& settings, double si);
};

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr std::array kNumbers{
    NumberRow{"tip_half_angle_rad", kDegree, 80.0 * kDegree, [](const Settings& s) { return s.tip.half_angle_rad; },
              [](Settings& s, double si) { s.tip.half_angle_rad = si; }},
    NumberRow{"size_m", 0.0, 1e-4, [](const Settings& s) { return s.size_m; },
              [](Settings& s, double si) { s.size_m = si; }},
    NumberRow{"height_m", 0.0, 1e-4, [](const Settings& s) { return s.height_m; },
              [](Settings& s, double si) { s.height_m = si; }},
    NumberRow{"turn_rad", -std::numbers::pi, std::numbers::pi, [](const Settings& s) { return s.turn_rad; },
              [](Settings& s, double si) { s.turn_rad = si; }},
    NumberRow{"amplitude_setpoint", 0.01, 0.999, [](const Settings& s) { return s.amplitude_setpoint; },
              [](Settings& s, double si) { s.amplitude_setpoint = si; }},
    NumberRow{"free_amplitude_m", 1e-12, 1e-6, [](const Settings& s) { return s.free_amplitude_m; },
              [](Settings& s, double si) { s.free_amplitude_m = si; }},
    NumberRow{"drive_Hz", 0.0, 1e8, [](const Settings& s) { return s.drive_hz; },
              [](Settings& s, double si) { s.drive_hz = si; }},
    NumberRow{"viscosity_Pa_s", 0.0, 1e6, [](const Settings& s) { return s.viscosity_pa_s; },
              [](Settings& s, double si) { s.viscosity_pa_s = si; }},
    NumberRow{"force_noise_N", 0.0, 1e-3, [](const Settings& s) { return s.faults.force_noise_n; },
              [](Settings& s, double si) { s.faults.force_noise_n = si; }},
    NumberRow{"detector_range_N", 0.0, 1.0, [](const Settings& s) { return s.faults.detector_range_n; },
              [](Settings& s, double si) { s.faults.detector_range_n = si; }},
    NumberRow{"blunting_force_N", 0.0, 1.0, [](const Settings& s) { return s.faults.blunting_force_n; },
              [](Settings& s, double si) { s.faults.blunting_force_n = si; }},
    NumberRow{"blunting_m_per_N", 0.0, 1e3, [](const Settings& s) { return s.faults.blunting_m_per_n; },
              [](Settings& s, double si) { s.faults.blunting_m_per_n = si; }},
    NumberRow{"false_engagement", 0.0, 1.0, [](const Settings& s) { return s.faults.false_engagement; },
              [](Settings& s, double si) { s.faults.false_engagement = si; }},
    NumberRow{"tip_change", 0.0, 1.0, [](const Settings& s) { return s.faults.tip_change; },
              [](Settings& s, double si) { s.faults.tip_change = si; }},
    NumberRow{"second_apex_m", 1e-10, 1e-6, [](const Settings& s) { return s.faults.second_apex_m; },
              [](Settings& s, double si) { s.faults.second_apex_m = si; }}};

// True for settings of the scan only: the contact, the sample and Faults have members of their own.
bool is_of_scan_alone(const physics::ScanField& field) {
  constexpr std::array<std::string_view, 5> kElsewhere{"spring_constant", "adhesion", "snap_in", "second_apex_distance",
                                                       "second_apex_height"};
  return std::find(kElsewhere.begin(), kElsewhere.end(), field.name) == kElsewhere.end();
}

core::Result<double> number_of(std::string_view key, const Json& value, double smallest, double largest) {
  const double si = value.is_number() ? value.get<double>() : std::nan("");
  if (!(si >= smallest && si <= largest)) {
    return wrong_usage(
        fmt::format("\"{}\": {} is no number from {} to {} in SI", key, value.dump(), smallest, largest));
  }
  return si;
}

core::Result<std::string> text_of(std::string_view key, const Json& value) {
  constexpr std::size_t kMostLetters = 64;
  if (!value.is_string() || value.get_ref<const std::string&>().size() > kMostLetters) {
    return wrong_usage(fmt::format("\"{}\": give a text of at most {} letters", key, kMostLetters));
  }
  return value.get<std::string>();
}

core::Result<void> set_tip(const Json& value, Settings& settings) {
  const auto name = text_of("tip", value);
  if (!name) return tl::unexpected(name.error());
  std::string known;
  for (const physics::TipKindName& row : physics::kTipKinds) {
    known += (known.empty() ? "" : ", ") + std::string(row.name);
    if (row.name != *name) continue;
    settings.tip.kind = row.kind;
    return {};
  }
  return wrong_usage(fmt::format("\"tip\": there is no tip \"{}\"; choose {}", *name, known));
}

// Sets a setting that is no number; empty if the key is none of them.
std::optional<core::Result<void>> set_word(std::string_view key, const Json& value, Settings& settings) {
  if (key == "tip") return set_tip(value, settings);
  if (key == "mode") {
    if (value != "contact" && value != "tapping") return wrong_usage("\"mode\": give \"contact\" or \"tapping\"");
    settings.taps = value == "tapping";
    return core::Result<void>{};
  }
  if (key == "feedback" || key == "flat" || key == "upwards") {
    if (!value.is_boolean()) return wrong_usage(fmt::format("\"{}\": give true or false", key));
    const bool on = value.get<bool>();
    if (key == "flat") settings.flat = on;
    if (key == "upwards") settings.upwards = on;
    if (key == "feedback") settings.scan.feedback = on ? physics::Feedback::On : physics::Feedback::Off;
    return core::Result<void>{};
  }
  if (key == "pixels" || key == "lines") {
    const auto count = number_of(key, value, key == "pixels" ? 2.0 : 0.0, static_cast<double>(kMostInstrumentPixels));
    if (!count) return tl::unexpected(count.error());
    if (*count != std::floor(*count)) return wrong_usage(fmt::format("\"{}\": give a whole number", key));
    (key == "pixels" ? settings.pixels : settings.lines) = static_cast<std::size_t>(*count);
    return core::Result<void>{};
  }
  std::string* text = key == "material" ? &settings.contact.material : key == "law" ? &settings.contact.model : nullptr;
  if (text == nullptr) return std::nullopt;
  auto word = text_of(key, value);
  if (!word) return tl::unexpected(word.error());
  *text = std::move(*word);
  return core::Result<void>{};
}

core::Result<void> set_value(const std::string& key, const Json& value, Settings& settings) {
  if (const auto done = set_word(key, value, settings)) return *done;
  for (const NumberRow& row : kNumbers) {
    if (row.key != key) continue;
    const auto si = number_of(key, value, row.smallest, row.largest);
    if (!si) return tl::unexpected(si.error());
    row.set(settings, *si);
    return {};
  }
  for (const physics::ScanField& field : physics::kScanFields) {
    if (field.json_key != key || !is_of_scan_alone(field)) continue;
    const auto si = number_of(key, value, field.smallest, field.largest);
    if (!si) return tl::unexpected(si.error());
    field.set(settings.scan, *si);
    return {};
  }
  for (const curves::ContactParameter& parameter : curves::contact_parameters()) {
    if (parameter.json_key != key) continue;
    const std::string option(parameter.option);
    if (value.is_null()) {
      settings.contact.si_values.erase(option);
      return {};
    }
    // the contact itself knows which values make sense
    const auto si = number_of(key, value, -1e30, 1e30);
    if (!si) return tl::unexpected(si.error());
    settings.contact.si_values[option] = *si;
    return {};
  }
  return wrong_usage(fmt::format("there is no setting \"{}\"; \"get\" lists all of them", key));
}

}  // namespace

namespace {

// Checks the numbers of the lever, which act only in a vibrating mode and in a spectrum, whatever the law.
core::Result<curves::ContactSetup> with_checked_lever(curves::ContactSetup setup) {
  try {
    physics::validate(setup.material.lever);
  } catch (const physics::UnphysicalValue& error) {
    return wrong_usage(error.what());
  }
  return setup;
}

}  // namespace

core::Result<curves::ContactSetup> contact_of(const curves::ContactOptions& options) {
  curves::ContactOptions held(options);
  for (const char* name : {"resonance", "quality-factor"}) held.si_values.erase(name);
  const auto model = curves::ModelName::parse(options.model);
  if (held.si_values.size() == options.si_values.size() || (model && model->dynamic)) {
    return curves::contact_setup(options);
  }
  auto setup = curves::contact_setup(held);
  if (!setup) return setup;
  curves::TappingChoice choice;
  choice.mode = "tapping";
  const auto swung = curves::driven_setup(choice, options);
  if (!swung) return tl::unexpected(swung.error());
  setup->material.lever = swung->material.lever;
  return with_checked_lever(std::move(*setup));
}

Json settings_json(const Settings& settings, const curves::ContactSetup& setup) {
  Json result{{"material", settings.contact.material},
              {"law", settings.contact.model},
              {"mode", settings.taps ? "tapping" : "contact"},
              {"tip", physics::name_of(settings.tip.kind)},
              {"flat", settings.flat},
              {"upwards", settings.upwards},
              {"pixels", settings.pixels},
              {"lines", settings.lines},
              {"feedback", settings.scan.feedback == physics::Feedback::On}};
  for (const curves::ContactParameter& parameter : curves::contact_parameters()) {
    const std::optional<double> si = parameter.get(setup);
    result[std::string(parameter.json_key)] = si && std::isfinite(*si) ? Json(*si) : Json(nullptr);
  }
  for (const physics::ScanField& field : physics::kScanFields) {
    if (is_of_scan_alone(field)) result[std::string(field.json_key)] = field.get(settings.scan);
  }
  for (const NumberRow& row : kNumbers) result[std::string(row.key)] = row.get(settings);
  return result;
}

core::Result<void> change(const Json& values, Settings& settings) {
  if (!values.is_object()) return wrong_usage("\"values\": give an object of settings, {\"material\": \"gold\"}");
  Settings changed(settings);
  for (const auto& [key, value] : values.items()) {
    if (const auto set = set_value(key, value, changed); !set) return set;
  }
  settings = std::move(changed);
  return {};
}

std::vector<std::pair<std::string, std::string>> image_metadata(const InstrumentSettings& settings) {
  constexpr std::array kChosen{std::pair("line_rate", "Line rate"), std::pair("setpoint", "Setpoint"),
                               std::pair("integral_gain", "Integral gain"),
                               std::pair("proportional_gain", "Proportional gain")};
  std::vector<std::pair<std::string, std::string>> texts{{"Software", core::written_by()},
                                                         {"Material", settings.contact.material},
                                                         {"Mode", settings.taps ? "tapping" : "contact"}};
  if (settings.taps) texts.emplace_back("Amplitude setpoint", fmt::format("{}", settings.amplitude_setpoint));
  for (const physics::ScanField& field : physics::kScanFields) {
    if (settings.taps && field.name == "setpoint") continue;
    for (const auto& [name, title] : kChosen) {
      if (field.name == name) texts.emplace_back(title, field.text(field.get(settings.scan)));
    }
  }
  texts.emplace_back("Feedback", settings.scan.feedback == physics::Feedback::On ? "on" : "off");
  return texts;
}

}  // namespace afm::instrument
