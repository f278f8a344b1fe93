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

// A body as a DTrack system of Advanced Realtime Tracking sees it: tracker frame, metres. Not tracked: no pose.
struct DtrackBody {
  std::uint32_t id = 0;
  bool tracked = false;
  glm::dvec3 position_m{0.0};
  glm::dquat tracker_from_body{1.0, 0.0, 0.0, 0.0};
};

struct DtrackFlystick {
  DtrackBody body;
  std::uint32_t buttons = 0;         // the trigger first
  std::array<double, 8> joystick{};  // -1 to 1: to the right, upwards
};

// One datagram. Trivially copyable.
struct DtrackFrame {
  std::uint32_t frame = 0;
  std::uint32_t latency_us = 0;  // from the cameras to the sending, of a line ts2; 0: not said
  std::size_t body_count = 0;
  std::array<DtrackBody, 64> bodies{};
  std::size_t flystick_count = 0;
  std::array<DtrackFlystick, 8> flysticks{};

  const DtrackBody* body(std::uint32_t id) const;
  const DtrackFlystick* flystick(std::uint32_t id) const;
};

// A total function over whatever comes in by UDP: the lines fr, ts2, 6d and 6df2 of DTrack's ASCII output; other lines
// are skipped. Empty: no frame number, or a line that contradicts itself: counts, numbers of bodies below 0 or above
// 63, a rotation that is none.
std::optional<DtrackFrame> parse_dtrack(std::string_view packet);

}  // namespace afm::input
