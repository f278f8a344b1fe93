// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gltf_accessor.h"

namespace afm::scene {

// Decoded Draco mesh: its corners, and one value per vertex for each attribute.
struct DracoMesh {
  std::vector<std::uint32_t> indices;
  std::map<std::string, std::vector<float>> attributes;
};

// Attribute to read from the stream: its number, and its description from the accessor.
struct DracoAttribute {
  std::string name;
  std::uint32_t id = 0;
  const Accessor* accessor = nullptr;
};

// Throws GltfError: the stream is broken, or does not contain exactly `corners` indices and the announced attributes.
DracoMesh decode_draco(std::span<const std::uint8_t> stream, std::size_t corners,
                       const std::vector<DracoAttribute>& wanted);

}  // namespace afm::scene
