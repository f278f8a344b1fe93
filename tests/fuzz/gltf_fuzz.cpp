// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "fuzz/memory_file.h"
#include "scene/gltf_loader.h"

// Whatever the bytes: a scene whose every index is within bounds, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  const auto scene = afm::scene::load_gltf(file.path());
  if (!scene) return 0;
  for (std::size_t i = 0; i < scene->nodes.size(); ++i) {
    const afm::scene::Node& node = scene->nodes[i];
    if (node.parent && *node.parent >= i) std::abort();
    if (node.mesh && *node.mesh >= scene->meshes.size()) std::abort();
  }
  for (const afm::scene::Mesh& mesh : scene->meshes) {
    for (const afm::scene::Primitive& primitive : mesh.primitives) {
      if (primitive.material >= scene->materials.size()) std::abort();
      for (const std::uint32_t index : primitive.indices) {
        if (index >= primitive.vertices.size()) std::abort();
      }
    }
  }
  return 0;
}
