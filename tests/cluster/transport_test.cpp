// SPDX-License-Identifier: Apache-2.0
#include "transport.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace transport_test {

using namespace afm;
using namespace afm::cluster;

// A write may take seconds when a cable is out: the frame loop must not make one, and would end at once.
TEST(ClusterTransportDeathTest, EndsTheProgramWhereAThreadWritesThatDoesNotOwnIt) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const std::array<std::byte, 4> datagram{};
  const auto open = [](const Doorbell& bell) {
    return Transport::open({.interface_address = "127.0.0.1", .peers = {"127.0.0.1"}, .domain = 205},
                           ClusterRole::Master, bell)
        .value();
  };
  const auto bell = Doorbell::create().value();
  EXPECT_TRUE(open(bell)->write(Transport::Topic::Swap, 0, datagram));
  const auto write_elsewhere = [&] {
    const auto transport = open(bell);
    std::jthread([&] { transport->belong_to_this_thread(); }).join();
    transport->write(Transport::Topic::Swap, 0, datagram);
  };
  EXPECT_DEATH(write_elsewhere(), "owner_ == std::this_thread::get_id");
}

}  // namespace transport_test
