// SPDX-License-Identifier: Apache-2.0
// Invariant: the frame loop and the heartbeat never call DDS, which one thread uses
#include "transport.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <thread>
#include <vector>

#include "cluster/messages.h"
#include "network_lines.h"

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

TEST(ClusterTransport, CarriesNoDatagramBeyondItsBound) {
  const auto bell = Doorbell::create().value();
  const auto transport = Transport::open({.interface_address = "127.0.0.1", .peers = {"127.0.0.1"}, .domain = 206},
                                         ClusterRole::Master, bell)
                             .value();
  EXPECT_TRUE(transport->write(Transport::Topic::Frame, 0, std::vector<std::byte>(kMostDatagramBytes)));
  EXPECT_FALSE(transport->write(Transport::Topic::Frame, 0, std::vector<std::byte>(kMostDatagramBytes + 1)));
}

TEST(NetworkLines, LogTheFirstAndThenOneAMinuteWithTheNumberLeftOut) {
  constexpr std::int64_t kPauseNs = NetworkLines::kPauseNs;
  NetworkLines lines;
  EXPECT_EQ(lines.line("malformed packet\n", 5), "cluster: DDS reports: malformed packet");
  for (int i = 0; i < 621; ++i) EXPECT_EQ(lines.line("malformed packet\n", 6), std::nullopt);
  EXPECT_EQ(lines.line("another", 5 + kPauseNs), "cluster: DDS reports: another (621 more lines before it)");
  const auto longest = lines.line(std::string(400, 'x'), 5 + 2 * kPauseNs);
  ASSERT_TRUE(longest);
  EXPECT_LT(longest->size(), NetworkLines::kLongest + 30);
  EXPECT_TRUE(longest->ends_with("x ..."));
}

}  // namespace transport_test
