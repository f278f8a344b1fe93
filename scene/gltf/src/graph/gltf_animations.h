// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "graph/gltf_nodes.h"

namespace afm::scene {

// Reads all animations of the nodes in the scene; call after reading these. Throws GltfError.
void read_animations(const tinygltf::Model& model, const GltfAccessors& accessors, const NodePlaces& places,
                     GltfBudget& budget, Scene& scene);

}  // namespace afm::scene
