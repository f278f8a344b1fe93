// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "devices/haply_message.h"

namespace afm::haptics {

// The states that wait at a connection, of which only the newest is a place of the hand: after a stall of this machine
// hundreds wait, each a millisecond older than the next. None is believed until nothing waits behind it. One object a
// connection, one thread.
class WaitingStates {
 public:
  struct Taken {
    bool asked = false;                // the service sent something, and waits for a force
    std::optional<HaplyState> newest;  // with nothing behind it; empty while more wait, or for bytes that are no state
  };

  // `receive` gives the next message, or nothing after its patience, which only the first call of a take may have;
  // `late` says when to stop, for a service that sends without a pause.
  Taken take(const std::function<std::optional<std::string>(bool first)>& receive, const std::function<bool()>& late);

 private:
  std::optional<HaplyState> last_;  // more waited behind it
};

}  // namespace afm::haptics
