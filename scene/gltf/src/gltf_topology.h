// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/graph/scene.h"

namespace afm::scene {

// glTF's seven modes (2.0, section 3.7.2.1), of which strips, fans and loops are turned into lists here.
inline constexpr std::uint64_t kMostMode = 6;
Topology topology_of(std::uint64_t mode);

// Number of indices of the list that is equivalent to `corners` indices of this mode; 0 if these are not a whole number
// of points, lines or triangles.
std::uint64_t list_size(std::uint64_t mode, std::uint64_t corners);

// The list. list_size() is not 0.
std::vector<std::uint32_t> as_list(std::uint64_t mode, std::vector<std::uint32_t> corners);

}  // namespace afm::scene
