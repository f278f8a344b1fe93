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
  std::vector<double> skew_ms;          // a frame's time between the first and the last node that shows it
  std::vector<double> latency_ms;       // from the sending of a frame to its showing at the slowest node
  std::vector<double> barrier_ms;       // the master's wait at the barrier
  std::vector<double> round_ms;         // a frame's way to a node and back, without the node's processing time
  std::vector<double> clock_ms;         // by how much each node's clock is ahead of the master's
  std::vector<std::uint64_t> timeouts;  // one number for each node
  std::vector<std::uint64_t> lost;      // records of the journal that a node did not get
  std::uint64_t resent_bytes = 0;       // lost on the way and sent again by the master
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
