// SPDX-License-Identifier: Apache-2.0
#include "input/simulated_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <utility>

#include "core/clock.h"
#include "core/whole_file.h"

namespace afm::input {

namespace {

constexpr double kUnitLengthTolerance = 1e-3;
constexpr double kFarthestM = 100.0;  // limit from the room's origin; larger numbers are probably millimetres
constexpr double kLongestScriptS = 86'400.0;

// Numbers of a line, separated by commas or spaces; empty if it contains anything else.
std::optional<std::vector<double>> numbers_of(std::string_view line) {
  std::vector<double> numbers;
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty()) return numbers;
    double number = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (!line.empty() && line.front() == ',') line.remove_prefix(1);
  }
}

// Parses a line; returns an error message, or nothing.
std::string take_key(const std::vector<double>& v, std::vector<HeadKey>& keys) {
  if (v.size() != 4 && v.size() != 8) return "must be seconds, x, y, z or seconds, x, y, z, qx, qy, qz, qw";
  HeadKey key{.time_s = v[0], .pose = {.position_m = {v[1], v[2], v[3]}}};
  if (keys.empty() ? key.time_s != 0.0 : !(key.time_s > keys.back().time_s)) return "times must rise from 0";
  if (key.time_s > kLongestScriptS) return fmt::format("a script may last {:g} s at most", kLongestScriptS);
  if (glm::length(key.pose.position_m) > kFarthestM) {
    return fmt::format("the head must be within {:g} m of the room's origin; positions are in metres", kFarthestM);
  }
  if (v.size() == 8) {
    const glm::dquat turn(v[7], v[4], v[5], v[6]);
    if (std::abs(glm::length(turn) - 1.0) > kUnitLengthTolerance) return "qx, qy, qz, qw must be a unit quaternion";
    key.pose.room_from_head = glm::normalize(turn);
  }
  keys.push_back(key);
  return {};
}

}  // namespace

core::Result<std::vector<HeadKey>> load_head_script(const std::string& path) {
  const auto text = core::read_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto refuse = [&](std::size_t line, const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("head script {}, line {}: {}", path, line, what));
  };
  std::vector<HeadKey> keys;
  std::string_view rest = *text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const auto numbers = numbers_of(line.substr(0, line.find('#')));
    if (!numbers) return refuse(number, "contains a value that is not a number");
    if (numbers->empty()) continue;
    if (const std::string wrong = take_key(*numbers, keys); !wrong.empty()) return refuse(number, wrong);
  }
  if (keys.size() < 2) return refuse(1, "a script needs at least two positions, one per line");
  return keys;
}

SimulatedHead::SimulatedHead(const scene::HeadPose& start, std::vector<HeadKey> script)
    : start_(start), shown_(script.empty() ? start : script.front().pose), script_(std::move(script)) {}

void SimulatedHead::step(const glm::dvec3& by_m) {
  target_m_ = target_m_.value_or(shown_.position_m) + by_m;
  script_.clear();
}

void SimulatedHead::home() {
  begun_ns_.reset();
  if (target_m_) target_m_ = start_.position_m;
}

// Interpolates linearly between two poses; repeats after the last one.
scene::HeadPose SimulatedHead::at_script_time(double time_s) const {
  const double within_s = std::fmod(time_s, script_.back().time_s);
  const auto after = std::upper_bound(script_.begin() + 1, script_.end() - 1, within_s,
                                      [](double t, const HeadKey& key) { return t < key.time_s; });
  const HeadKey& to = *after;
  const HeadKey& from = *(after - 1);
  const double share = (within_s - from.time_s) / (to.time_s - from.time_s);
  return {.position_m = glm::mix(from.pose.position_m, to.pose.position_m, share),
          .room_from_head = glm::slerp(from.pose.room_from_head, to.pose.room_from_head, share)};
}

std::optional<scene::HeadPose> SimulatedHead::pose(std::int64_t now_ns) {
  const double step_s = shown_ns_ == 0 ? 0.0 : std::max(0.0, core::seconds(now_ns - shown_ns_));
  shown_ns_ = now_ns;
  if (!script_.empty()) {
    if (!begun_ns_) begun_ns_ = now_ns;
    shown_ = at_script_time(core::seconds(now_ns - *begun_ns_));
    return shown_;
  }
  if (!target_m_) return std::nullopt;
  const glm::dvec3 way = *target_m_ - shown_.position_m;
  const double length = glm::length(way), farthest = kPaceMPerS * step_s;
  shown_.position_m = length <= farthest ? *target_m_ : shown_.position_m + way * (farthest / length);
  return shown_;
}

}  // namespace afm::input
