// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <string>

#include "core/file_descriptor.h"

namespace afm::support {

// Sends datagrams to a port of this machine.
class LoopbackSender {
 public:
  explicit LoopbackSender(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    to_.sin_family = AF_INET;
    to_.sin_port = htons(port);
    to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  // Sends to a port that was free a moment ago.
  LoopbackSender() : LoopbackSender(0) {
    const core::FileDescriptor probe(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    socklen_t size = sizeof to_;
    EXPECT_EQ(::bind(probe.get(), reinterpret_cast<const sockaddr*>(&to_), size), 0);
    EXPECT_EQ(::getsockname(probe.get(), reinterpret_cast<sockaddr*>(&to_), &size), 0);
  }

  // Sends to all members of a group, only on this machine.
  LoopbackSender(std::uint16_t port, const char* group) : LoopbackSender(port) {
    const in_addr interface{.s_addr = htonl(INADDR_LOOPBACK)};
    EXPECT_EQ(::setsockopt(socket_.get(), IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface), 0);
    EXPECT_EQ(::inet_pton(AF_INET, group, &to_.sin_addr), 1);
  }

  std::uint16_t port() const { return ntohs(to_.sin_port); }

  // Returns false if the system did not accept all of it, as without a listener.
  bool send(const std::string& packet) const {
    return ::sendto(socket_.get(), packet.data(), packet.size(), 0, reinterpret_cast<const sockaddr*>(&to_),
                    sizeof to_) == static_cast<ssize_t>(packet.size());
  }

 private:
  core::FileDescriptor socket_;
  sockaddr_in to_{};
};

}  // namespace afm::support
