// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "gltf_model.h"
#include "gltf_schema.h"

namespace afm::scene {

// An extension of materials: what may stand in its object, and what becomes of that. Readers may throw GltfError.
struct GltfMaterialExtension {
  GltfMember schema;
  void (*read)(const tinygltf::Value& extension, PbrMaterial& material, GltfWarnings& notes);
};

// All that are understood.
std::span<const GltfMaterialExtension> gltf_material_extensions();

// Their schemas alone.
std::span<const GltfMember> gltf_material_extension_members();

}  // namespace afm::scene
