// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "scene/graph/scene.h"

namespace afm::scene {

// The same scene with nothing left that moves: nodes stand where its animations put them, meshes with morph targets or
// skins are replaced by what they look like. Without a time everything is at rest, with the weights of rest. Of several
// animations that move the same node the first counts. Allocates; as much as it copies vertices of moved meshes.
Scene posed(Scene scene, std::optional<float> time_s);

// The scene with the materials of a variant (KHR_materials_variants); false if there is none of that name.
bool choose_variant(Scene& scene, std::string_view name);

// Transform of every node at rest, in the scene's frame.
std::vector<glm::dmat4> scene_from_nodes(const Scene& scene);

// The node with a role, "tip", "base" or "surface": by its extras, or else by its name.
std::optional<NodeIndex> find_role(const Scene& scene, std::string_view role);

}  // namespace afm::scene
