// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string_view>

#include <optional>

namespace afm::input {

// Body as tracked by a DTrack system of Advanced Realtime Tracking: tracker frame, metres. No pose while not tracked.
struct DtrackBody {
  std::uint32_t id = 0;
  bool tracked = false;
  glm::dvec3 position_m{0.0};
  glm::dquat tracker_from_body{1.0, 0.0, 0.0, 0.0};
};

struct DtrackFlystick {
  DtrackBody body;
  std::uint32_t buttons = 0;         // bits of the buttons, the trigger first
  std::array<double, 8> joystick{};  // deflections from -1 to 1: right, up
};

// Part of a datagram that is left out. Trivially copyable.
struct DtrackFault {
  std::string_view line;              // identifier of the line: "6d"; empty: the whole packet
  std::string_view subject;           // kind of the part: "body", "Flystick"; empty: the whole line
  std::optional<std::uint32_t> id{};  // number of the part, if it could be read
  std::string_view reason;            // reason, as the end of a sentence
  std::array<char, 72> text{};        // beginning of the part's text, printable ASCII, with a final zero

  bool same_kind(const DtrackFault& other) const {
    return line == other.line && subject == other.subject && id == other.id && reason == other.reason;
  }
};

struct DtrackFaults {
  std::size_t count = 0;
  std::array<DtrackFault, 4> first{};  // first faults, at most 4 of `count`
};

// One datagram. Trivially copyable; no number appears twice among the bodies or among the Flysticks.
struct DtrackFrame {
  std::uint32_t frame = 0;
  std::uint32_t latency_us = 0;  // time from the cameras to sending, from line ts2; 0: unknown
  std::size_t body_count = 0;
  std::array<DtrackBody, 64> bodies{};
  std::size_t flystick_count = 0;
  std::array<DtrackFlystick, 64> flysticks{};
  DtrackFaults faults{};

  const DtrackBody* body(std::uint32_t id) const;
  const DtrackFlystick* flystick(std::uint32_t id) const;
};

// Parses any UDP datagram: the lines fr, ts2, 6d, 6di (hybrid bodies of DTrack 3), 6df2 and 6df (Flystick 1) of
// DTrack's ASCII output; other lines are skipped. A body with an invalid number, pose or rotation is left out and
// becomes a fault, as does a line that contradicts its own count; the rest of the packet is kept. Empty: no frame
// number, or faults only; `refused` then receives them.
std::optional<DtrackFrame> parse_dtrack(std::string_view packet, DtrackFaults* refused = nullptr);

}  // namespace afm::input
