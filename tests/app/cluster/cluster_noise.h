// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "cluster/network.h"

namespace afm::app {

// Datagrams of the wall, as visible to anyone on its network.
inline std::vector<std::string> overheard(std::uint32_t first_port) {
  std::vector<std::string> datagrams;
  const int listener = ::socket(AF_PACKET, SOCK_DGRAM, htons(0x0800));
  EXPECT_GE(listener, 0) << "listening to a network needs root";
  const timeval patience{.tv_sec = 5, .tv_usec = 0};
  ::setsockopt(listener, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  std::array<char, 2048> packet{};
  ssize_t size = 0;
  while (datagrams.size() < 200 && (size = ::recv(listener, packet.data(), packet.size(), 0)) > 0) {
    constexpr std::size_t kIpHeader = 20, kUdpHeader = 8;
    if (static_cast<std::size_t>(size) <= kIpHeader + kUdpHeader || packet[9] != IPPROTO_UDP) continue;
    const auto port = static_cast<std::uint32_t>(static_cast<unsigned char>(packet[kIpHeader + 2]) << 8 |
                                                 static_cast<unsigned char>(packet[kIpHeader + 3]));
    if (port < first_port || port >= first_port + cluster::kPortsOfDomain) continue;
    datagrams.emplace_back(packet.data() + kIpHeader + kUdpHeader, packet.data() + size);
  }
  ::close(listener);
  return datagrams;
}

// Sends these datagrams again, cut and with other bytes, to discovery and data ports of the first three programs.
inline void send_broken_datagrams(std::uint32_t first_port, int count) {
  const std::vector<std::string> seen = overheard(first_port);
  ASSERT_EQ(seen.size(), 200U);
  const int sender = ::socket(AF_INET, SOCK_DGRAM, 0);
  std::mt19937 random(18);
  const auto below = [&](std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most - 1)(random); };
  for (int i = 0; i < count; ++i) {
    std::string datagram = seen[below(seen.size())];
    if (i % 4 == 0) datagram.resize(1 + below(datagram.size()));
    for (std::size_t byte = 0, changed = 1 + below(4); byte < changed; ++byte) {
      datagram[below(datagram.size())] = static_cast<char>(random());
    }
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(first_port + 10 + below(6)));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::sendto(sender, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof(to));
    // so that a full buffer does not drop most datagrams
    if (i % 100 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::close(sender);
}

}  // namespace afm::app
