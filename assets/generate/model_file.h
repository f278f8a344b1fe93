// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "surface.h"

namespace afm::generate {

using Json = nlohmann::ordered_json;

// glTF 2.0 factors, linear.
struct MaterialSpec {
  std::string name;
  V3 base_color{1, 1, 1};
  double metallic = 0;
  double roughness = 0.5;
  double alpha = 1;     // coverage; below 1: alphaMode BLEND
  bool fading = false;  // true: alphaMode BLEND, with the alpha of the vertices
  V3 emissive{0, 0, 0};
  double emissive_strength = 1;
  bool unlit = false;
  bool vertex_colors = false;  // true: writes COLOR_0
};

// Material of the dark lines around solids.
inline MaterialSpec outline_material() {
  return {.name = "outline", .base_color = {0.004, 0.004, 0.005}, .roughness = 1, .unlit = true};
}

struct Part {
  Surface surface;
  MaterialSpec material;
};

struct NodeSpec {
  std::string name;
  std::optional<std::size_t> parent{};  // index of an earlier node; empty: none
  std::optional<Placement> placement{};
  std::vector<Part> parts{};
  Json extras{};
};

// Extras of a unit shape whose length only the wall determines (docs/gltf.md).
Json mark_role();

// Contents of a .glb file. Lengths in metres.
struct Model {
  std::string name;  // the file's, without extension
  std::vector<NodeSpec> nodes;
};

// Contents of the binary glTF file: the same for the same model on every machine. Positions are rounded to the 2^22nd
// part of each mesh's size.
std::vector<std::uint8_t> to_glb(const Model& model);

}  // namespace afm::generate
