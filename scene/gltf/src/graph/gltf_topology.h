// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/graph/scene.h"

namespace afm::scene {

// Largest of glTF's seven modes (2.0, section 3.7.2.1). Strips, fans and loops are converted to lists here.
inline constexpr std::uint64_t kMostMode = 6;
Topology topology_of(std::uint64_t mode);

// Number of indices of the equivalent list for `corners` indices of this mode; 0 if they do not form complete points,
// lines or triangles.
std::uint64_t list_size(std::uint64_t mode, std::uint64_t corners);

// Equivalent list. list_size() must not be 0.
std::vector<std::uint32_t> as_list(std::uint64_t mode, std::vector<std::uint32_t> corners);

}  // namespace afm::scene
