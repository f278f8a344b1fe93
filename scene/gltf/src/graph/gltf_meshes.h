// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gltf_accessor.h"
#include "graph/gltf_budget.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// Reads all meshes; call after reading the materials, since a default material is appended for primitives without one.
// Throws GltfError.
void read_meshes(const tinygltf::Model& model, const GltfBuffers& buffers, const GltfAccessors& accessors,
                 GltfBudget& budget, Scene& scene, GltfWarnings& notes);

}  // namespace afm::scene
