// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "scene/graph/scene.h"

namespace afm::render {

// Features that distinguish the pipelines for materials with more than a colour and the metallic and roughness factors.
struct ShaderVariant {
  std::uint32_t bits = 0;  // textures as 1 << slot, and AFM_FEATURE_*
  bool blended = false;
  scene::Topology topology = scene::Topology::Triangles;

  bool operator==(const ShaderVariant&) const = default;
};

// Variant of a primitive; nothing if the plain pipelines can draw all of it.
std::optional<ShaderVariant> variant_of(const scene::Scene& scene, const scene::Primitive& primitive);

// Number of pipelines that a scene's variants need. Materials with the same kinds of textures share one, whatever their
// numbers and textures. A generated model can still need thousands, each of which takes tens of milliseconds to
// compile.
std::size_t count_variants(const scene::Scene& scene);
inline constexpr std::size_t kMostShaderVariants = 256;

}  // namespace afm::render
