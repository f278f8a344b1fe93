// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gltf_model.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// Reads the materials; their textures keep the numbers of the file. Throws GltfError.
void read_materials(const tinygltf::Model& model, Scene& scene, GltfWarnings& notes);

// Texture `key` of a material's extension, if it has one.
void read_texture(const tinygltf::Value& extension, const char* key, TextureSlot slot, PbrMaterial& material,
                  GltfWarnings& notes);

}  // namespace afm::scene
