// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::cluster {

// Network settings of a machine of a wall.
struct ClusterNetwork {
  static constexpr std::uint32_t kUsualDomain = 50, kMostDomain = 230;

  std::string interface_address;        // address of this machine, the only one bound
  std::vector<std::string> peers;       // addresses of the other machines; if set, multicast is not used
  std::uint32_t domain = kUsualDomain;  // DDS domain: walls in different domains do not see each other
};

// UDP ports of a domain (DDS Interoperability Wire Protocol 2.2, section 9.6.1).
inline constexpr std::uint32_t kPortsOfDomain = 250;
constexpr std::uint32_t first_port(std::uint32_t domain) { return 7400 + kPortsOfDomain * domain; }

// Network interface of this machine with an IPv4 address.
struct NetworkInterface {
  std::string name, address;
  bool up = false;
  bool multicast = false;
};
std::vector<NetworkInterface> network_interfaces();

// WrongUsage, with a list of the interfaces: none has this address or name.
core::Result<NetworkInterface> find_interface(const std::string& address_or_name);

// DeviceMissing: the name has no address, or its address is not IPv4.
core::Result<std::string> address_of_host(const std::string& host);

// Address of the interface by which this machine reaches another one.
core::Result<std::string> interface_towards(const std::string& host_address);

// Configuration of Cyclone DDS. The defaults suit other uses: a lost datagram would be repaired after 100 ms, and a
// missing machine noticed after 10 s (docs/decisions/0015).
std::string dds_configuration(const ClusterNetwork& network);

}  // namespace afm::cluster
