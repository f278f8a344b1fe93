// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "composition/composer.h"
#include "device/gpu_timer.h"
#include "drawing/enlarger.h"
#include "drawing/eye_targets.h"
#include "drawing/scene_geometry.h"
#include "panels/panels.h"
#include "passes/damage.h"
#include "passes/frame_slot.h"
#include "passes/scene_pass.h"
#include "passes/shadow_casters.h"
#include "passes/shadow_map.h"
#include "passes/soft_shadow.h"
#include "render/renderer.h"

namespace afm::render {

// Members in the order of creation: later members use earlier ones.
struct Renderer::Parts {
  Parts(const Device& the_device, const scene::Scene& scene, const RendererOptions& the_options, FontFiles fonts);
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() { device.wait_idle(); }

  void wait_for(std::uint64_t value) const;
  EyePassConfig choose_drawing(const FrameState& frame, const DrawList& draws) const;
  void mark(const vk::raii::CommandBuffer& command, std::size_t slot, GpuTimer::Mark mark) const;
  void record_painting(std::size_t slot);
  void record_shadow(std::size_t slot, ShadowStep step);
  void record_eyes(const vk::raii::CommandBuffer& command, std::size_t slot);
  void record_enlarged(const vk::raii::CommandBuffer& command, std::size_t slot);
  void record_drawing(std::size_t slot);
  void record_patching(std::size_t slot);
  void submit(std::size_t slot);
  void render(const FrameState& frame);

  const Device& device;
  RendererOptions options;
  FrameQuality quality;
  EyeTargets eyes;
  EyeChanges eye_changes;
  SceneGeometry geometry;
  SceneMaterials materials;
  std::size_t node_count;
  ShadowMap shadow_map;
  SoftShadow soft_shadow;
  FrameSetLayouts set_layouts;
  ScenePass scene_pass;
  Panels panels;
  Enlarger enlarger;
  Composer composer;
  DrawListBuilder lister;
  Damage damage;
  DrawnFrame drawn, now;  // frame shown by the eyes, and frame being drawn
  ShadowCasters shadow_casters;
  std::vector<FrameSlot> slots;
  std::vector<GpuTimer> clocks;  // one per slot, or none
  vk::raii::Semaphore timeline;
  std::uint64_t frames = 0;                // number of frames submitted
  bool eyes_drawn = false;                 // true: eyes drawn since the eye images were created
  bool rested = false;                     // true: nothing submitted, since the newest frame looks like the last one
  double redrawn_share = 0;                // as Renderer::redrawn_share()
  double near_m = 0;                       // near plane of the newest frame: depth is near_m / distance
  double compose_ms = 0, readback_ms = 0;  // as in PassTimes; set by the caller
};

}  // namespace afm::render
