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

// WebSocket connection to a service on this machine: text messages, one at a time. One thread, which never waits longer
// than stated.
class HaplyLink {
 public:
  HaplyLink();
  HaplyLink(const HaplyLink&) = delete;
  HaplyLink& operator=(const HaplyLink&) = delete;
  ~HaplyLink();

  // Replaces the previous connection, within two seconds. DeviceMissing: nothing listens at the port, or not as a
  // WebSocket.
  core::Result<void> connect(std::uint16_t port);

  // Next message; empty if none arrives within `patience`, or the connection has ended.
  std::optional<std::string> receive(std::chrono::microseconds patience);

  // True if nothing more can be received: the peer left, or began a message of more than 64 KiB. In the second case,
  // sending still works.
  bool ended() const;

  // Sends within 20 ms. Returns false if the peer left or does not read; ended() is then true.
  bool send(const std::string& message);

  // Ends the connection so that sent data are still read, within 100 ms.
  void leave();

  // Socket of the connection, on which another process may send a text_frame(); -1 if there is no connection.
  int descriptor() const;

  // Ends the connection for good and wakes every waiting thread. Any thread.
  void interrupt();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

// Encodes a text of at most 65535 bytes as a client's frame (RFC 6455, section 5.2). The mask is zero, because there is
// no proxy to protect.
std::string text_frame(std::string_view text);

}  // namespace afm::haptics
