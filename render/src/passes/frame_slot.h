// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "device/frame_blocks.h"
#include "device/memory.h"
#include "passes/draw_list.h"
#include "passes/eye_targets.h"
#include "passes/pixel_area.h"
#include "passes/shadow_map.h"

namespace afm::render {

// Set 0 of all pipelines that draw the room: the frame's uniforms, the draw's, and the shadow map where it is read.
// What draws the shadow map has a set without: lavapipe would finish each draw before the next, to let it read what the
// other wrote.
enum class ShadowMapUse { Read, Drawn };
vk::raii::DescriptorSetLayout create_frame_set_layout(const Device& device, ShadowMapUse use);

// Resources of one frame in flight: its commands, uniforms and draw blocks. Reused once the frame is finished.
class FrameSlot {
 public:
  // `layout` where the shadow map is read, `shadow_layout` where it is drawn.
  FrameSlot(const Device& device, vk::DescriptorSetLayout layout, vk::DescriptorSetLayout shadow_layout,
            const ShadowMap& shadow_map, std::size_t draw_count);

  // Writes everything that the frame's shaders read; `blocks` has one for each draw.
  void write(const FrameState& frame, std::span<const DrawBlock> blocks, const EyePassConfig& drawing,
             float guard_band);

  // The frame's set of a pass: with the left eye's view first, or the right one's.
  vk::DescriptorSet set(std::size_t pass) const { return *sets_[pass]; }

  // The frame's set of the pass that draws the shadow map.
  vk::DescriptorSet shadow_set() const { return *shadow_set_; }

  // Bytes from one draw's block to the next: dynamic offsets of binding AFM_BINDING_DRAW are multiples of it.
  std::uint32_t draw_stride() const { return draw_stride_; }

  // Draws of the frame; the slot only keeps their memory.
  DrawList draws;

  // Commands that are recorded for one frame; patching() draws parts of the eyes.
  const vk::raii::CommandBuffer& painting() const { return commands_[0]; }
  const vk::raii::CommandBuffer& shadow() const { return commands_[1]; }
  const vk::raii::CommandBuffer& patching() const { return commands_[3]; }

  // Commands that draw the eyes and stay for as many frames as `recorded` says.
  const vk::raii::CommandBuffer& drawing() const { return commands_[2]; }

  // All that the commands of drawing() depend on.
  struct Recorded {
    DrawList draws;
    EyePassConfig drawing;
    std::uint64_t panels = 0;  // as Panels::revision()
    bool anything = false;

    // True if something has changed; it is then stored.
    bool take(const DrawList& new_draws, const EyePassConfig& new_drawing, std::uint64_t new_panels);
  };
  Recorded recorded;

  // in the slot's newest frame
  bool painted = false;   // panels
  bool shadowed = false;  // the shadow map was drawn again
  PixelArea area;         // of the eyes, that was drawn

  std::uint64_t finished_at = 0;  // the timeline's value when the slot's newest frame is finished

 private:
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffers commands_{nullptr};
  std::vector<Buffer> uniforms_;  // one for each pass
  std::uint32_t draw_stride_;
  Buffer draw_blocks_;
  vk::raii::DescriptorPool descriptor_pool_{nullptr};
  std::vector<vk::raii::DescriptorSet> sets_;
  vk::raii::DescriptorSet shadow_set_{nullptr};
};

}  // namespace afm::render
