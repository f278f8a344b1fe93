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

  struct Input {
    const SceneGeometry& geometry;
    std::span<const std::uint32_t> order;   // as FrameSlot::draw_order()
    std::span<const std::uint8_t> visible;  // 0 leaves the node's own mesh out; empty shows all
    vk::DescriptorSet frame_set;
    std::uint32_t draw_stride = 0;  // as FrameSlot::draw_stride()
  };
  void record_shadow(const vk::raii::CommandBuffer& command, const Input& input) const;
  void record_eyes(const vk::raii::CommandBuffer& command, const Input& input) const;

 private:
  void record_draws(const vk::raii::CommandBuffer& command, const Input& input, std::size_t first,
                    std::size_t end) const;

  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline shadow_;
  vk::raii::Pipeline opaque_;
  vk::raii::Pipeline background_;
  vk::raii::Pipeline blended_;
};

}  // namespace afm::render
