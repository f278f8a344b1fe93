// SPDX-License-Identifier: Apache-2.0
// Invariant: if a wall has two masters, the later one ends
// Invariant: nothing listens without `--cluster`; with it, only on the named interface
// Invariant: no environment variable changes the network of a wall
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <stdlib.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "cluster/master_link.h"
#include "cluster/network.h"
#include "cluster/node_link.h"
#include "core/clock.h"
#include "core/enumerators.h"
#include "support/scratch_folder.h"
#include "transport.h"

namespace link_test {

using namespace afm;
using namespace afm::cluster;
using testing::HasSubstr;

constexpr std::int64_t kLongestWaitNs = 20'000'000'000;  // limit that ends a hanging test

// A master and a node in one process: DDS passes their messages without the network.
class ClusterLinkTest : public testing::Test {
 protected:
  static ClusterNetwork network(std::uint32_t domain) {
    return {.interface_address = "127.0.0.1", .peers = {"127.0.0.1"}, .domain = domain};
  }

  static std::vector<std::byte> model() { return std::vector<std::byte>(5000, std::byte{42}); }

  bool until(const std::function<bool()>& holds, NodeLink& node) const {
    const std::int64_t end_ns = clock_.now_ns() + kLongestWaitNs;
    while (!holds()) {
      if (clock_.now_ns() > end_ns) return false;
      node.wait(5);
    }
    return true;
  }

  core::MonotonicClock clock_;
};

TEST_F(ClusterLinkTest, CarriesModelFramesJournalHistoryAnswersAndSwaps) {
  const auto master = MasterLink::open(network(201), model(), 0, clock_);
  ASSERT_TRUE(master) << master.error().message;
  const auto node = NodeLink::open(network(201), clock_);
  ASSERT_TRUE(node) << node.error().message;

  std::optional<NodeLink::Document> document;
  ASSERT_TRUE(until([&] { return (document = (*node)->model()).has_value(); }, **node));
  EXPECT_EQ(document->bytes, model());
  EXPECT_EQ(document->header.session, (*master)->session());

  // until DDS has matched writers and readers, frames get lost: the newest comes
  FrameMessage frame;
  std::uint64_t number = 0;
  std::optional<NodeLink::Came> came;
  const auto send_next = [&] {
    (*master)->send(++number, frame);
    return (came = (*node)->frame()).has_value();
  };
  ASSERT_TRUE(until(send_next, **node));
  EXPECT_EQ(came->frame.header.session, (*master)->session());
  EXPECT_LE(came->frame.sent_ns, came->came_ns);

  ReadyMessage ready{.header = came->frame.header, .state = NodeState::Drawing, .digest = 5};
  (*node)->answer(ready);
  std::optional<MasterLink::Answer> answer;
  ASSERT_TRUE(until([&] { return (answer = (*master)->answer()).has_value(); }, **node));
  EXPECT_EQ(answer->ready.digest, 5U);

  (*master)->swap(number);
  ASSERT_TRUE(until([&] { return (*node)->swapped() == std::pair((*master)->session(), number); }, **node));

  scene::TipSample sample;
  sample.material = 0;
  for (int i = 0; i < 50; ++i) {
    sample.tick = static_cast<std::uint64_t>(i);
    (*master)->record(JournalRecord(sample));
  }
  (*master)->send(++number, frame);
  std::vector<NodeLink::Numbered> records;
  const auto all_records = [&] {
    while (const auto next = (*node)->record()) records.push_back(*next);
    return records.size() == 50;
  };
  ASSERT_TRUE(until(all_records, **node));
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].number, i + 1);
    EXPECT_EQ(records[i].record.sample().tick, i);
  }

  const std::vector<std::byte> history(100'000, std::byte{7});
  (*master)->send_history(history);
  const auto send_history = [&] {
    (*master)->send(++number, frame);
    return (document = (*node)->history()).has_value();
  };
  ASSERT_TRUE(until(send_history, **node));
  EXPECT_EQ(document->bytes, history);
  EXPECT_FALSE((*master)->sending_history());
  EXPECT_EQ((*master)->refused() + (*node)->refused(), 0U);
}

// A topic that neither link writes to fails, and so does one whose message is not sent here.
TEST_F(ClusterLinkTest, WritesToEveryTopic) {
  const auto master = MasterLink::open(network(207), model(), 0, clock_);
  ASSERT_TRUE(master) << master.error().message;
  const auto node = NodeLink::open(network(207), clock_);
  ASSERT_TRUE(node) << node.error().message;
  const auto bell = Doorbell::create().value();
  std::array<bool, Transport::kTopics> written{};
  std::vector<std::unique_ptr<Transport>> readers;
  for (const ClusterRole role : {ClusterRole::Node, ClusterRole::Master}) {
    readers.push_back(Transport::open(network(207), role, bell).value());
  }

  std::uint64_t number = 0;
  FrameMessage frame;
  const auto write_all = [&] {
    (*master)->record(JournalRecord());
    (*master)->send_history(model());
    (*master)->swap(++number);
    (*master)->send(number, frame);
    (*node)->answer({.header = {.session = (*master)->session(), .number = number}});
    for (const auto& reader : readers) {
      for (const Transport::Topic topic : core::kEnumerators<Transport::Topic>) {
        reader->take(topic, [&](std::span<const std::byte>) { written[core::index_of(topic)] = true; });
      }
    }
    return std::find(written.begin(), written.end(), false) == written.end();
  };
  until(write_all, **node);
  for (std::size_t i = 0; i < written.size(); ++i) EXPECT_TRUE(written[i]) << "topic " << i << " of Transport::Topic";
}

