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
constexpr std::size_t kMostGroups = 4;       // largest number of bracketed groups of a body or Flystick
constexpr double kRotationTolerance = 1e-2;  // tolerance of a rotation; the protocol has six digits

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

  // Removes `[...]` and returns its inside.
  std::optional<std::string_view> group() {
    skip_spaces();
    const std::size_t end = rest_.find_first_of("[]", 1);
    if (rest_.empty() || rest_.front() != '[' || end == std::string_view::npos || rest_[end] != ']') {
      return std::nullopt;
    }
    const std::string_view inside = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return inside;
  }

  // Continues after a broken group: DTrack puts a space before each body.
  void skip_to_next_body() { rest_.remove_prefix(std::min(rest_.find(" [", 1), rest_.size())); }

  bool at_end() {
    skip_spaces();
    return rest_.empty();
  }

  std::string_view rest() const { return rest_; }

 private:
  void skip_spaces() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \r\t"), rest_.size())); }

  std::string_view rest_;
};

using Groups = std::array<std::string_view, kMostGroups>;

constexpr std::string_view kBadNumber = "its number is not one of 0 to 63";

// Reads `b0 ... b8`: tracker_from_body, column by column. Returns the fault, or an empty text.
std::string_view take_rotation(std::string_view group, DtrackBody& body) {
  if (!body.tracked) return {};
  std::array<double, 9> b{};
  if (!Line(group).take_finite(b)) return "its rotation matrix does not consist of nine numbers";
  const glm::dmat3 rotation(b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8]);
  constexpr std::string_view kNone = "its matrix is not a rotation";
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(glm::length(rotation[i]) - 1.0) <= kRotationTolerance)) return kNone;
    if (!(std::abs(glm::dot(rotation[i], rotation[(i + 1) % 3])) <= kRotationTolerance)) return kNone;
  }
  if (glm::dot(glm::cross(rotation[0], rotation[1]), rotation[2]) < 0.0) return "its matrix is a reflection";
  body.tracker_from_body = glm::normalize(glm::dquat(rotation));
  return {};
}

// Reads `x y z` in millimetres, perhaps with angles after them, and the matrix.
std::string_view take_pose(const Groups& groups, DtrackBody& body) {
  std::array<double, 3> millimetres{};
  if (body.tracked && !Line(groups[1]).take_finite(millimetres)) return "its position does not consist of numbers";
  body.position_m = kMetresPerMillimetre * glm::dvec3(millimetres[0], millimetres[1], millimetres[2]);
  return take_rotation(groups[2], body);
}

// Reads `id quality`; a negative quality means that there is no pose.
std::string_view take_head(Line& line, DtrackBody& body) {
  double quality = 0.0;
  if (!line.take(body.id) || body.id > kLargestId) return kBadNumber;
  if (!line.take(quality) || !std::isfinite(quality)) return "its quality is not a number";
  body.tracked = quality >= 0.0;
  return {};
}

// Reads a body of 6d: [id quality][x y z eta theta phi][b0 ... b8].
std::string_view take_optical(const Groups& groups, DtrackFlystick& read) {
  Line head(groups[0]);
  const std::string_view fault = take_head(head, read.body);
  return fault.empty() ? take_pose(groups, read.body) : fault;
}

// Reads a body of 6di: [id state error][x y z][b0 ... b8]; state 0 is not tracked, 1 inertial, 2 optical, 3 both.
std::string_view take_hybrid(const Groups& groups, DtrackFlystick& read) {
  Line head(groups[0]);
  std::uint32_t state = 0;
  if (!head.take(read.body.id) || read.body.id > kLargestId) return kBadNumber;
  if (!head.take(state)) return "its state is not a number";
  read.body.tracked = state != 0;
  return take_pose(groups, read.body);
}

// Reads a Flystick of 6df2: [id quality buttons joysticks][x y z][b0 ... b8][words of buttons, joysticks].
std::string_view take_flystick(const Groups& groups, DtrackFlystick& read) {
  Line head(groups[0]), controls(groups[3]);
  if (const std::string_view fault = take_head(head, read.body); !fault.empty()) return fault;
  std::uint32_t buttons = 0, joysticks = 0;
  if (!head.take(buttons) || !head.take(joysticks) || buttons > kMostButtons || joysticks > read.joystick.size()) {
    return "its counts are not those of at most 32 buttons and 8 joysticks";
  }
  if (!read.body.tracked && controls.at_end()) return {};
  if ((buttons > 0 && !controls.take(read.buttons)) ||
      !controls.take_finite(std::span(read.joystick).first(joysticks))) {
    return "its buttons and joysticks are not those announced";
  }
  for (double& axis : read.joystick) axis = std::clamp(axis, -1.0, 1.0);
  return take_pose(groups, read.body);
}

// Reads a Flystick 1 of 6df: [id quality buttons][x y z eta theta phi][b0 ... b8]. Its hat switch is bits 4 to 7.
std::string_view take_first_flystick(const Groups& groups, DtrackFlystick& read) {
  constexpr std::uint32_t kDown = 0x10, kLeft = 0x20, kUp = 0x40, kRight = 0x80;
  Line head(groups[0]);
  if (const std::string_view fault = take_head(head, read.body); !fault.empty()) return fault;
  if (!head.take(read.buttons)) return "its buttons are not a number";
  const auto axis = [&](std::uint32_t minus, std::uint32_t plus) {
    return (read.buttons & minus) != 0 ? -1.0 : (read.buttons & plus) != 0 ? 1.0 : 0.0;
  };
  read.joystick[0] = axis(kLeft, kRight);
  read.joystick[1] = axis(kDown, kUp);
  return take_pose(groups, read.body);
}

