// SPDX-License-Identifier: Apache-2.0
#include "cluster/network.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <memory>

#include "core/file_descriptor.h"
#include "core/system_error.h"

namespace afm::cluster {

namespace {

std::string text_of(const sockaddr* address) {
  char text[INET_ADDRSTRLEN]{};
  const auto* const internet = reinterpret_cast<const sockaddr_in*>(address);
  ::inet_ntop(AF_INET, &internet->sin_addr, text, sizeof(text));
  return text;
}

}  // namespace

std::vector<NetworkInterface> network_interfaces() {
  ifaddrs* first = nullptr;
  if (::getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> all(first, ::freeifaddrs);
  std::vector<NetworkInterface> found;
  for (const ifaddrs* entry = all.get(); entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    found.push_back({.name = entry->ifa_name,
                     .address = text_of(entry->ifa_addr),
                     .up = (entry->ifa_flags & IFF_UP) != 0 && (entry->ifa_flags & IFF_RUNNING) != 0,
                     .multicast = (entry->ifa_flags & IFF_MULTICAST) != 0});
  }
  return found;
}

core::Result<NetworkInterface> find_interface(const std::string& address_or_name) {
  const std::vector<NetworkInterface> all = network_interfaces();
  const auto found = std::find_if(all.begin(), all.end(), [&](const NetworkInterface& one) {
    return one.address == address_or_name || one.name == address_or_name;
  });
  if (found != all.end()) return *found;
  std::string list;
  for (const NetworkInterface& one : all)
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", one.address, one.name);
  return core::wrong_usage(fmt::format("--interface: this machine has no interface \"{}\"; choose from: {}",
                                       address_or_name, list.empty() ? "none" : list));
}

core::Result<std::string> address_of_host(const std::string& host) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* first = nullptr;
  if (const int code = ::getaddrinfo(host.c_str(), nullptr, &wanted, &first); code != 0) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("host \"{}\" has no IPv4 address: {}", host, ::gai_strerror(code)));
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> all(first, ::freeaddrinfo);
  return text_of(all->ai_addr);
}

core::Result<std::string> interface_towards(const std::string& host_address) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(7400);
  const core::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in own{};
  socklen_t length = sizeof(own);
  // sends no datagram: the kernel reports the route
  if (!socket.is_open() || ::inet_pton(AF_INET, host_address.c_str(), &to.sin_addr) != 1 ||
      ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&to), sizeof(to)) != 0 ||
      ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&own), &length) != 0) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("no network interface leads to {}: {}; name one with --interface", host_address,
                                     core::system_error(errno)));
  }
  return text_of(reinterpret_cast<const sockaddr*>(&own));
}

std::string dds_configuration(const ClusterNetwork& network) {
  std::string peers;
  for (const std::string& peer : network.peers) peers += fmt::format("<Peer address=\"{}\"/>", peer);
  const bool multicast = network.peers.empty();
  return fmt::format(
      "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface address=\"{}\"/></Interfaces>"
      "<AllowMulticast>{}</AllowMulticast><MaxMessageSize>1400B</MaxMessageSize></General>"
      "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>64</MaxAutoParticipantIndex>{}"
      "<SPDPInterval>500 ms</SPDPInterval><LeaseDuration>2 s</LeaseDuration></Discovery>"
      "<Internal><HeartbeatInterval min=\"2 ms\" minsched=\"2 ms\" max=\"100 ms\">4 ms</HeartbeatInterval>"
      "<NackDelay>0 ms</NackDelay><AckDelay>0 ms</AckDelay><PreEmptiveAckDelay>2 ms</PreEmptiveAckDelay>"
      "<MaxSampleSize>64 kB</MaxSampleSize></Internal>"
      "<Tracing><Verbosity>none</Verbosity></Tracing></Domain></CycloneDDS>",
      network.interface_address, multicast ? "true" : "false",
      multicast ? "" : fmt::format("<Peers>{}</Peers>", peers));
}

}  // namespace afm::cluster
