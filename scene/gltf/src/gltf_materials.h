// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gltf_model.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// Materials whose textures are numbered as in the file. Throws GltfError.
void read_materials(const tinygltf::Model& model, Scene& scene, GltfWarnings& notes);

}  // namespace afm::scene