// Kind of line with several bodies, and its reader.
struct BodyLine {
  std::string_view name;
  std::string_view subject;
  std::size_t groups;
  std::string_view (*take)(const Groups& groups, DtrackFlystick& read);
  bool flysticks;
  bool calibrated;  // true: the number of calibrated bodies precedes the number of those in the line
};
constexpr std::array kBodyLines{
    BodyLine{"6d", "body", 3, take_optical, false, false},
    BodyLine{"6di", "body", 3, take_hybrid, false, false},
    BodyLine{"6df2", "Flystick", 4, take_flystick, true, true},
    BodyLine{"6df", "Flystick", 3, take_first_flystick, true, false},
};

void add_fault(DtrackFaults& faults, DtrackFault fault, std::string_view text) {
  if (faults.count++ >= faults.first.size()) return;
  const std::size_t length = std::min(text.size(), fault.text.size() - 1);
  std::transform(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length), fault.text.begin(),
                 [](char c) { return c >= ' ' && c <= '~' ? c : '?'; });
  faults.first[faults.count - 1] = fault;
}

const DtrackBody& body_of(const DtrackBody& body) { return body; }
const DtrackBody& body_of(DtrackBody&& body) = delete;
const DtrackBody& body_of(const DtrackFlystick& stick) { return stick.body; }

// Adds a body with a new number. The same body of another line counts if the first one is not tracked.
template <class Body, std::size_t Size>
void add_body(const Body& body, std::array<Body, Size>& bodies, std::size_t& count) {
  const auto end = bodies.begin() + static_cast<std::ptrdiff_t>(count);
  const auto same = std::find_if(bodies.begin(), end, [&](const Body& b) { return body_of(b).id == body_of(body).id; });
  if (same == end && count < Size) bodies[count++] = body;
  if (same != end && !body_of(*same).tracked) *same = body;
}

// Reads one body of the line, or returns the fault that leaves it out.
std::string_view take_body(Line& line, const BodyLine& kind, DtrackFlystick& read, bool& has_id) {
  Groups groups;
  for (std::size_t i = 0; i < kind.groups; ++i) {
    const auto group = line.group();
    if (!group) {
      line.skip_to_next_body();
      has_id = i > 0 && Line(groups[0]).take(read.body.id);
      return "it is incomplete";
    }
    groups[i] = *group;
  }
  has_id = Line(groups[0]).take(read.body.id);
  return kind.take(groups, read);
}

void take_bodies(std::string_view text, Line& line, const BodyLine& kind, DtrackFrame& frame) {
  const DtrackFault of_line{.line = kind.name, .subject = {}, .reason = {}};
  std::uint32_t calibrated = 0, count = 0;
  const auto refuse = [&](std::string_view reason) {
    DtrackFault fault = of_line;
    fault.reason = reason;
    add_fault(frame.faults, fault, text);
  };
  if ((kind.calibrated && !line.take(calibrated)) || !line.take(count)) return refuse("it has no count");
  if (kind.calibrated && count > calibrated) return refuse("it has more Flysticks than are calibrated");
  DtrackFrame read = frame;
  std::uint32_t found = 0;
  for (; found < count && !line.at_end(); ++found) {
    const std::string_view from_here = line.rest();
    DtrackFlystick one;
    bool has_id = false;
    const std::string_view reason = take_body(line, kind, one, has_id);
    if (!reason.empty()) {
      DtrackFault fault{.line = kind.name, .subject = kind.subject, .reason = reason};
      if (has_id) fault.id = one.body.id;
      add_fault(read.faults, fault, from_here);
    } else if (kind.flysticks) {
      add_body(one, read.flysticks, read.flystick_count);
    } else {
      add_body(one.body, read.bodies, read.body_count);
    }
  }
  if (found < count || !line.at_end()) return refuse("it does not have the number of bodies that it announces");
  frame = read;
}

void take_line(std::string_view text, DtrackFrame& frame, bool& numbered) {
  Line line(text);
  const std::string_view name = line.word();
  if (name == "fr" && !numbered) {
    numbered = line.take(frame.frame) && line.at_end();
  } else if (name == "ts2") {
    std::uint64_t seconds = 0;
    std::uint32_t microseconds = 0;
    if (line.take(seconds) && line.take(microseconds) && line.take(frame.latency_us)) return;
    frame.latency_us = 0;
    add_fault(frame.faults, {.line = "ts2", .subject = {}, .reason = "it does not have three whole numbers"}, text);
  }
  for (const BodyLine& kind : kBodyLines) {
    if (name == kind.name) take_bodies(text, line, kind, frame);
  }
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

std::optional<DtrackFrame> parse_dtrack(std::string_view packet, DtrackFaults* refused) {
  DtrackFrame frame;
  bool numbered = false;
  for (std::string_view rest = packet; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    take_line(rest.substr(0, end), frame, numbered);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (!numbered) {
    frame.faults = {};
    add_fault(frame.faults, {.line = {}, .subject = {}, .reason = "it has no line \"fr NUMBER\""}, packet);
  }
  if (numbered && (frame.faults.count == 0 || frame.body_count + frame.flystick_count > 0)) return frame;
  if (refused != nullptr) *refused = frame.faults;
  return std::nullopt;
}

}  // namespace afm::input
