// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cluster/cluster_start.h"
#include "app/options/command.h"
#include "exhibit/frame/exhibit_files.h"

namespace afm::app {

struct ClusterCheck {
  std::string wall;  // a file
  ClusterOptions cluster;
  exhibit::ExhibitFiles files;
  double seconds = 20;  // for the nodes to answer
  bool json = false;
};

// Plays the machine with the hand: checks interface, hosts and network, and asks every node of the wall who it is.
// Prints a line for each check, and fails if the wall would not be whole.
core::Result<void> examine_cluster(const CommandContext& context, const ClusterCheck& check);

}  // namespace afm::app
