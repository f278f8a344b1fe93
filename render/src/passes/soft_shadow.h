// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "device/memory.h"

namespace afm::render {

// Image that the shaders of the room read for shadows with soft edges, computed from the shadow map (soft_shadow.frag):
// the farther a surface is from its caster, the wider the edge.
class SoftShadow {
 public:
  // `depth` is a view of the shadow map.
  SoftShadow(const Device& device, vk::ImageView depth);

  // Brings the image up to date with `changed`, a part of the shadow map in its texels, which may be empty. The map can
  // be sampled before and afterwards. The first part must be the whole map.
  void record(const vk::raii::CommandBuffer& command, const vk::Rect2D& changed);

  // Replaces record(): an image without contents for pipelines that do not read it.
  void leave_empty() const;

  vk::DescriptorImageInfo descriptor() const;

 private:
  enum Step : std::uint32_t { kRows, kColumns };
  void draw(const vk::raii::CommandBuffer& command, Step step, const vk::Rect2D& part);

  const Device& device_;
  std::array<DeviceImage, 2> images_;  // images indexed by step
  std::array<vk::raii::ImageView, 2> views_;
  vk::raii::Sampler sampler_, texel_sampler_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  std::array<vk::raii::Pipeline, 2> pipelines_{nullptr, nullptr};  // pipelines indexed by step, created at first use
  vk::raii::DescriptorPool pool_;
  vk::raii::DescriptorSets sets_;
};

}  // namespace afm::render
