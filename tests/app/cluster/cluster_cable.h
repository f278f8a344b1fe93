// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/cluster/cluster_wall.h"
#include "support/network/lossy_network.h"

namespace afm::app {

// The same wall on three machines, over a network that loses one frame in a hundred.
class ClusterCable : public ClusterWall {
 protected:
  explicit ClusterCable(support::LossyNetwork::Multicast multicast = support::LossyNetwork::Multicast::Carried)
      : network_({{.lost = 0.01}, {.lost = 0.01}, {.lost = 0.01}}, multicast) {
    folder_.write("wall.toml", wall_of_three(support::LossyNetwork::address(1), support::LossyNetwork::address(2)));
  }
  std::unique_ptr<support::LiveProgram> node(const std::string& name, std::size_t machine) const {
    return start(network_.on(machine, node_command(name, support::LossyNetwork::address(machine))));
  }
  support::LossyNetwork network_;
};

}  // namespace afm::app
