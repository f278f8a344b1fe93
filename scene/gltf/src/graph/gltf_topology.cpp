// SPDX-License-Identifier: Apache-2.0
#include "graph/gltf_topology.h"

namespace afm::scene {
namespace {

enum PrimitiveMode : std::uint64_t { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

}  // namespace

Topology topology_of(std::uint64_t mode) {
  if (mode == kPoints) return Topology::Points;
  return mode <= kLineStrip ? Topology::Lines : Topology::Triangles;
}

std::uint64_t list_size(std::uint64_t mode, std::uint64_t corners) {
  switch (mode) {
    case kPoints:
      return corners;
    case kLines:
      return corners % 2 == 0 ? corners : 0;
    case kLineLoop:
      return corners < 2 ? 0 : 2 * corners;
    case kLineStrip:
      return corners < 2 ? 0 : 2 * (corners - 1);
    case kTriangles:
      return corners % 3 == 0 ? corners : 0;
    default:
      return corners < 3 ? 0 : 3 * (corners - 2);
  }
}

std::vector<std::uint32_t> as_list(std::uint64_t mode, std::vector<std::uint32_t> corners) {
  if (mode == kPoints || mode == kLines || mode == kTriangles) return corners;
  std::vector<std::uint32_t> list;
  list.reserve(list_size(mode, corners.size()));
  if (mode == kLineLoop || mode == kLineStrip) {
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) list.insert(list.end(), {corners[i], corners[i + 1]});
    if (mode == kLineLoop) list.insert(list.end(), {corners.back(), corners.front()});
    return list;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == kTriangleStrip) {
      // every other triangle of a strip is reversed
      list.insert(list.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    } else {
      list.insert(list.end(), {corners[i + 1], corners[i + 2], corners[0]});
    }
  }
  return list;
}

}  // namespace afm::scene
