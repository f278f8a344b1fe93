// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "cluster/network.h"
#include "core/result.h"

namespace afm::cluster {

// Binds the UDP sockets on which this process receives DDS data to the named interface, and returns their number.
// Cyclone DDS before 11 opens them on all interfaces, whatever its configuration. Failed: the kernel refuses.
core::Result<std::size_t> bind_receivers(const ClusterNetwork& network);

}  // namespace afm::cluster
