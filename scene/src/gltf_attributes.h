// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "gltf_accessor.h"
#include "gltf_json.h"

namespace afm::scene {

bool uses_quantization(const JsonElement& root);

// Whether anything is made of the vertex attribute of this name.
bool is_read_attribute(const std::string& name);

// Throws GltfFault unless the accessor is of a kind that glTF 2.0 (section 3.7.2.1), or KHR_mesh_quantization if it is
// used, gives the attribute of a primitive or of a morph target. `from` is the list of attributes.
enum class AttributeOwner { Primitive, Target };
void check_attribute(const JsonElement& from, const char* name, const Accessor& accessor, AttributeOwner owner,
                     bool quantized);

void check_indices(const JsonElement& primitive, const Accessor& accessor);

}  // namespace afm::scene
