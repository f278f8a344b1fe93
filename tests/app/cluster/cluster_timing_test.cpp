// SPDX-License-Identifier: Apache-2.0
#include "app/bench/cluster_timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

#include "cluster/node_link.h"
#include "core/clock.h"

namespace afm::app {
namespace cluster_timing_test {

using ::testing::ElementsAre;

// One node in this process, which reports for each frame the number of samples missing so far; frames count from the
// first received one. The measurement begins with the 34th or a little later.
class ClusterTimingTest : public ::testing::Test {
 protected:
  using Lacks = std::function<std::uint64_t(std::uint64_t frame)>;

  std::vector<std::uint64_t> lost(std::uint32_t domain, const Lacks& lacks) const {
    const cluster::ClusterNetwork network{.interface_address = "127.0.0.1", .peers = {"127.0.0.1"}, .domain = domain};
    const std::jthread node([&](const std::stop_token& stop) { answer(network, lacks, stop); });
    const auto timing = time_cluster(network, {.nodes = 1, .frames = 30, .frames_per_s = 100.0}, clock_);
    EXPECT_TRUE(timing) << timing.error().message;
    return timing ? timing->lost : std::vector<std::uint64_t>();
  }

 private:
  void answer(const cluster::ClusterNetwork& network, const Lacks& lacks, const std::stop_token& stop) const {
    const auto link = cluster::NodeLink::open(network, clock_);
    std::uint64_t first = 0;
    while (link && !stop.stop_requested()) {
      const auto came = (*link)->frame();
      if (!came) {
        (*link)->wait(5);
        continue;
      }
      const cluster::ClusterHeader& header = came->frame.header;
      if (first == 0) first = header.number;
      (*link)->answer(
          {.header = header, .state = cluster::NodeState::Drawing, .lost_records = lacks(header.number - first)});
    }
  }

  core::MonotonicClock clock_;
};

TEST_F(ClusterTimingTest, DoesNotCountWhatANodeLackedWhenItCame) {
  // noticed after it was waited for, as with a line that delays
  EXPECT_THAT(lost(211, [](std::uint64_t frame) { return frame < 10 ? 0U : 5U; }), ElementsAre(0U));
}

TEST_F(ClusterTimingTest, CountsWhatANodeLacksLater) {
  EXPECT_THAT(lost(212, [](std::uint64_t frame) { return frame < 10 ? 0U : frame < 45 ? 5U : 12U; }), ElementsAre(7U));
}

TEST_F(ClusterTimingTest, CountsAllThatANodeLacksThatWasStartedAnew) {
  EXPECT_THAT(lost(213, [](std::uint64_t frame) { return frame < 45 ? 1000U : 3U; }), ElementsAre(3U));
}

}  // namespace cluster_timing_test
}  // namespace afm::app
