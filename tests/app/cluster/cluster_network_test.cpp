// SPDX-License-Identifier: Apache-2.0
// The messages of a wall over a network that loses and delays, between namespaces: numbers and completeness decide.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "app/cluster/cluster_cable.h"
#include "core/percentiles.h"
#include "core/whole_file.h"
#include "support/frame_log.h"
#include "support/places.h"

namespace afm::app {
namespace cluster_network_test {

using support::LossyNetwork;
using ::testing::Each;
using ::testing::SizeIs;

constexpr std::size_t kNodes = 3;

class ClusterNetworkTest : public ::testing::Test {
 protected:
  // The master is machine 0.
  void connect(std::vector<LossyNetwork::Line> lines) { network_ = std::make_unique<LossyNetwork>(std::move(lines)); }

  std::unique_ptr<support::LiveProgram> node(std::size_t number) const {
    return std::make_unique<support::LiveProgram>(
        network_->on(number + 1, {support::touchafm(), "bench", "cluster", "--answer", std::to_string(number),
                                  "--interface", LossyNetwork::address(number + 1)}),
        "");
  }
  void start_nodes() {
    for (std::size_t i = 0; i < kNodes; ++i) nodes_.push_back(node(i));
  }
  std::string master(int frames) const {
    std::string line;
    for (const std::string& word : network_->on(
             0, {support::touchafm(), "bench", "cluster", "--elsewhere", "--json", "--nodes", std::to_string(kNodes),
                 "--frames", std::to_string(frames), "--interface", LossyNetwork::address(0)})) {
      line += word + " ";
    }
    return line;
  }
  nlohmann::json measure(int frames) const {
    const support::ProgramResult result = support::run_program(master(frames));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::printf("%s", result.out.c_str());
    return nlohmann::json::parse(result.out, nullptr, false);
  }
  static int late(const nlohmann::json& result) {
    int all = 0;
    for (const int each : result.at("timeouts")) all += each;
    return all;
  }

  support::ScratchFolder folder_;
  std::unique_ptr<LossyNetwork> network_;
  std::vector<std::unique_ptr<support::LiveProgram>> nodes_;
};

TEST_F(ClusterNetworkTest, WithoutLossNoSampleIsMissing) {
  connect({{}, {}, {}, {}});
  start_nodes();
  const auto result = measure(600);
  EXPECT_THAT(result.at("lost_samples"), Each(0));
  EXPECT_EQ(network_->lost(), 0U);
}

TEST_F(ClusterNetworkTest, OnePercentLossIsRepairedWithoutAMissingSample) {
  connect({{.lost = 0.01}, {.lost = 0.01}, {.lost = 0.01}, {.lost = 0.01}});
  start_nodes();
  const auto result = measure(600);
  EXPECT_GT(network_->lost(), 50U);
  EXPECT_GT(result.at("resent_bytes").get<std::uint64_t>(), 0U);
  EXPECT_THAT(result.at("lost_samples"), Each(0));
}

TEST_F(ClusterNetworkTest, FivePercentLossGivesUpNoNode) {
  connect({{.lost = 0.05}, {.lost = 0.05}, {.lost = 0.05}, {.lost = 0.05}});
  start_nodes();
  const auto result = measure(600);
  EXPECT_GT(network_->lost(), 250U);
  EXPECT_THAT(result.at("lost_samples"), Each(0));
  EXPECT_LE(late(result), 2 * 6 * static_cast<int>(kNodes));  // twice one in a hundred
}

TEST_F(ClusterNetworkTest, ADelayOfOneNodeIsMeasuredAndWaitedFor) {
  connect({{}, {.delay_ms = 2.0, .jitter_ms = 1.0}, {}, {}});
  start_nodes();
  const auto result = measure(300);
  EXPECT_THAT(result.at("lost_samples"), Each(0));
  EXPECT_GT(result.at("round_trip_s").at("max").get<double>(), 0.002);
  // all machines share one clock here, so the result is at most half of the difference of both directions
  EXPECT_THAT(result.at("clock_offset_s"), SizeIs(kNodes));
  for (const double offset_s : result.at("clock_offset_s")) EXPECT_LT(std::abs(offset_s), 0.001);
}

TEST_F(ClusterNetworkTest, AKilledNodeCostsThreeFramesAndReturns) {
  connect({{}, {}, {}, {}});
  start_nodes();
  support::LiveProgram hand({"/bin/sh", "-c", master(600) + " >" + folder_.file("out") + " 2>&1"}, "");
  std::this_thread::sleep_for(std::chrono::seconds(4));
  nodes_[0]->signal(SIGKILL);
  nodes_[0]->ends();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  nodes_[0] = node(0);
  ASSERT_EQ(hand.ends(), 0) << core::read_file(folder_.file("out")).value();
  const auto result = nlohmann::json::parse(core::read_file(folder_.file("out")).value());
  EXPECT_GE(result.at("timeouts")[0].get<int>(), 3);
  EXPECT_THAT(result.at("lost_samples"), SizeIs(kNodes));
  EXPECT_EQ(result.at("lost_samples")[1], 0);
  EXPECT_EQ(result.at("lost_samples")[2], 0);
}

TEST_F(ClusterNetworkTest, ACableThatIsPulledForTwoSecondsCostsThreeFrames) {
  connect({{}, {}, {}, {}});
  start_nodes();
  support::LiveProgram hand({"/bin/sh", "-c", master(900) + " >" + folder_.file("out") + " 2>&1"}, "");
  std::this_thread::sleep_for(std::chrono::seconds(4));
  network_->pull_cable(1);
  std::this_thread::sleep_for(std::chrono::seconds(2));
  network_->plug_cable(1);
  ASSERT_EQ(hand.ends(), 0) << core::read_file(folder_.file("out")).value();
  const auto result = nlohmann::json::parse(core::read_file(folder_.file("out")).value());
  EXPECT_GE(result.at("timeouts")[0].get<int>(), 3);
  EXPECT_EQ(result.at("lost_samples")[1], 0);
  EXPECT_EQ(result.at("lost_samples")[2], 0);
}

// The wall itself over such a network.
class ClusterCableTest : public ClusterCable {
 protected:
};

TEST_F(ClusterCableTest, IsPulledAndTheHandNeverNotices) {
  const auto left = node("left", 1);
  const auto right = node("right", 2);
  std::vector<std::string> command = master_command();
  command.insert(command.end(), {"--haptics", "sim", "--material", "mica", "--frame-log", folder_.file("frames.csv")});
  const auto hand = start(network_.on(0, command));
  expect_both_shown(*hand);
  press_at_master("1");
  ASSERT_TRUE(hand->says("force on")) << hand->said();
  ASSERT_TRUE(hand->says("jump to contact")) << hand->said();
  network_.pull_cable(1);
  ASSERT_TRUE(hand->says("node left is missing")) << hand->said();
  ASSERT_TRUE(hand->says("jump to contact")) << hand->said();
  network_.plug_cable(1);
  ASSERT_TRUE(hand->says("node left shows the wall")) << hand->said();
  // the force lasts, whatever the network does: a renderer that is silent for 250 ms would end it
  EXPECT_THAT(hand->said(), ::testing::Not(::testing::HasSubstr("the renderer gave no frame")));
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
  EXPECT_THAT(hand->said(), ::testing::Not(::testing::HasSubstr("built frame")));
  EXPECT_GT(network_.lost(), 0U);
  const core::Percentiles between = core::percentiles(support::intervals_ms(folder_.file("frames.csv")));
  EXPECT_GT(between.max, 0.0);
  std::printf("frames of the machine with the hand, a cable pulled and plugged: %.0f ms apart (p50), %.0f ms at most\n",
              between.p50, between.max);
}

class ClusterWithoutMulticastTest : public ClusterCable {
 protected:
  ClusterWithoutMulticastTest() : ClusterCable(LossyNetwork::Multicast::Forbidden) {}

