// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cluster/network.h"
#include "core/clock.h"
#include "core/result.h"

namespace afm::app {

struct ClusterTimingPlan {
  std::uint32_t nodes = 3;
  std::uint32_t frames = 600;
  double frames_per_s = 60;
};

struct ClusterTiming {
  std::uint32_t frames = 0;
  std::vector<double> skew_ms;          // time between the first and the last node's display of a frame
  std::vector<double> latency_ms;       // time from the sending of a frame to its display at the slowest node
  std::vector<double> barrier_ms;       // wait of the master at the barrier
  std::vector<double> round_ms;         // round trip of a frame to a node, without the node's processing time
  std::vector<double> clock_ms;         // lead of each node's clock over the master's
  std::vector<std::uint64_t> timeouts;  // number for each node
  std::vector<std::uint64_t> lost;      // number of journal records that each node did not receive
  std::uint64_t resent_bytes = 0;       // bytes lost on the way and sent again by the master
  double cpu_share = 0;                 // the master process's share of one CPU
};

// Drives nodes that only answer_frames(): each frame is a message, 17 samples and the barrier. Failed if the nodes do
// not join.
core::Result<ClusterTiming> time_cluster(const cluster::ClusterNetwork& network, const ClusterTimingPlan& plan,
                                         const core::Clock& clock);

// A node that simulates drawing by sleeping for 2 ms. Returns after a signal or `patience_ms` without the master.
core::Result<void> answer_frames(const cluster::ClusterNetwork& network, std::uint32_t node, int patience_ms,
                                 const core::Clock& clock);

}  // namespace afm::app
