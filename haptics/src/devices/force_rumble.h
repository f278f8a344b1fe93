// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace afm::haptics {

// Speeds of the two eccentric-mass motors, 0 to 1: the heavy, slow one and the light, fast one.
struct Rumble {
  double heavy = 0;
  double light = 0;
};

// Renders a force as rumble. A jump, a change within kWindow ticks that no hand on a spring can cause, runs the heavy
// motor: briefly when the pull begins (the tip snaps in), three times as long when it ends (the tip breaks free). The
// light motor hums in proportion to the force. May be called in a tick of the servo, one step per tick of about a
// millisecond.
class ForceRumble {
 public:
  static constexpr std::size_t kWindow = 4;
  static constexpr double kJumpN = 0.06;  // four times the change of a spring of 40 N/m at 0.1 m/s
  static constexpr std::int64_t kSnapNs = 40'000'000;
  static constexpr std::int64_t kReleaseNs = 120'000'000;
  static constexpr double kHumShare = 0.35;
  static constexpr double kFaintN = 0.02;  // force below which the motors are silent

  explicit ForceRumble(double cap_n) : cap_n_(cap_n) {}

  // `force_n`: magnitude of the force on the hand, finite.
  Rumble step(double force_n, std::int64_t now_ns) noexcept;

 private:
  double cap_n_;
  std::array<double, kWindow> before_n_{};  // forces of the last steps
  std::size_t oldest_ = 0;
  std::int64_t shakes_until_ns_ = 0;
};

}  // namespace afm::haptics
