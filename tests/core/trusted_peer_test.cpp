// SPDX-License-Identifier: Apache-2.0
#include "core/trusted_peer.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "core/file_descriptor.h"

namespace afm::core {
namespace trusted_peer_test {

TEST(TrustedPeer, IsAProcessOfTheUserAndOfNobodyElse) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
  const FileDescriptor here(ends[0]), there(ends[1]);
  EXPECT_EQ(trusted_peer(here.get(), ::getuid()), ::getpid());
  EXPECT_EQ(trusted_peer(here.get(), ::getuid() + 1), std::nullopt);
}

TEST(TrustedPeer, IsNobodyWhereThereIsNoSocket) {
  EXPECT_EQ(trusted_peer(-1, ::getuid()), std::nullopt);
  EXPECT_EQ(trusted_peer(-1, 0), std::nullopt);
}

}  // namespace trusted_peer_test
}  // namespace afm::core
