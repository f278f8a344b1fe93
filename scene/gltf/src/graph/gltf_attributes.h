// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "gltf_accessor.h"

namespace afm::scene {

bool uses_quantization(const tinygltf::Model& model);

// True if the loader uses the vertex attribute of this name.
bool is_read_attribute(const std::string& name);

// Throws GltfError unless the accessor has a type allowed by glTF 2.0 (section 3.7.2.1), or by KHR_mesh_quantization if
// it is used, for this attribute of a primitive or a morph target. `path` is the location of the list of attributes.
enum class AttributeOwner { Primitive, Target };
void check_attribute(const std::string& path, const std::string& name, const Accessor& accessor, AttributeOwner owner,
                     bool quantized);

void check_indices(const std::string& path, const Accessor& accessor);

// Largest number of the index type. It would restart a primitive, which glTF 2.0 (section 3.7.2.1) forbids. `accessor`
// has passed check_indices().
std::uint32_t restart_index(const Accessor& accessor);

}  // namespace afm::scene
