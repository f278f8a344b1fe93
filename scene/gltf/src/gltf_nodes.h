// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "gltf_accessor.h"
#include "gltf_budget.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::scene {

// Where the file's nodes stand in the scene; nothing for those that the scene does not show.
using NodePlaces = std::vector<std::optional<NodeIndex>>;

// Cameras, lights, skins and the nodes of the scene that is shown, after the meshes. Throws GltfError.
NodePlaces read_nodes(const tinygltf::Model& model, const GltfAccessors& accessors, GltfBudget& budget, Scene& scene,
                      GltfWarnings& notes);

}  // namespace afm::scene