  // The sockets of a machine that receive UDP, with the interface that they are bound to: "10.77.0.1%t0:7400".
  std::vector<std::string> receivers(std::size_t machine) const {
    std::string line;
    for (const std::string& word : network_.on(machine, {"ss", "-H", "-u", "-l", "-n"})) line += word + " ";
    const support::ProgramResult listed = support::run_program(line);
    EXPECT_EQ(listed.exit_code, 0) << listed.err;
    std::vector<std::string> found;
    std::istringstream rows(listed.out);
    for (std::string row; std::getline(rows, row);) {
      std::istringstream words(row);
      std::string state, received, sent, address;
      words >> state >> received >> sent >> address;
      found.push_back(address);
    }
    return found;
  }
};

TEST_F(ClusterWithoutMulticastTest, NodesThatNameTheirMasterShowTheWallAndOnlyTheNamedInterfaceIsHeard) {
  std::vector<std::string> command = master_command();
  std::erase(command, "--cluster");
  command.insert(command.end(), {"--size", "160x120"});
  const auto alone = start(network_.on(0, command));
  ASSERT_TRUE(alone->says("Choose a sample")) << alone->said();
  EXPECT_THAT(receivers(0), ::testing::IsEmpty());
  alone->signal(SIGTERM);
  EXPECT_EQ(alone->ends(), 0) << alone->said();

  std::vector<std::unique_ptr<support::LiveProgram>> nodes;
  for (const std::size_t machine : {1U, 2U}) {
    std::vector<std::string> with_master =
        node_command(machine == 1 ? "left" : "right", LossyNetwork::address(machine));
    with_master.insert(with_master.end(), {"--master", LossyNetwork::address(0)});
    nodes.push_back(start(network_.on(machine, with_master)));
  }
  const auto hand = start(network_.on(0, master_command()));
  expect_both_shown(*hand);
  for (const std::size_t machine : {0U, 1U, 2U}) {
    const std::vector<std::string> all = receivers(machine);
    EXPECT_GE(all.size(), 2U);
    EXPECT_THAT(all, Each(::testing::AnyOf(::testing::HasSubstr("%t0:"),
                                           ::testing::StartsWith(LossyNetwork::address(machine) + ":"))));
  }
  press_at_master("Escape");
  EXPECT_EQ(hand->ends(), 0) << hand->said();
}

}  // namespace cluster_network_test
}  // namespace afm::app
