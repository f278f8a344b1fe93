// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gltf_accessor.h"
#include "graph/gltf_budget.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// Index of each of the file's nodes in the scene; empty for nodes that the scene does not contain.
using NodePlaces = std::vector<std::optional<NodeIndex>>;

// Reads the cameras, lights, skins and nodes of the scene to show; call after reading the meshes. Throws GltfError.
NodePlaces read_nodes(const tinygltf::Model& model, const GltfAccessors& accessors, GltfBudget& budget, Scene& scene,
                      GltfWarnings& notes);

}  // namespace afm::scene
