// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>

#include "drawing/draw_list.h"
#include "drawing/eye_targets.h"
#include "drawing/scene_geometry.h"
#include "passes/damage.h"
#include "passes/frame_slot.h"
#include "passes/scene_materials.h"
#include "render/renderer.h"

namespace afm::render {

// Pipelines that draw a SceneGeometry: into the shadow map, and into the eyes with the background behind.
class ScenePass {
 public:
  ScenePass(const Device& device, const FrameSetLayouts& layouts, const SceneMaterials& materials,
            const std::vector<ShaderVariant>& variants, Lighting lighting);

  // State that all pipelines of the eyes have in common.
  struct Look {
    vk::PipelineLayout layout;
    bool one_light = false;
  };

  struct Input {
    const SceneGeometry& geometry;
    const SceneMaterials& materials;
    const DrawList& draws;
    vk::DescriptorSet frame_set;
    vk::DescriptorSet draw_set;         // descriptor set of FrameSlot::draw_set()
    std::uint32_t draw_stride = 0;      // bytes between draw blocks, as in FrameSlot::draw_stride()
    const DrawnFrame* frame = nullptr;  // frame used to skip draws outside `box`, if that is set
    std::optional<PixelBox> box{};      // scissor over an earlier picture
    vk::Buffer copies{};                // buffer of FrameSlot::copies()
    vk::Buffer shapes{};                // buffer of FrameSlot::shapes()
  };
  // Draws `draws` of the input's geometry; the input's frame set is FrameSlot::shadow_set().
  void record_shadow(const vk::raii::CommandBuffer& command, const Input& input, std::span<const std::uint32_t> draws);
  void record_eyes(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing, const Input& input);

 private:
  struct PlainPipelines {
    EyePipeline single_sided, double_sided, unlit;
    EyePipeline smooth;  // Shading::LightByVertex without fog
  };
  Look plain_look() const { return {*layout_, one_light_}; }
  static PlainPipelines plain_pipelines(const Device& device, const Look& look, Blending blending,
                                        std::uint32_t variant);
  // Sides that are shown; unknown at the start of a list. Set only where they change: a CPU device spends about a
  // microsecond on each command.
  struct Sides {
    std::optional<vk::CullModeFlagBits> culled;
    std::optional<vk::FrontFace> front;
  };
  static void set_state(const vk::raii::CommandBuffer& command, vk::PipelineLayout layout, const Input& input,
                        std::uint32_t draw, Sides& sides);
  static void draw_one(const vk::raii::CommandBuffer& command, const Input& input, std::uint32_t draw);
  static void bind_buffers(const vk::raii::CommandBuffer& command, const Input& input);
  EyePipeline& plain_one(const Draw& draw, Shading shading, bool hazy, PlainPipelines& plain);
  const vk::raii::Pipeline& shadow_pipeline(bool copied);
  static void record_background(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing,
                                EyePipeline& pipeline);
  void erase(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing, const PixelBox& box);
  void record_in_eyes(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing, const Input& input,
                      std::span<const std::uint32_t> draws, PlainPipelines& plain);

  const Device& device_;
  bool one_light_;
  vk::raii::PipelineLayout layout_;
  vk::raii::PipelineLayout shadow_layout_;
  vk::raii::PipelineLayout variant_layout_;
  std::array<PlainPipelines, 2> opaque_;                         // pipelines without and with fog
  vk::raii::Pipeline shadow_{nullptr}, shadow_copies_{nullptr};  // created at first use
  std::array<EyePipeline, 2> copies_;                            // pipelines without and with fog
  EyePipeline fine_;                                             // pipeline for per-vertex shading, without fog
  EyePipeline background_;                                       // pipeline for pixels without an object
  EyePipeline erasing_background_;                               // pipeline that overwrites the old contents
  std::array<PlainPipelines, 2> blended_;
  std::vector<EyePipeline> variants_;  // pipelines in the order of SceneGeometry::variants()
};

}  // namespace afm::render
