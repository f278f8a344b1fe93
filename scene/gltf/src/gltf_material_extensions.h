// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "gltf_model.h"
#include "gltf_schema.h"

namespace afm::scene {

// Extension of materials: the schema of its object, and its reader. Readers may throw GltfError.
struct GltfMaterialExtension {
  GltfMember schema;
  void (*read)(const tinygltf::Value& extension, PbrMaterial& material, GltfWarnings& notes);
};

// All supported extensions.
std::span<const GltfMaterialExtension> gltf_material_extensions();

// Their schemas.
std::span<const GltfMember> gltf_material_extension_members();

}  // namespace afm::scene
