// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "cluster/network.h"
#include "core/result.h"

namespace afm::cluster {

// Binds this process's UDP sockets that DDS receives with to the named interface, and counts them. Cyclone DDS before
// 11 opens them for every interface of the machine, whatever its configuration says. Failed: the kernel refuses.
core::Result<std::size_t> bind_receivers(const ClusterNetwork& network);

}  // namespace afm::cluster
