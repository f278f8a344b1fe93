// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "eye_targets.h"
#include "frame_blocks.h"
#include "memory.h"
#include "shadow_map.h"

namespace afm::render {

// Set 0 of all pipelines that draw the room: the frame's uniforms, the draw's, the shadow map.
vk::raii::DescriptorSetLayout create_frame_set_layout(const Device& device);

// What one frame in flight owns: its commands, uniforms and draw blocks. Reused once the frame is finished.
class FrameSlot {
 public:
  FrameSlot(const Device& device, vk::DescriptorSetLayout layout, const ShadowMap& shadow_map, std::size_t pass_count,
            std::size_t draw_count);

  // Writes everything that the frame's shaders read.
  void write(const FrameState& frame, const SceneGeometry& geometry, const EyeTargets& eyes);

  // Resets and begins the slot's command buffer.
  const vk::raii::CommandBuffer& begin_commands() const;

  vk::DescriptorSet set(std::size_t pass) const { return *sets_[pass]; }

  // Bytes from one draw's block to the next: dynamic offsets of binding AFM_BINDING_DRAW are multiples of it.
  std::uint32_t draw_stride() const { return draw_stride_; }

  // The draws' places in the order in which they are drawn.
  const std::vector<std::uint32_t>& draw_order() const { return draw_order_; }

  std::uint64_t finished_at = 0;  // the timeline's value when the slot's newest frame is finished

 private:
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffer commands_{nullptr};
  std::vector<Buffer> uniforms_;  // one for each pass
  std::uint32_t draw_stride_;
  Buffer draws_;
  std::vector<std::uint8_t> glowing_;
  std::vector<std::uint32_t> draw_order_;
  vk::raii::DescriptorPool descriptor_pool_{nullptr};
  std::vector<vk::raii::DescriptorSet> sets_;
};

}  // namespace afm::render
