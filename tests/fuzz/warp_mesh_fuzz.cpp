// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>

#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "scene/display/warp_mesh.h"

// Whatever the bytes: a mesh that shows something finite in each pixel, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace afm::scene;
  const afm::fuzz::MemoryFile file(bytes, size);
  for (const auto& aspect : {std::optional<double>(), std::optional(1.6)}) {
    const auto mesh = load_warp_mesh(file.path(), aspect);
    if (!mesh) continue;
    ++afm::fuzz::accepted_inputs;
    if (mesh->nodes.size() != std::size_t{mesh->columns} * mesh->rows) std::abort();
    for (const glm::vec4& shown : warp_map(*mesh, {16, 9})) {
      for (glm::length_t i = 0; i < 4; ++i) {
        if (!std::isfinite(shown[i])) std::abort();
      }
    }
    if (const auto place = warped_place(*mesh, {0.5, 0.5}); place && !std::isfinite(place->picture.x)) std::abort();
  }
  return 0;
}
