// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace afm::haptics {

// Means by which another process releases the hand if the servo cannot: it writes `zero` in one piece to a duplicate of
// `descriptor`, a stream socket.
struct ReleasePath {
  int descriptor = -1;
  std::string zero;
};

// Called by a driver's own thread whenever its connection to the device has changed; the descriptor is open during the
// call only. Must not throw or block.
using OfferReleasePath = std::function<void(const ReleasePath&)>;

}  // namespace afm::haptics
