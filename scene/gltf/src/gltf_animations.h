// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gltf_nodes.h"

namespace afm::scene {

// All animations of the nodes that are shown, after these. Throws GltfError.
void read_animations(const tinygltf::Model& model, const GltfAccessors& accessors, const NodePlaces& places,
                     GltfBudget& budget, Scene& scene);

}  // namespace afm::scene
