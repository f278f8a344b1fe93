// SPDX-License-Identifier: Apache-2.0
#include "devices/waiting_states.h"

#include <utility>

namespace afm::haptics {

WaitingStates::Taken WaitingStates::take(const std::function<std::optional<std::string>(bool first)>& receive,
                                         const std::function<bool()>& late) {
  Taken taken;
  bool last = false;
  for (auto message = receive(true); message; message = receive(false)) {
    taken.asked = true;
    if (auto state = parse_haply_state(*message, wanted_)) last_ = std::move(state);
    if (last) return taken;
    last = late();  // final read, or a slow thread would consider every state outdated
  }
  taken.newest = std::exchange(last_, std::nullopt);
  return taken;
}

}  // namespace afm::haptics
