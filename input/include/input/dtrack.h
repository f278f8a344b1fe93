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
  std::uint32_t buttons = 0;         // trigger first
  std::array<double, 8> joystick{};  // -1 to 1: right, up
};

// One datagram. Trivially copyable.
struct DtrackFrame {
  std::uint32_t frame = 0;
  std::uint32_t latency_us = 0;  // from the cameras to sending, from line ts2; 0: unknown
  std::size_t body_count = 0;
  std::array<DtrackBody, 64> bodies{};
  std::size_t flystick_count = 0;
  std::array<DtrackFlystick, 8> flysticks{};

  const DtrackBody* body(std::uint32_t id) const;
  const DtrackFlystick* flystick(std::uint32_t id) const;
};

// Parses any UDP datagram: the lines fr, ts2, 6d and 6df2 of DTrack's ASCII output; other lines are skipped. Empty: no
// frame number, or an inconsistent line: wrong counts, body numbers below 0 or above 63, an invalid rotation.
std::optional<DtrackFrame> parse_dtrack(std::string_view packet);

}  // namespace afm::input
