// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::core {

constexpr double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

// Monotonic time in nanoseconds. Code that needs time takes a Clock. Only the programs create a real one: their main
// functions, commands and live window, and the code that runs the servo as a thread.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;
  virtual std::int64_t now_ns() const noexcept = 0;
};

// CLOCK_MONOTONIC, the same clock in every process of the machine. Any thread.
class MonotonicClock final : public Clock {
 public:
  std::int64_t now_ns() const noexcept override;
};

}  // namespace afm::core
