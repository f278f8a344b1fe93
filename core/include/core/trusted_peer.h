// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>

namespace afm::core {

// Process at the other end of a connected Unix socket, if it ran as `user` when it connected. Any thread.
std::optional<pid_t> trusted_peer(int socket, uid_t user) noexcept;

}  // namespace afm::core
