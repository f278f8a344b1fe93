// SPDX-License-Identifier: Apache-2.0
#include "input/dtrack.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <span>
#include <system_error>

namespace afm::input {

namespace {

constexpr double kMetresPerMillimetre = 1e-3;
constexpr std::uint32_t kLargestId = 63;
constexpr std::uint32_t kMostButtons = 32;
constexpr double kRotationTolerance = 1e-2;  // the protocol has six digits

// Remainder of a line. Every take() fails harmlessly on unexpected text.
class Line {
 public:
  explicit Line(std::string_view text) : rest_(text) {}

  std::string_view word() {
    skip_spaces();
    const std::size_t end = std::min(rest_.find_first_of(" [\r\t"), rest_.size());
    const std::string_view taken = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return taken;
  }

  template <class Number>
  bool take(Number& number) {
    skip_spaces();
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error != std::errc()) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

  bool take_finite(std::span<double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [this](double& number) { return take(number) && std::isfinite(number); });
  }

  bool take_bracket(char bracket) {
    skip_spaces();
    if (rest_.empty() || rest_.front() != bracket) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool at_end() {
    skip_spaces();
    return rest_.empty();
  }

 private:
  void skip_spaces() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \r\t"), rest_.size())); }

  std::string_view rest_;
};

// `[b0 ... b8]`: tracker_from_body, column by column.
bool take_rotation(Line& line, DtrackBody& body) {
  std::array<double, 9> b{};
  if (!line.take_bracket('[') || !line.take_finite(b) || !line.take_bracket(']')) return false;
  if (!body.tracked) return true;
  const glm::dmat3 rotation(b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8]);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(glm::length(rotation[i]) - 1.0) > kRotationTolerance) return false;
    if (std::abs(glm::dot(rotation[i], rotation[(i + 1) % 3])) > kRotationTolerance) return false;
  }
  if (glm::dot(glm::cross(rotation[0], rotation[1]), rotation[2]) < 0.0) return false;  // a reflection
  body.tracker_from_body = glm::normalize(glm::dquat(rotation));
  return true;
}

// `id quality`; a negative quality means that there is no pose.
bool take_head(Line& line, DtrackBody& body) {
  double quality = 0.0;
  if (!line.take(body.id) || body.id > kLargestId || !line.take(quality) || !std::isfinite(quality)) return false;
  body.tracked = quality >= 0.0;
  return true;
}

void place(DtrackBody& body, const double* millimetres) {
  if (body.tracked) body.position_m = kMetresPerMillimetre * glm::dvec3(millimetres[0], millimetres[1], millimetres[2]);
}

// 6d n [id quality][x y z eta theta phi][b0 ... b8] ...
bool take_bodies(Line& line, DtrackFrame& frame) {
  std::uint32_t count = 0;
  if (!line.take(count) || count > frame.bodies.size()) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    DtrackBody& body = frame.bodies[i];
    std::array<double, 6> pose{};
    if (!line.take_bracket('[') || !take_head(line, body) || !line.take_bracket(']')) return false;
    if (!line.take_bracket('[') || !line.take_finite(pose) || !line.take_bracket(']')) return false;
    if (!take_rotation(line, body)) return false;
    place(body, pose.data());
  }
  frame.body_count = count;
  return line.at_end();
}

// 6df2 calibrated n [id quality buttons joysticks][x y z][b0 ... b8][words of buttons, joysticks] ...
bool take_flysticks(Line& line, DtrackFrame& frame) {
  std::uint32_t calibrated = 0, count = 0;
  if (!line.take(calibrated) || !line.take(count) || count > calibrated || count > frame.flysticks.size()) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    DtrackFlystick& stick = frame.flysticks[i];
    std::uint32_t buttons = 0, joysticks = 0;
    if (!line.take_bracket('[') || !take_head(line, stick.body) || !line.take(buttons) || !line.take(joysticks) ||
        !line.take_bracket(']') || buttons > kMostButtons || joysticks > stick.joystick.size()) {
      return false;
    }
    std::array<double, 3> position{};
    if (!line.take_bracket('[') || !line.take_finite(position) || !line.take_bracket(']')) return false;
    if (!take_rotation(line, stick.body) || !line.take_bracket('[')) return false;
    if (buttons > 0 && !line.take(stick.buttons)) return false;
    if (!line.take_finite(std::span(stick.joystick).first(joysticks)) || !line.take_bracket(']')) return false;
    for (double& axis : stick.joystick) axis = std::clamp(axis, -1.0, 1.0);
    place(stick.body, position.data());
  }
  frame.flystick_count = count;
  return line.at_end();
}

bool take_line(std::string_view text, DtrackFrame& frame, bool& numbered) {
  Line line(text);
  const std::string_view kind = line.word();
  if (kind == "fr") {
    numbered = line.take(frame.frame) && line.at_end();
    return numbered;
  }
  if (kind == "6d") return take_bodies(line, frame);
  if (kind == "6df2") return take_flysticks(line, frame);
  if (kind == "ts2") {
    std::uint64_t seconds = 0;
    std::uint32_t microseconds = 0;
    return line.take(seconds) && line.take(microseconds) && line.take(frame.latency_us);
  }
  return true;
}

}  // namespace

const DtrackBody* DtrackFrame::body(std::uint32_t id) const {
  const auto end = bodies.begin() + static_cast<std::ptrdiff_t>(body_count);
  const auto found = std::find_if(bodies.begin(), end, [&](const DtrackBody& b) { return b.id == id; });
  return found == end ? nullptr : &*found;
}

const DtrackFlystick* DtrackFrame::flystick(std::uint32_t id) const {
  const auto end = flysticks.begin() + static_cast<std::ptrdiff_t>(flystick_count);
  const auto found = std::find_if(flysticks.begin(), end, [&](const DtrackFlystick& f) { return f.body.id == id; });
  return found == end ? nullptr : &*found;
}

std::optional<DtrackFrame> parse_dtrack(std::string_view packet) {
  DtrackFrame frame;
  bool numbered = false;
  while (!packet.empty()) {
    const std::size_t end = std::min(packet.find('\n'), packet.size());
    if (!take_line(packet.substr(0, end), frame, numbered)) return std::nullopt;
    packet.remove_prefix(std::min(end + 1, packet.size()));
  }
  return numbered ? std::optional(frame) : std::nullopt;
}

}  // namespace afm::input
