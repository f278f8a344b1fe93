// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "composer.h"
#include "eye_targets.h"
#include "frame_slot.h"
#include "panels.h"
#include "render/renderer.h"
#include "scene_geometry.h"
#include "scene_pass.h"
#include "shadow_map.h"

namespace afm::render {

// In the order of creation: what is declared later uses what stands before it.
struct Renderer::Parts {
  Parts(const Device& the_device, const scene::Scene& scene, const RendererOptions& the_options, PanelFonts fonts);
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { device->waitIdle(); }

  void wait_for(std::uint64_t value) const;
  void record(const vk::raii::CommandBuffer& command, FrameSlot& slot, std::size_t slot_index, const FrameState& frame);

  const Device& device;
  RendererOptions options;
  EyeTargets eyes;
  SceneGeometry geometry;
  std::size_t node_count;
  ShadowMap shadow_map;
  vk::raii::DescriptorSetLayout frame_set_layout;
  ScenePass scene_pass;
  Panels panels;
  Composer composer;
  std::vector<FrameSlot> slots;
  vk::raii::Semaphore timeline;
  std::uint64_t frames = 0;  // submitted
  bool eyes_drawn = false;   // since the eye images were made
};

}  // namespace afm::render