TEST_F(ClusterLinkTest, ASecondMasterRefusesToDriveTheSameWall) {
  const auto first = MasterLink::open(network(202), model(), 0, clock_);
  ASSERT_TRUE(first) << first.error().message;
  std::atomic<bool> done{false};
  std::jthread frames([&] {
    FrameMessage frame;
    for (std::uint64_t number = 1; !done; ++number) {
      (*first)->send(number, frame);
      (*first)->wait(5);
    }
  });
  const auto second = MasterLink::open(network(202), model(), 20'000, clock_);
  done = true;
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(second.error().message, HasSubstr("another master"));
}

// Two masters that had not heard one another before they began, as if started at the same moment.
TEST_F(ClusterLinkTest, OfTwoMastersTheLaterOneMustEndAndTheNodesComeBackToTheOther) {
  using Rival = MasterLink::Rival;
  // first, because the first to open the domain in a process closes it for all
  const auto node = NodeLink::open(network(203), clock_).value();
  std::array<std::unique_ptr<MasterLink>, 2> masters;
  for (auto& master : masters) master = MasterLink::open(network(203), model(), 0, clock_).value();
  FrameMessage frame;
  std::uint64_t number = 0;
  std::optional<NodeLink::Document> shown;
  const auto go_on = [&] {
    ++number;
    for (const auto& master : masters) {
      if (master) master->send(number, frame);
    }
    if (auto next = node->model()) shown = std::move(next);
  };
  const auto both_know = [&] {
    go_on();
    return masters[0]->rival() != Rival::None && masters[1]->rival() != Rival::None;
  };
  ASSERT_TRUE(until(both_know, *node));
  const bool first_stays = masters[0]->session() < masters[1]->session();
  EXPECT_EQ(masters[0]->rival(), first_stays ? Rival::Later : Rival::Earlier);
  EXPECT_EQ(masters[1]->rival(), first_stays ? Rival::Earlier : Rival::Later);

  masters[first_stays ? 1 : 0].reset();
  const MasterLink& stays = *masters[first_stays ? 0 : 1];
  const auto comes_back = [&] {
    go_on();
    return stays.rival() == Rival::None && shown && shown->header.session == stays.session();
  };
  EXPECT_TRUE(until(comes_back, *node));
}

// The interface to which a socket is bound, if it is one that receives in the domain.
std::optional<std::string> receives_on(int descriptor, std::uint32_t domain) {
  sockaddr_in own{};
  socklen_t length = sizeof(own);
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &length) != 0 || own.sin_family != AF_INET)
    return {};
  if (own.sin_addr.s_addr != htonl(INADDR_ANY)) return {};  // socket used for sending
  const std::uint32_t port = ntohs(own.sin_port);
  if (port < first_port(domain) || port >= first_port(domain) + kPortsOfDomain) return {};
  char name[IFNAMSIZ]{};
  length = sizeof(name);
  ::getsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, name, &length);
  return name;
}

TEST_F(ClusterLinkTest, ReceivesOnTheNamedInterfaceAlone) {
  const auto master = MasterLink::open(network(203), model(), 0, clock_);
  ASSERT_TRUE(master) << master.error().message;
  int receivers = 0;
  for (int descriptor = 0; descriptor < 1024; ++descriptor) {
    const auto interface = receives_on(descriptor, 203);
    if (!interface) continue;
    ++receivers;
    EXPECT_EQ(*interface, "lo");
  }
  EXPECT_GE(receivers, 2);  // sockets for discovery and data
}

// A person's configuration for other programs that use Cyclone has no effect on a wall: here a log of everything.
TEST_F(ClusterLinkTest, IgnoresTheEnvironment) {
  const support::ScratchFolder folder;
  const std::string log = folder.file("dds.log");
  const std::string uri = "<CycloneDDS><Domain Id=\"any\"><Tracing><Verbosity>finest</Verbosity><OutputFile>" + log +
                          "</OutputFile></Tracing></Domain></CycloneDDS>";
  ASSERT_EQ(::setenv("CYCLONEDDS_URI", uri.c_str(), 1), 0);
  const auto master = MasterLink::open(network(204), model(), 0, clock_);
  ::unsetenv("CYCLONEDDS_URI");
  ASSERT_TRUE(master) << master.error().message;
  EXPECT_FALSE(std::filesystem::exists(log));
}

TEST(ClusterNetworkTest, NamesTheInterfacesThereAre) {
  const auto none = find_interface("203.0.113.77");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("127.0.0.1 (lo)"));
  const auto loopback = find_interface("lo");
  ASSERT_TRUE(loopback);
  EXPECT_EQ(loopback->address, "127.0.0.1");
  EXPECT_EQ(interface_towards("127.0.0.1"), "127.0.0.1");
  EXPECT_FALSE(address_of_host("no-such-host.invalid"));
}

TEST(ClusterNetworkTest, ConfiguresRepairLeaseAndInterface) {
  const std::string multicast = dds_configuration({.interface_address = "10.0.0.1", .peers = {}, .domain = 1});
  EXPECT_THAT(multicast, HasSubstr("<NetworkInterface address=\"10.0.0.1\"/>"));
  EXPECT_THAT(multicast, HasSubstr("<AllowMulticast>true</AllowMulticast>"));
  EXPECT_THAT(multicast, HasSubstr("<LeaseDuration>2 s</LeaseDuration>"));
  EXPECT_THAT(multicast, HasSubstr("<NackDelay>0 ms</NackDelay>"));
  const std::string unicast = dds_configuration({.interface_address = "10.0.0.1", .peers = {"10.0.0.2"}, .domain = 1});
  EXPECT_THAT(unicast, HasSubstr("<AllowMulticast>false</AllowMulticast>"));
  EXPECT_THAT(unicast, HasSubstr("<Peers><Peer address=\"10.0.0.2\"/></Peers>"));
}

}  // namespace link_test
