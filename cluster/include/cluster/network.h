// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::cluster {

// How a machine of a wall is reached.
struct ClusterNetwork {
  static constexpr std::uint32_t kUsualDomain = 50, kMostDomain = 230;

  std::string interface_address;        // of this machine: the only one that is bound
  std::vector<std::string> peers;       // addresses; with them no multicast is used
  std::uint32_t domain = kUsualDomain;  // of DDS: walls of different domains do not see each other
};

// The UDP ports of a domain (DDS Interoperability Wire Protocol 2.2, section 9.6.1).
inline constexpr std::uint32_t kPortsOfDomain = 250;
constexpr std::uint32_t first_port(std::uint32_t domain) { return 7400 + kPortsOfDomain * domain; }

// A network interface of this machine that has an IPv4 address.
struct NetworkInterface {
  std::string name, address;
  bool up = false;
  bool multicast = false;
};
std::vector<NetworkInterface> network_interfaces();

// WrongUsage, naming those there are: no interface has this address or this name.
core::Result<NetworkInterface> find_interface(const std::string& address_or_name);

// DeviceMissing: the name has no address, or the address is no IPv4 address.
core::Result<std::string> address_of_host(const std::string& host);

// The address of the interface by which this machine reaches another one.
core::Result<std::string> interface_towards(const std::string& host_address);

// The configuration of Cyclone DDS. Its defaults are made for other uses: a lost datagram would be repaired after
// 100 ms, a machine that is gone be noticed after 10 s (docs/decisions/0015).
std::string dds_configuration(const ClusterNetwork& network);

}  // namespace afm::cluster
