// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

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

  // Ends the connection, so that whoever waits goes on; there will be no other. From any thread.
  void interrupt();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

}  // namespace afm::haptics
