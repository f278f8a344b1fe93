// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/result.h"

namespace afm::haptics {

// A connection to a WebSocket of this machine: text messages, one at a time. One thread, which waits here.
class HaplyLink {
 public:
  HaplyLink();
  HaplyLink(const HaplyLink&) = delete;
  HaplyLink& operator=(const HaplyLink&) = delete;
  ~HaplyLink();

  // In the place of the one before. DeviceMissing: nobody listens at the port, or not as a WebSocket.
  core::Result<void> connect(std::uint16_t port);

  // The next message, of 64 KiB at most; empty once the connection has ended.
  std::optional<std::string> receive();
  bool send(const std::string& message);

  // Ends the connection, so that whoever waits goes on; there will be no other. From any thread.
  void interrupt();

 private:
  struct Socket;
  std::unique_ptr<Socket> socket_;
};

}  // namespace afm::haptics
