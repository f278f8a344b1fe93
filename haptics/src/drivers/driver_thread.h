// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <thread>

#include "haptics/realtime.h"

namespace afm::haptics {

// Thread of a driver that carries a force. It gets the servo's scheduling, because a force is as old as the slowest
// thread on its way to the hand.
class DriverThread {
 public:
  DriverThread() = default;

  // Starts `body`, which must not throw; returns once the thread has its scheduling, and logs what was refused.
  explicit DriverThread(std::function<void()> body);

  void join();  // waits for the end of a started thread

  bool is_realtime() const noexcept { return grant_.priority > 0; }

 private:
  RealtimeGrant grant_;
  std::thread thread_;
};

}  // namespace afm::haptics
