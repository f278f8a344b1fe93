// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <span>

#include "core/result.h"
#include "curves/sample_model.h"
#include "scene/graph/scene.h"
#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

// The shared model of a scene: its nodes at rest and its contacts. Fails if the segment lacks room for either. The
// materials refer to `curves`, `surfaces` and `topography`.
core::Result<scene::SharedModel> shared_model(const scene::Scene& scene, scene::NodeIndex sample_node,
                                              std::span<const curves::SampleModel> materials,
                                              std::span<const scene::SharedHeightField> surfaces,
                                              std::span<const scene::SharedMeasuredCurve> curves = {},
                                              const scene::SharedTopography& topography = {});

// A frame's transforms for the servo, room from node. At most scene::kMaxNodes.
scene::SceneTransforms shared_transforms(std::span<const glm::dmat4> room_from_node);

}  // namespace afm::exhibit
