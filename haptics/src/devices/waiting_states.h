// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "devices/haply_message.h"

namespace afm::haptics {

// States queued at a connection, of which only the newest is the hand's position: after a stall of this machine
// hundreds are queued, one millisecond apart. A state is used only if nothing is queued behind it. One object per
// connection, one thread.
class WaitingStates {
 public:
  // Accepts only states of the arm with the id `wanted`; empty: of the first arm.
  explicit WaitingStates(std::string wanted = {}) : wanted_(std::move(wanted)) {}

  // Restricts later states to this arm: a force must not move to another hand.
  void keep_to(const std::string& id) { wanted_ = id; }

  struct Taken {
    bool asked = false;                // true: the service has sent something and waits for a force
    std::optional<HaplyState> newest;  // last state in the queue; empty while more are queued, or for invalid bytes
  };

  // `receive` returns the next message, or nothing after its patience, which only the first call may use. `late`
  // returns true when to stop, for a service that sends without pause.
  Taken take(const std::function<std::optional<std::string>(bool first)>& receive, const std::function<bool()>& late);

 private:
  std::string wanted_;
  std::optional<HaplyState> last_;  // newest state so far that was not the last in the queue
};

}  // namespace afm::haptics
