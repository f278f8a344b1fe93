// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/file_descriptor.h"
#include "core/result.h"
#include "instrument/json_door.h"

namespace afm::instrument {

// A Unix socket for one client after the other, which only processes of the same user may enter. While one client is
// served the next ones wait in the kernel's queue. One thread.
class SocketServer {
 public:
  // Creates the socket with mode 0600, in place of one that nobody listens on any more. WrongUsage for a path that is too
  // long or taken. The destructor, and an interruption, remove it.
  static core::Result<SocketServer> listen(const std::string& path);
  SocketServer(SocketServer&&) noexcept = default;
  SocketServer& operator=(SocketServer&&) = delete;
  ~SocketServer();

  enum class Clients { One, Many };

  // Answers until "quit"; with Clients::One also until the first client has left. A client that does not read its answers
  // for kPatienceS is given up. Returns an error only if the socket itself fails.
  core::Result<void> run(JsonDoor& door, Clients clients);

 private:
  struct Path;

  SocketServer(std::unique_ptr<Path> path, core::FileDescriptor listener);

  std::unique_ptr<Path> path_;
  core::FileDescriptor listener_;
};

inline constexpr int kPatienceS = 30;

}  // namespace afm::instrument
