// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "device/memory.h"
#include "passes/scene_textures.h"
#include "scene/graph/scene.h"

namespace afm::render {

// Set 1 of the pipelines that draw a ShaderVariant: the block and the textures of a material.
class SceneMaterials {
 public:
  SceneMaterials(const Device& device, const scene::Scene& scene);

  vk::DescriptorSetLayout layout() const { return *layout_; }
  vk::DescriptorSet set(std::uint32_t material) const { return *sets_[material]; }

 private:
  void write_set(const Device& device, const scene::PbrMaterial& material, std::size_t index,
                 vk::DeviceSize stride) const;

  vk::raii::DescriptorSetLayout layout_;
  SceneTextures textures_;
  Buffer blocks_;
  vk::raii::DescriptorPool pool_{nullptr};
  std::vector<vk::raii::DescriptorSet> sets_;
};

}  // namespace afm::render
