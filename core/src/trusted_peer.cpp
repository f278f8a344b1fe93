// SPDX-License-Identifier: Apache-2.0
#include "core/trusted_peer.h"

#include <sys/socket.h>

namespace afm::core {

std::optional<pid_t> trusted_peer(int socket, uid_t user) noexcept {
  ucred peer{};
  socklen_t size = sizeof(peer);
  const bool known = ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  return known && peer.uid == user ? std::optional(peer.pid) : std::nullopt;
}

}  // namespace afm::core
