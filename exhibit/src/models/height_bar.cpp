// SPDX-License-Identifier: Apache-2.0
#include "models/height_bar.h"

#include "exhibit/models/height_colours.h"
#include "models/linear_colour.h"

namespace afm::exhibit {

scene::Scene height_bar(double width) {
  constexpr std::uint32_t kSteps = 64;
  scene::Primitive strip;
  for (std::uint32_t i = 0; i <= kSteps; ++i) {
    const double height = static_cast<double>(i) / kSteps;
    for (const double x : {0.0, width}) {
      strip.vertices.push_back({{static_cast<float>(x), static_cast<float>(height), 0.0F},
                                {0.0F, 0.0F, 1.0F},
                                linear_colour(height_colour(height))});
    }
    if (i == kSteps) break;
    const std::uint32_t first = 2 * i;
    strip.indices.insert(strip.indices.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
  }
  scene::Scene bar;
  bar.materials.push_back({.name = "height colours", .metallic = 0.0F, .double_sided = true, .unlit = true});
  bar.meshes.push_back({"height bar", {strip}});
  bar.nodes.push_back({"strip", std::nullopt, 0U, glm::dmat4(1.0)});
  return bar;
}

}  // namespace afm::exhibit
