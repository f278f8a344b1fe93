// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>

namespace afm::haptics {

struct TimedForce {
  std::int64_t time_ns = 0;
  glm::dvec3 force_n{0.0};
};

// Trust of a driver in the servo: a command older than kStaleNs fades to exactly zero within kReleaseNs, and returns
// over kReturnNs. Starts without trust. One thread, the driver's.
class CommandFade {
 public:
  static constexpr std::int64_t kStaleNs = 5'000'000;
  static constexpr std::int64_t kReleaseNs = 10'000'000;
  static constexpr std::int64_t kReturnNs = 100'000'000;

  // Part of the command that may be felt at `now_ns`, `elapsed_ns` after the last call.
  glm::dvec3 weighed_n(const TimedForce& command, std::int64_t now_ns, std::int64_t elapsed_ns) noexcept {
    const bool stale = now_ns - command.time_ns > kStaleNs;
    // in whole nanoseconds, so that the fade ends at exactly zero
    const std::int64_t change_ns = stale ? -elapsed_ns * (kReturnNs / kReleaseNs) : elapsed_ns;
    trust_ns_ = std::clamp<std::int64_t>(trust_ns_ + change_ns, 0, kReturnNs);
    return static_cast<double>(trust_ns_) / static_cast<double>(kReturnNs) * command.force_n;
  }

  // The next commands return over kReturnNs.
  void lose() noexcept { trust_ns_ = 0; }

 private:
  std::int64_t trust_ns_ = 0;  // time of regained trust; 0: command ignored; kReturnNs: command applied fully
};

}  // namespace afm::haptics
