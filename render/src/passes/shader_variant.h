// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "scene/graph/scene.h"

namespace afm::render {

// Features that distinguish the pipelines for materials with more than a colour and the factors of metal and roughness.
struct ShaderVariant {
  std::uint32_t bits = 0;  // of textures, 1 << slot, and AFM_FEATURE_*
  bool blended = false;
  scene::Topology topology = scene::Topology::Triangles;

  bool operator==(const ShaderVariant&) const = default;
};

// The variant of a primitive, or nothing where the plain pipelines draw all of it.
std::optional<ShaderVariant> variant_of(const scene::Scene& scene, const scene::Primitive& primitive);

// Number of pipelines that a scene needs for its variants. Materials that differ in numbers or in which textures they
// show, but not in what kinds of texture they have, share one; a program that makes models can still ask for thousands,
// each of which takes tens of milliseconds to compile.
std::size_t count_variants(const scene::Scene& scene);
inline constexpr std::size_t kMostShaderVariants = 256;

}  // namespace afm::render
