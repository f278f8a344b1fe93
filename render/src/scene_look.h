// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "scene/scene.h"

namespace afm::render {

// What distinguishes the pipelines that draw more than a colour and the factors of metal and roughness.
struct SceneLook {
  std::uint32_t bits = 0;  // of textures, 1 << slot, and AFM_LOOK_*
  bool blended = false;
  scene::Topology topology = scene::Topology::Triangles;

  bool operator==(const SceneLook&) const = default;
};

// The look of a primitive, or nothing where the plain pipelines draw all of it.
std::optional<SceneLook> look_of(const scene::Scene& scene, const scene::Primitive& primitive);

}  // namespace afm::render
