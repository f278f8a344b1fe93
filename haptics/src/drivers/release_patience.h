// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <thread>

namespace afm::haptics {

// Time that a driver's destructor waits for its thread to release the hand.
inline constexpr auto kReleasePatience = std::chrono::milliseconds(50);

// Polls the condition every millisecond; false if it does not become true in time.
template <class Condition>
bool wait_until(std::chrono::milliseconds patience, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace afm::haptics
