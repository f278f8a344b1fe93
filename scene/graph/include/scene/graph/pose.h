// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/graph/scene.h"

namespace afm::scene {

// Replaces everything that moves in a scene: nodes take the positions of its animations, and meshes with morph targets
// or skins are replaced by their deformed versions. Without a time everything is at rest, with the rest weights. If
// several animations move the same node, the first counts. Allocates; copies the vertices of moved meshes.
Scene posed(Scene scene, std::optional<float> time_s);

// The scene with the materials of a variant (KHR_materials_variants); false if there is none of that name.
bool choose_variant(Scene& scene, std::string_view name);

// Transform of every node at rest, in the scene's frame.
std::vector<glm::dmat4> scene_from_nodes(const Scene& scene);

// Node with a role, "tip", "base" or "surface", according to its extras or else its name.
std::optional<NodeIndex> find_role(const Scene& scene, std::string_view role);

}  // namespace afm::scene
