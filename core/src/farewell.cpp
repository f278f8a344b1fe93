// SPDX-License-Identifier: Apache-2.0
#include "core/farewell.h"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>

namespace afm::core {

void take_leave(int socket, std::chrono::milliseconds patience) noexcept {
  if (::shutdown(socket, SHUT_WR) != 0) return;
  const auto end = std::chrono::steady_clock::now() + patience;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return;
    pollfd watched{.fd = socket, .events = POLLIN, .revents = 0};
    if (::poll(&watched, 1, static_cast<int>(left.count())) <= 0 && errno != EINTR) return;
    std::array<char, 4096> forgotten{};
    const auto taken = ::recv(socket, forgotten.data(), forgotten.size(), MSG_DONTWAIT);
    if (taken == 0 || (taken < 0 && errno != EAGAIN && errno != EINTR)) return;
  }
}

}  // namespace afm::core
