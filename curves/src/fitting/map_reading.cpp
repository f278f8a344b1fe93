// SPDX-License-Identifier: Apache-2.0
#include "curves/fitting/map_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "physics/contact_parameters.h"

namespace afm::curves {

namespace {

// A number of the fit: its key, and the option that has its range.
struct ReadingNumber {
  const char* key;
  std::string_view option;
  double (*get)(const FitOptions& options);  // getter of the value; not finite: not given
};
constexpr std::array kReadingNumbers{
    ReadingNumber{"radius_m", "radius",
                  [](const FitOptions& options) { return options.radius_m > 0.0 ? options.radius_m : HUGE_VAL; }},
    ReadingNumber{
        "half_angle_rad", "half-angle",
        [](const FitOptions& options) { return options.half_angle_rad > 0.0 ? options.half_angle_rad : HUGE_VAL; }},
    ReadingNumber{"layer_m", "layer",
                  [](const FitOptions& options) { return options.layer_m > 0.0 ? options.layer_m : HUGE_VAL; }},
    ReadingNumber{"poisson", "poisson", [](const FitOptions& options) { return options.poisson; }},
    ReadingNumber{"atomic_distance_m", "atomic-distance",
                  [](const FitOptions& options) { return options.atomic_distance_m.value_or(HUGE_VAL); }},
    ReadingNumber{"most_force_N", "most-force", [](const FitOptions& options) { return options.most_force_n; }},
    ReadingNumber{"most_depth_m", "most-depth", [](const FitOptions& options) { return options.most_depth_m; }}};

constexpr const char* kSpringKey = "spring_constant_N_per_m";
constexpr const char* kSensitivityKey = "sensitivity_m_per_V";

core::Result<MapReading> damaged_reading(const std::string& why) {
  return core::failure(core::ErrorCategory::BadInputFile, "the reading of its force map is damaged: " + why);
}

// Reason why the number of a key cannot be used; empty if it can, or if the key is missing.
std::string take_reading_number(const nlohmann::json& members, const ReadingNumber& number, FitOptions& options) {
  const auto found = members.find(number.key);
  if (found == members.end()) return {};
  const auto value = found->get<double>();
  for (const FitNumber& row : fit_numbers()) {
    if (row.name != number.option) continue;
    if (const std::string why = refusal(value, found->dump(), row.domain); !why.empty())
      return fmt::format("{}: {}", number.key, why);
    row.set(options, value);
  }
  return {};
}

core::Result<MapReading> reading_of(const nlohmann::json& members) {
  MapReading reading;
  if (const auto fit = members.find("fit"); fit != members.end()) {
    const auto name = fit->get<std::string>();
    const auto* shape = std::find_if(fits::kShapes.begin(), fits::kShapes.end(),
                                     [&](const fits::ShapeRow& row) { return row.name == name; });
    if (shape == fits::kShapes.end()) return damaged_reading(fmt::format("there is no fit \"{}\"", name));
    reading.fit.shape = shape->shape;
  }
  if (const auto base = members.find("base"); base != members.end()) {
    const auto name = base->get<std::string>();
    const auto* row = std::find_if(fits::kBases.begin(), fits::kBases.end(),
                                   [&](const fits::BaseName& each) { return each.name == name; });
    if (row == fits::kBases.end()) return damaged_reading(fmt::format("there is no base \"{}\"", name));
    reading.fit.base = row->base;
  }
  for (const ReadingNumber& number : kReadingNumbers) {
    if (const std::string why = take_reading_number(members, number, reading.fit); !why.empty())
      return damaged_reading(why);
  }
  if (const auto spring = members.find(kSpringKey); spring != members.end()) {
    constexpr physics::ContactField kField = physics::contact_field("spring_constant");
    const auto n_per_m = spring->get<double>();
    const bool legal = n_per_m >= kField.smallest && n_per_m <= kField.largest;
    if (!legal) return damaged_reading(fmt::format("{} is {}", kSpringKey, n_per_m));
    reading.calibration.spring_constant = physics::Stiffness(n_per_m);
  }
  if (const auto sensitivity = members.find(kSensitivityKey); sensitivity != members.end()) {
    const auto m_per_v = sensitivity->get<double>();
    const bool legal = m_per_v > 0.0 && std::isfinite(m_per_v);
    if (!legal) return damaged_reading(fmt::format("{} is {}", kSensitivityKey, m_per_v));
    reading.calibration.sensitivity_m_per_v = m_per_v;
  }
  return reading;
}

}  // namespace

std::string text_of(const MapReading& reading) {
  nlohmann::json members = nlohmann::json::object();
  if (reading.fit.shape) members["fit"] = fits::row_of(*reading.fit.shape).name;
  if (reading.fit.base != FitOptions{}.base)
    members["base"] = fits::kBases.at(static_cast<std::size_t>(reading.fit.base)).name;
  for (const ReadingNumber& number : kReadingNumbers) {
    if (const double value = number.get(reading.fit); std::isfinite(value)) members[number.key] = value;
  }
  if (const auto& lever = reading.calibration.spring_constant) members[kSpringKey] = lever->si;
  if (const auto& sensitivity = reading.calibration.sensitivity_m_per_v) members[kSensitivityKey] = *sensitivity;
  return members.dump();
}

core::Result<MapReading> map_reading_of(std::string_view text) {
  try {
    return reading_of(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    return damaged_reading(error.what());
  }
}

}  // namespace afm::curves
