// SPDX-License-Identifier: Apache-2.0
#include "servo/wall_frame.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace afm::servo {

namespace {

using nlohmann::json;

template <class T>
constexpr bool kIsOptional = false;
template <class T>
constexpr bool kIsOptional<std::optional<T>> = true;

void visit_members(auto&& visit, auto& pose)
  requires std::same_as<std::remove_cvref_t<decltype(pose)>, RecordedPose>
{
  visit("position_m", pose.position_m);
  visit("orientation_wxyz", pose.orientation);
}

void visit_members(auto&& visit, auto& wand)
  requires std::same_as<std::remove_cvref_t<decltype(wand)>, RecordedWand>
{
  visit("pose", wand.pose);
  visit("orientation_valid", wand.orientation_valid);
  visit("position_valid", wand.position_valid);
  visit("connected", wand.connected);
  visit("buttons", wand.buttons);
}

void visit_members(auto&& visit, auto& change)
  requires std::same_as<std::remove_cvref_t<decltype(change)>, RecordedScanChange>
{
  visit("frame", change.frame);
  visit("pixel", change.pixel);
  visit("setpoint_N", change.setpoint_n);
  visit("gain_per_s", change.gain_per_s);
  visit("line_rate_Hz", change.line_rate_hz);
  visit("tip_radius_m", change.tip_radius_m);
  visit("noise_m", change.noise_m);
  visit("drift_m_per_s", change.drift_m_per_s);
  visit("apex_distance_m", change.apex_distance_m);
}

void visit_members(auto&& visit, auto& scan)
  requires std::same_as<std::remove_cvref_t<decltype(scan)>, RecordedScan>
{
  visit("frame", scan.frame);
  visit("pixel", scan.pixel);
  visit("truth", scan.truth);
}

void visit_members(auto&& visit, auto& part)
  requires std::same_as<std::remove_cvref_t<decltype(part)>, RecordedHandPart>
{
  visit("paints", part.paints);
  visit("feedback", part.feedback);
  visit("side_m", part.side_m);
  visit("first_tick", part.first_tick);
}

void visit_members(auto&& visit, auto& frame)
  requires std::same_as<std::remove_cvref_t<decltype(frame)>, WallFrame>
{
  visit("time_ns", frame.time_ns);
  visit("room_from_sample", frame.room_from_sample);
  visit("navigation", frame.navigation);
  visit("centerpiece", frame.centerpiece);
  visit("journey_orders", frame.journey_orders);
  visit("fade", frame.fade);
  visit("hovered", frame.hovered);
  visit("wand", frame.wand);
  visit("head", frame.head);
  visit("ipd_m", frame.ipd_m);
  visit("stereo", frame.stereo);
  visit("eyes_swapped", frame.eyes_swapped);
  visit("panels", frame.panels);
  visit("guidance", frame.guidance);
  visit("retracting", frame.retracting);
  visit("release_z_m", frame.release_z_m);
  visit("servo_row", frame.servo_row);
  visit("scan", frame.scan);
  visit("scan_changes", frame.scan_changes);
  visit("scan_hand", frame.scan_hand);
}

template <class T>
concept Visited =
    std::same_as<T, RecordedPose> || std::same_as<T, RecordedWand> || std::same_as<T, RecordedScanChange> ||
    std::same_as<T, RecordedScan> || std::same_as<T, RecordedHandPart> || std::same_as<T, WallFrame>;

template <class T>
constexpr bool kIsList = false;
template <Visited T>
constexpr bool kIsList<std::vector<T>> = true;

template <class T>
json to_json_value(const T& value) {
  if constexpr (kIsOptional<T>) {
    return value ? to_json_value(*value) : json(nullptr);
  } else if constexpr (Visited<T>) {
    json object = json::object();
    visit_members([&](const char* key, const auto& member) { object[key] = to_json_value(member); }, value);
    return object;
  } else if constexpr (kIsList<T>) {
    json array = json::array();
    for (const auto& entry : value) array.push_back(to_json_value(entry));
    return array;
  } else {
    return value;
  }
}

// `to` is new, and stays empty if nothing was written.
template <class T>
void from_json_value(const json& value, T& to) {
  if constexpr (kIsOptional<T>) {
    if (!value.is_null()) from_json_value(value, to.emplace());
  } else if constexpr (Visited<T>) {
    visit_members([&](const char* key, auto& member) { from_json_value(value.at(key), member); }, to);
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
