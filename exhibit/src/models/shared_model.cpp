// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/shared_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "core/check.h"
#include "curves/fitting/felt_map.h"

namespace afm::exhibit {

namespace {

// Matrix in column-major order, like glm's.
std::array<double, 16> shared_matrix(const glm::dmat4& matrix) {
  std::array<double, 16> shared;
  std::copy_n(glm::value_ptr(matrix), shared.size(), shared.begin());
  return shared;
}

}  // namespace

core::Result<scene::SharedModel> shared_model(const scene::Scene& scene, scene::NodeIndex sample_node,
                                              std::span<const curves::SampleModel> materials,
                                              std::span<const scene::SharedHeightField> surfaces,
                                              std::span<const scene::SharedMeasuredCurve> curves,
                                              const scene::SharedTopography& topography) {
  if (scene.nodes.size() > scene::kMaxNodes || materials.size() > scene::kMaxMaterials ||
      surfaces.size() > scene::kMaxHeightFields || curves.size() > scene::kMaxMeasuredCurves) {
    return core::failure(
        core::ErrorCategory::BadInputFile,
        fmt::format("the scene has {} nodes, {} materials, {} surfaces and {} measured curves; at most {}, {}, {} and "
                    "{} can be shared with the servo",
                    scene.nodes.size(), materials.size(), surfaces.size(), curves.size(), scene::kMaxNodes,
                    scene::kMaxMaterials, scene::kMaxHeightFields, scene::kMaxMeasuredCurves));
  }
  scene::SharedModel model;
  model.node_count = static_cast<std::uint32_t>(scene.nodes.size());
  model.material_count = static_cast<std::uint32_t>(materials.size());
  model.height_field_count = static_cast<std::uint32_t>(surfaces.size());
  model.curve_count = static_cast<std::uint32_t>(curves.size());
  model.sample_node = sample_node;
  model.topography = topography;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    scene::SharedNode& node = model.nodes[i];
    node.name = scene::to_name(scene.nodes[i].name);
    node.parent = scene.nodes[i].parent.value_or(scene::kNoParent);
    node.parent_from_node = shared_matrix(scene.nodes[i].parent_from_node);
  }
  std::transform(materials.begin(), materials.end(), model.materials.begin(),
                 [](const curves::SampleModel& material) { return material.parameters; });
  for (const curves::SampleModel& material : materials) {
    if (material.felt_map) model.law_map = material.felt_map->laws;
  }
  std::copy(surfaces.begin(), surfaces.end(), model.height_fields.begin());
  std::copy(curves.begin(), curves.end(), model.curves.begin());
  return model;
}

scene::SceneTransforms shared_transforms(std::span<const glm::dmat4> room_from_node) {
  AFM_CHECK(room_from_node.size() <= scene::kMaxNodes);
  scene::SceneTransforms transforms;
  transforms.count = static_cast<std::uint32_t>(room_from_node.size());
  std::transform(room_from_node.begin(), room_from_node.end(), transforms.room_from_node.begin(), shared_matrix);
  return transforms;
}

}  // namespace afm::exhibit
