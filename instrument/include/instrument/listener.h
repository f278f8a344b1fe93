// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "instrument/door.h"

namespace afm::instrument {

// Socket at which clients of the same user connect; all others are refused. One thread.
class Listener {
 public:
  // Listener on a Unix socket of mode 0600, in place of one that nobody listens on any more; the destructor and an
  // interruption remove it. WrongUsage for a path that is too long or taken.
  static core::Result<Listener> on_socket(const std::string& path);
  // Listener on a TCP port of 127.0.0.1; zero: any free one. Fails for a port that is taken or not allowed.
  static core::Result<Listener> on_loopback(std::uint16_t port);

  Listener(Listener&&) noexcept;
  Listener& operator=(Listener&&) = delete;
  ~Listener();

  int descriptor() const noexcept { return socket_.get(); }
  std::uint16_t port() const;  // port number of an on_loopback() listener

  // The next client, which does not block; none, if it has left again or is refused.
  core::FileDescriptor accept() const;

 private:
  struct Path;

  Listener(core::FileDescriptor socket, std::unique_ptr<Path> path);

  std::unique_ptr<Path> path_;  // path of the Unix socket; null for TCP
  core::FileDescriptor socket_;
};

// An entrance for clients, with its protocol; both outlive serve().
struct OpenDoor {
  const Listener* listener;
  Door* door;
};

inline constexpr int kPatienceS = 30;

// Answers the clients of all doors, one at a time in each, until one asks to quit or, with `once`, has left. A client
// that does not read its answers for kPatienceS is given up. Fails only if the system does not let it wait.
core::Result<void> serve(std::span<const OpenDoor> doors, bool once);

}  // namespace afm::instrument
