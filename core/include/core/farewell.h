// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace afm::core {

// Ends a stream socket so that the other side can still read what it was sent: says that nothing follows, then takes
// and forgets what comes until the other side ends too, at most for `patience`. The descriptor stays open. A stream
// that is closed over something unread is reset, and a peer that writes before it reads loses the last message (RFC
// 9293, section 3.6.1). Any thread; no other may read from the socket meanwhile.
void take_leave(int socket, std::chrono::milliseconds patience) noexcept;

}  // namespace afm::core
