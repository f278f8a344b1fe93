// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "device/pipelines.h"
#include "renderer/renderer_parts.h"

// Commands that draw the eyes of a frame.
namespace afm::render {

// Draws all of the eyes, or the part within the slot's area.
void Renderer::Parts::record_eyes(const vk::raii::CommandBuffer& command, std::size_t slot_index) {
  const FrameSlot& slot = slots[slot_index];
  const EyePassConfig& drawing = eyes.drawing();
  const std::optional<PixelBox> around =
      slot.area.everything() ? std::nullopt : std::optional<PixelBox>(slot.area.around());
  for (std::size_t pass = 0; pass < drawing.pass_count; ++pass) {
    const auto record = [&](const std::optional<PixelBox>& box) {
      scene_pass.record_eyes(command, drawing,
                             {geometry, materials, slot.draws, slot.set(pass), slot.draw_set(), slot.draw_stride(),
                              &now, box, slot.copies(), slot.shapes()});
      if (!eyes.reduced()) panels.record_rectangles(command, drawing, slot.set(pass));
    };
    eyes.begin(command, pass, around);
    if (slot.area.everything()) record({});
    for (const PixelBox& box : slot.area.boxes()) {
      command.setScissor(0, box.rect());
      record(box);
    }
    eyes.end(command, pass, around);
  }
  if (eyes.reduced()) record_enlarged(command, slot_index);
}

// Enlarges the room that record_eyes() has drawn with fewer pixels, and draws the panels over it with all pixels.
void Renderer::Parts::record_enlarged(const vk::raii::CommandBuffer& command, std::size_t slot_index) {
  const FrameSlot& slot = slots[slot_index];
  const PixelArea area = eyes.enlarged(slot.area);
  const auto around = area.everything() ? std::nullopt : std::optional<PixelBox>(area.around());
  EyePassConfig drawing = eyes.drawing();
  drawing.samples = vk::SampleCountFlagBits::e1;
  for (std::size_t pass = 0; pass < drawing.pass_count; ++pass) {
    const auto record = [&](const PixelBox& box) {
      set_viewport(command, eyes.extent());
      command.setScissor(0, box.rect());
      enlarger.record(command, eyes, pass);
      set_viewport(command, eyes.extent(), eyes.guard_band());
      command.setScissor(0, box.rect());
      panels.record_rectangles(command, drawing, slot.set(pass));
    };
    eyes.begin_enlarged(command, pass, around);
    if (area.everything()) record(PixelBox::whole(eyes.extent()));
    for (const PixelBox& box : area.boxes()) record(box);
    eyes.end_enlarged(command, pass);
  }
}

void Renderer::Parts::record_drawing(std::size_t slot) {
  const auto& command = slots[slot].drawing();
  command.begin({});
  mark(command, slot, GpuTimer::Mark::EyesBegin);
  record_eyes(command, slot);
  mark(command, slot, GpuTimer::Mark::EyesEnd);
  command.end();
}

void Renderer::Parts::record_patching(std::size_t slot) {
  const auto& command = slots[slot].patching();
  command.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  mark(command, slot, GpuTimer::Mark::EyesBegin);
  record_eyes(command, slot);
  mark(command, slot, GpuTimer::Mark::EyesEnd);
  command.end();
}

}  // namespace afm::render
