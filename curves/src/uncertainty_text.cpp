// SPDX-License-Identifier: Apache-2.0
#include "curves/uncertainty_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

namespace afm::curves {

namespace {

using core::wrong_usage;

constexpr std::array kShareUnits{physics::Unit{"%", 1e2, true}};

core::Result<KeyUncertainty> parse_uncertainty(const std::string& text, std::span<const UncertainKey> keys) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string_view name = std::string_view(text).substr(0, equals);
  const std::string_view value = std::string_view(text).substr(std::min(equals + 1, text.size()));
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const UncertainKey& each) { return each.name == name; });
  if (key == keys.end()) {
    std::string names;
    for (const UncertainKey& each : keys) names += (names.empty() ? "" : ", ") + std::string(each.name);
    return wrong_usage(fmt::format("--uncertainty: \"{}\" has no key with a value; known are {}", text, names));
  }
  std::vector<physics::Unit> units(kShareUnits.begin(), kShareUnits.end());
  // a difference of temperatures has no zero
  for (const physics::Unit& unit : key->units) {
    if (unit.zero_si == 0.0 && !unit.symbol.empty()) units.push_back(unit);
  }
  const auto parsed = physics::parse_si(value, "an uncertainty", units, physics::Infinity::Refused);
  if (const auto* error = std::get_if<std::string>(&parsed)) {
    return wrong_usage(fmt::format("--uncertainty {}: {}", name, *error));
  }
  const KeyUncertainty found{static_cast<std::size_t>(key - keys.begin()), std::get<double>(parsed),
                             value.ends_with('%')};
  if (!(found.value > 0.0) || (found.is_share && found.value > kMostUncertainty)) {
    return wrong_usage(
        fmt::format("--uncertainty {}: it must be above 0 % and at most {:g} %", text, 100.0 * kMostUncertainty));
  }
  return found;
}

}  // namespace

core::Result<std::vector<KeyUncertainty>> parse_uncertainties(const std::vector<std::string>& texts,
                                                              std::span<const UncertainKey> keys) {
  std::vector<KeyUncertainty> all;
  for (const std::string& text : texts) {
    const auto found = parse_uncertainty(text, keys);
    if (!found) return tl::unexpected(found.error());
    if (std::any_of(all.begin(), all.end(), [&](const KeyUncertainty& other) { return other.key == found->key; })) {
      return wrong_usage(fmt::format("--uncertainty {}: given twice; give it once", keys[found->key].name));
    }
    all.push_back(*found);
  }
  return all;
}

}  // namespace afm::curves
