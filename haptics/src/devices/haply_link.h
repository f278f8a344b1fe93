// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::haptics {

// A connection to a WebSocket of this machine: text messages, one at a time. One thread, which never waits longer than
// is said.
class HaplyLink {
 public:
  HaplyLink();
  HaplyLink(const HaplyLink&) = delete;
  HaplyLink& operator=(const HaplyLink&) = delete;
  ~HaplyLink();

  // In the place of the one before, within two seconds. DeviceMissing: nobody listens at the port, or not as a
  // WebSocket.
  core::Result<void> connect(std::uint16_t port);

  // The next message; empty if none comes within `patience`, or the connection has ended.
  std::optional<std::string> receive(std::chrono::microseconds patience);

  // Nothing more will be received: the other side left, or began a message of more than 64 KiB. In the second case it
  // can still be sent to.
  bool ended() const;

  // Within 20 ms. False, and ended(): the other side left, or does not read.
  bool send(const std::string& message);

  // Ends the connection so that what was sent is still read, within 100 ms.
  void leave();

  // The connection's socket, on which another process may send a text_frame(); -1 if there is no connection.
  int descriptor() const;

  // Ends the connection for good and wakes every waiting thread. From any thread.
  void interrupt();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

// A text of at most 65535 bytes as it goes over the wire from a client (RFC 6455, section 5.2), masked with zero: there
// is no proxy on the way that a mask would have to protect.
std::string text_frame(std::string_view text);

}  // namespace afm::haptics
