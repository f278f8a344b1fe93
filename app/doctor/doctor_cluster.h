// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cluster/cluster_start.h"
#include "app/options/command.h"
#include "exhibit/frame/exhibit_files.h"

namespace afm::app {

struct ClusterCheck {
  std::string wall;  // path of the wall file
  ClusterOptions cluster;
  exhibit::ExhibitFiles files;
  double seconds = 20;  // longest wait for the nodes' answers
  bool json = false;
};

// Acts as the machine with the hand: checks interface, hosts and network, and asks every node of the wall to identify
// itself. Prints a line for each check. Fails if a part of the wall would be missing.
core::Result<void> examine_cluster(const CommandContext& context, const ClusterCheck& check);

}  // namespace afm::app
