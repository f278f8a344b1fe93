// SPDX-License-Identifier: Apache-2.0
#include "devices/haply_message.h"

#include <nlohmann/json.hpp>

#include "haptics/device.h"

namespace afm::haptics {

namespace {

using json = nlohmann::json;

constexpr std::size_t kLongestId = 256;  // the service's ids have four digits; this limit keeps every message small

// Member of an object, or null, also for other values.
const json& member(const json& value, const char* name) {
  static const json kNull;
  if (!value.is_object()) return kNull;
  const auto found = value.find(name);
  return found == value.end() ? kNull : *found;
}

const json& first_of(const json& value, const char* name) {
  static const json kNull;
  const json& list = member(value, name);
  return list.is_array() && !list.empty() ? list.front() : kNull;
}

bool is_true(const json& value) { return value.is_boolean() && value.get<bool>(); }

}  // namespace

std::optional<HaplyState> parse_haply_state(std::string_view message) {
  const json root = json::parse(message, nullptr, false);
  const json& inverse = first_of(root, "inverse3");
  const json& id = member(inverse, "device_id");
  const json& place = member(member(inverse, "state"), "cursor_position");
  const json &x = member(place, "x"), &y = member(place, "y"), &z = member(place, "z");
  if (!id.is_string() || !x.is_number() || !y.is_number() || !z.is_number()) return std::nullopt;

  HaplyState state;
  state.device_id = id.get<std::string>();
  if (state.device_id.size() > kLongestId) return std::nullopt;
  state.position_m = {x.get<double>(), z.get<double>(), -y.get<double>()};
  if (!is_within_reach(state.position_m)) return std::nullopt;
  const json& wireless = member(member(first_of(root, "wireless_verse_grip"), "state"), "buttons");
  const json& wired = member(first_of(root, "verse_grip"), "state");
  state.button = is_true(member(wireless, "a")) || is_true(member(wired, "button"));
  return state;
}

std::string haply_force_message(const std::string& device_id, const glm::dvec3& force_n) {
  const json values{{"x", force_n.x}, {"y", -force_n.z}, {"z", force_n.y}};
  const json command{{"set_cursor_force", {{"values", values}}}};
  const json device{{"device_id", device_id}, {"commands", command}};
  return json{{"inverse3", json::array({device})}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace afm::haptics
