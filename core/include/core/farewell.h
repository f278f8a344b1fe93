// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace afm::core {

// Ends a stream socket so that the peer can still read everything it was sent: shuts down our direction, then discards
// input until the peer closes too, for at most `patience`. The descriptor stays open. Closing a stream with unread
// input resets it, and a peer that writes before it reads would lose our last message (RFC 9293, section 3.6.1). Any
// thread, but no other thread may read from the socket meanwhile.
void take_leave(int socket, std::chrono::milliseconds patience) noexcept;

}  // namespace afm::core
