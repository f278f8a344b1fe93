// SPDX-License-Identifier: Apache-2.0
#include "bound_receivers.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <system_error>

#include "core/system_error.h"

namespace afm::cluster {

namespace {

// True for a socket on one of the domain's ports that is not bound to an address.
bool is_receiver(int descriptor, std::uint32_t domain) {
  int type = 0;
  socklen_t length = sizeof(type);
  if (::getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &length) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in own{};
  length = sizeof(own);
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &length) != 0 || own.sin_family != AF_INET) {
    return false;
  }
  const std::uint32_t first = first_port(domain);
  const std::uint32_t port = ntohs(own.sin_port);
  return own.sin_addr.s_addr == htonl(INADDR_ANY) && port >= first && port < first + kPortsOfDomain;
}

}  // namespace

core::Result<std::size_t> bind_receivers(const ClusterNetwork& network) {
  const auto found = find_interface(network.interface_address);
  if (!found) return tl::unexpected(found.error());
  std::size_t bound = 0;
  std::error_code unread;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", unread)) {
    const std::string name = entry.path().filename().string();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (!is_receiver(descriptor, network.domain)) continue;
    if (::setsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, found->name.c_str(),
                     static_cast<socklen_t>(found->name.size())) != 0) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("cannot bind the wall's network to the interface {} alone: {}", found->name,
                                       core::system_error(errno)));
    }
    ++bound;
  }
  if (unread) {
    return core::failure(core::ErrorCategory::Failed, fmt::format("cannot read /proc/self/fd: {}", unread.message()));
  }
  return bound;
}

}  // namespace afm::cluster
