// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "eye_targets.h"
#include "scene_geometry.h"

namespace afm::render {

// The pipelines that draw a SceneGeometry: into the shadow map, and into the eyes with the background behind.
class ScenePass {
 public:
  ScenePass(const Device& device, const EyeTargets& eyes, vk::DescriptorSetLayout frame_set_layout);

  // `visible[node]` == 0 leaves the node's own mesh out; empty shows all.
  void record_shadow(const vk::raii::CommandBuffer& command, const SceneGeometry& geometry,
                     std::span<const std::uint8_t> visible, vk::DescriptorSet frame_set) const;
  void record_eyes(const vk::raii::CommandBuffer& command, const SceneGeometry& geometry,
                   std::span<const std::uint8_t> visible, vk::DescriptorSet frame_set) const;

 private:
  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline shadow_;
  vk::raii::Pipeline opaque_;
  vk::raii::Pipeline background_;
  vk::raii::Pipeline blended_;
};

}  // namespace afm::render
