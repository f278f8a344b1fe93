// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "device/memory.h"
#include "drawing/draw_list.h"
#include "drawing/eye_targets.h"
#include "drawing/frame_blocks.h"
#include "drawing/pixel_area.h"
#include "passes/soft_shadow.h"

namespace afm::render {

// Sets of the pipelines that draw the room. Set 0 has the uniforms of the frame and, for the eyes, the shadows to read.
// Pipelines that draw the shadow map have a set without it; otherwise lavapipe would finish each draw before the next,
// to let it read the result. Set AFM_SET_DRAW has the uniforms of a draw.
struct FrameSetLayouts {
  explicit FrameSetLayouts(const Device& device);

  vk::raii::DescriptorSetLayout eyes, shadow, draw;
};

// Resources of one frame in flight: commands, uniforms and draw blocks. Reused once the frame is finished.
class FrameSlot {
 public:
  FrameSlot(const Device& device, const FrameSetLayouts& layouts, const SoftShadow& shadow,
            const SceneGeometry& geometry);

  // Writes everything that the frame's shaders read; `blocks` has one entry per draw, `copies` one for each of
  // SceneGeometry::copy_count(), `shapes` one for each of SceneGeometry::shape_count(). Of copies and shapes, only
  // those that differ from the slot's last frame are written.
  void write(const FrameState& frame, std::span<const DrawBlock> blocks, std::span<const MeshCopy> copies,
             std::span<const scene::Vertex> shapes, const EyePassConfig& drawing, float guard_band);

  // Descriptor set of a pass, which starts with the left eye's view or with the right eye's.
  vk::DescriptorSet set(std::size_t pass) const { return *sets_[pass]; }

  // Descriptor set of the pass that draws the shadow map.
  vk::DescriptorSet shadow_set() const { return *shadow_set_; }

  // Descriptor set of the draws, with a dynamic offset.
  vk::DescriptorSet draw_set() const { return *draw_set_; }

  // Distance in bytes between the blocks of two draws; the offsets of draw_set() are multiples of it.
  std::uint32_t draw_stride() const { return draw_stride_; }

  // Vertex buffer of all copies; null if the scene has no room for any.
  vk::Buffer copies() const { return *copies_.buffer; }

  // Vertex buffer of all shapes; null if frames give none.
  vk::Buffer shapes() const { return *shapes_.buffer; }

  // Draws of the frame; stored here only to keep their memory.
  DrawList draws;

  // Commands recorded for one frame; patching() draws parts of the eyes.
  const vk::raii::CommandBuffer& painting() const { return commands_[0]; }
  const vk::raii::CommandBuffer& shadow() const { return commands_[1]; }
  const vk::raii::CommandBuffer& patching() const { return commands_[3]; }

  // Commands that draw the eyes, reused by later frames while `recorded` is unchanged.
  const vk::raii::CommandBuffer& drawing() const { return commands_[2]; }

  // Everything that the commands of drawing() depend on.
  struct Recorded {
    DrawList draws;
    EyePassConfig drawing;
    std::uint64_t panels = 0;  // revision of the panels, as Panels::revision()
    bool anything = false;

    // Stores the new values; true if something has changed.
    bool take(const DrawList& new_draws, const EyePassConfig& new_drawing, std::uint64_t new_panels);
  };
  Recorded recorded;

  // work done in the slot's newest frame
  bool painted = false;   // true: panels painted
  bool shadowed = false;  // shadow map redrawn
  PixelArea area;         // redrawn part of the eyes

  std::uint64_t finished_at = 0;  // timeline value at which the slot's newest frame is finished

 private:
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffers commands_{nullptr};
  std::vector<Buffer> uniforms_;  // one buffer per pass
  std::uint32_t draw_stride_;
  float largest_point_px_;
  Buffer draw_blocks_;
  Buffer copies_;
  std::vector<MeshCopy> written_copies_;
  Buffer shapes_;
  std::vector<scene::Vertex> written_shapes_;
  vk::raii::DescriptorPool descriptor_pool_{nullptr};
  std::vector<vk::raii::DescriptorSet> sets_;
  vk::raii::DescriptorSet shadow_set_{nullptr};
  vk::raii::DescriptorSet draw_set_{nullptr};
};

}  // namespace afm::render
