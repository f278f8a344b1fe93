// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_message.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/printable.h"
#include "haptics/device.h"

namespace afm::haptics {

namespace {

using json = nlohmann::json;

constexpr std::size_t kLongestId = 256;  // bound that keeps every message small; the service's ids have four digits
constexpr std::size_t kLongestWord = 40;
constexpr std::size_t kMostListed = 16;

// Families whose devices give a position and take a force, in order of preference; then the grips, whose buttons count.
constexpr const char* kArms[] = {"inverse3", "inverse3x", "minverse"};
constexpr const char* kGrips[] = {"wireless_verse_grip", "custom_verse_grip", "verse_grip"};

// Member of an object; null if there is none, or for a value of another type.
const json& member(const json& value, const char* name) {
  static const json kNull;
  if (!value.is_object()) return kNull;
  const auto found = value.find(name);
  return found == value.end() ? kNull : *found;
}

const json& list_of(const json& root, const char* family) {
  static const json kNone = json::array();
  const json& list = member(root, family);
  return list.is_array() ? list : kNone;
}

bool is_true(const json& value) { return value.is_boolean() && value.get<bool>(); }

bool is_pressed(const json& grip) {
  const json& state = member(grip, "state");
  return is_true(member(state, "button")) || is_true(member(member(state, "buttons"), "a"));
}

std::optional<HaplyState> state_of(const char* family, const json& arm, std::string_view wanted) {
  const json& id = member(arm, "device_id");
  const json& place = member(member(arm, "state"), "cursor_position");
  const json &x = member(place, "x"), &y = member(place, "y"), &z = member(place, "z");
  if (!id.is_string() || !x.is_number() || !y.is_number() || !z.is_number()) return std::nullopt;

  HaplyState state;
  state.device = {family, id.get<std::string>()};
  if (state.device.id.size() > kLongestId || (!wanted.empty() && state.device.id != wanted)) return std::nullopt;
  state.position_m = {x.get<double>(), z.get<double>(), -y.get<double>()};
  if (!is_within_reach(state.position_m)) return std::nullopt;
  return state;
}

// The type reported by the device itself, or else the name of its list.
HaplyName name_of(const std::string& family, const json& device) {
  const json& type = member(member(device, "config"), "type");
  const std::string word = type.is_string() ? type.get<std::string>() : family;
  return {word.substr(0, kLongestWord), member(device, "device_id").get<std::string>().substr(0, kLongestId)};
}

template <std::size_t N>
bool is_one_of(const char* const (&families)[N], const std::string& family) {
  return std::any_of(std::begin(families), std::end(families), [&](const char* known) { return family == known; });
}

std::string joined(const std::vector<HaplyName>& devices) {
  std::string text;
  for (const HaplyName& device : devices)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", device.family, device.id.substr(0, kLongestWord));
  return core::printable_line(text);
}

}  // namespace

std::optional<HaplyState> parse_haply_state(std::string_view message, std::string_view wanted) {
  const json root = json::parse(message, nullptr, false);
  std::optional<HaplyState> state;
  for (const char* family : kArms) {
    for (const json& arm : list_of(root, family)) {
      state = state_of(family, arm, wanted);
      if (state) break;
    }
    if (state) break;
  }
  if (!state) return std::nullopt;
  for (const char* family : kGrips) {
    for (const json& grip : list_of(root, family)) state->button = state->button || is_pressed(grip);
  }
  return state;
}

HaplyInventory parse_haply_inventory(std::string_view message) {
  HaplyInventory inventory;
  const json root = json::parse(message, nullptr, false);
  if (!root.is_object()) return inventory;
  for (const auto& [family, list] : root.items()) {
    if (!list.is_array()) continue;
    for (const json& device : list) {
      if (!member(device, "device_id").is_string()) continue;
      auto& entries = is_one_of(kArms, family)    ? inventory.arms
                      : is_one_of(kGrips, family) ? inventory.grips
                                                  : inventory.unknown;
      if (entries.size() < kMostListed) entries.push_back(name_of(family, device));
    }
  }
  return inventory;
}

std::string text_of(const HaplyInventory& inventory) {
  std::string text = inventory.arms.empty() ? "no device" : joined(inventory.arms);
  if (!inventory.grips.empty()) text += "; grips " + joined(inventory.grips);
  if (!inventory.unknown.empty()) text += "; unknown " + joined(inventory.unknown);
  return text;
}

std::string haply_force_message(const HaplyName& device, const glm::dvec3& force_n) {
  const json values{{"x", force_n.x}, {"y", -force_n.z}, {"z", force_n.y}};
  const json command{{"set_cursor_force", {{"values", values}}}};
  const json entry{{"device_id", device.id}, {"commands", command}};
  return json{{device.family, json::array({entry})}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace afm::haptics
