// SPDX-License-Identifier: Apache-2.0
#include "servo/wall_frame.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace afm::servo {

namespace {

using nlohmann::json;

template <class T>
constexpr bool kIsOptional = false;
template <class T>
constexpr bool kIsOptional<std::optional<T>> = true;

template <class T>
constexpr bool kIsList = false;
template <scene::Described T>
constexpr bool kIsList<std::vector<T>> = true;

template <class T>
json to_json_value(const T& value) {
  if constexpr (kIsOptional<T>) {
    return value ? to_json_value(*value) : json(nullptr);
  } else if constexpr (scene::Described<T>) {
    json object = json::object();
    for_each_field([&](const char* key, const auto& member) { object[key] = to_json_value(member); }, value);
    return object;
  } else if constexpr (kIsList<T>) {
    json array = json::array();
    for (const auto& entry : value) array.push_back(to_json_value(entry));
    return array;
  } else {
    return value;
  }
}

// Reads an optional field. `to` is new, and stays empty if nothing was written, or by an older version.
template <class T>
void from_json_value(const json& value, T& to) {
  if constexpr (kIsOptional<T>) {
    if (!value.is_null()) from_json_value(value, to.emplace());
  } else if constexpr (scene::Described<T>) {
    for_each_field(
        [&](const char* key, auto& member) {
          if constexpr (kIsOptional<std::remove_reference_t<decltype(member)>>) {
            if (!value.contains(key)) return;
          }
          from_json_value(value.at(key), member);
        },
        to);
  } else if constexpr (kIsList<T>) {
    for (const json& entry : value) from_json_value(entry, to.emplace_back());
  } else {
    value.get_to(to);
  }
}

}  // namespace

json json_of(std::span<const WallFrame> frames, json& last) {
  json array = json::array();
  for (const WallFrame& frame : frames) {
    json whole = to_json_value(frame);
    json changes = json::object();
    for (const auto& [key, value] : whole.items()) {
      if (last.is_null() || last.at(key) != value) changes[key] = value;
    }
    array.push_back(std::move(changes));
    last = std::move(whole);
  }
  return array;
}

std::vector<WallFrame> frames_of(const json& array, json& last) {
  std::vector<WallFrame> frames;
  for (const json& changes : array) {
    if (last.is_null()) last = json::object();
    last.update(changes);
    from_json_value(last, frames.emplace_back());
  }
  return frames;
}

json json_of(const std::vector<EarlierCurve>& curves) {
  json array = json::array();
  for (const EarlierCurve& curve : curves) array.push_back({{"material", curve.material}, {"points", curve.points}});
  return array;
}

std::vector<EarlierCurve> curves_of(const json& array) {
  std::vector<EarlierCurve> curves;
  for (const json& curve : array) {
    curves.push_back({.material = curve.at("material"), .points = curve.at("points")});
  }
  return curves;
}

}  // namespace afm::servo
