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
  std::vector<double> skew_ms;          // of a frame: between the first and the last node that shows it
  std::vector<double> latency_ms;       // from the sending of a frame to its showing at the slowest node
  std::vector<double> barrier_ms;       // that the master waited
  std::vector<double> round_ms;         // of a frame and its answer, without the time that the node took
  std::vector<double> clock_ms;         // by how much each node's clock is ahead of the master's
  std::vector<std::uint64_t> timeouts;  // of each node
  std::vector<std::uint64_t> lost;      // records of the journal that a node did not get
  std::uint64_t resent_bytes = 0;       // by the master, since they were lost on the way
  double cpu_share = 0;                 // of the master's process
};

// Drives nodes that only answer_frames(): in each frame a message, 17 samples, the barrier. Failed: they do not come.
core::Result<ClusterTiming> time_cluster(const cluster::ClusterNetwork& network, const ClusterTimingPlan& plan,
                                         const core::Clock& clock);

// A node that draws by sleeping for 2 ms; until the master has been silent for `patience_ms`, or a signal comes.
core::Result<void> answer_frames(const cluster::ClusterNetwork& network, std::uint32_t node, int patience_ms,
                                 const core::Clock& clock);

}  // namespace afm::app
