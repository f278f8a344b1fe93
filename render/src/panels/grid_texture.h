// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/memory.h"
#include "panels/grid_sheet.h"
#include "panels/panel_texture.h"

namespace afm::render {

// The sheet of a frame's colour grids on the device. One for each frame in flight; without grids it takes no memory.
class GridTexture {
 public:
  // Copies the sheet; call outside any rendering, when the previous use is over. An empty sheet changes nothing.
  void record_upload(const vk::raii::CommandBuffer& command, const Device& device, const GridSheet& sheet,
                     vk::DescriptorSetLayout layout, vk::Sampler sampler);

  // Descriptor set of the sheet that was copied last.
  vk::DescriptorSet set() const { return *texture_.set; }

 private:
  PanelTexture texture_;
  Buffer staging_;
};

}  // namespace afm::render
