// SPDX-License-Identifier: Apache-2.0
#include "scene_pass.h"

#include "pipelines.h"
#include "shaders/background_frag.h"
#include "shaders/fullscreen_vert.h"
#include "shaders/scene_frag.h"
#include "shaders/scene_vert.h"
#include "shaders/shadow_vert.h"

namespace afm::render {
namespace {

// Slope and constant bias of the shadow map; the shader's step along the normal does the rest.
constexpr float kShadowBiasConstant = 1.0F;
constexpr float kShadowBiasSlope = 1.5F;

PipelineRequest eye_request(const char* name, vk::PipelineLayout layout, const EyeTargets& eyes) {
  return {.name = name,
          .layout = layout,
          .color_format = kEyeFormat,
          .depth_format = kDepthFormat,
          .samples = eyes.samples(),
          .view_mask = eyes.view_mask()};
}

vk::raii::Pipeline create_scene_pipeline(const Device& device, vk::PipelineLayout layout, const EyeTargets& eyes,
                                         Blending blending) {
  PipelineRequest request = eye_request(blending == Blending::Opaque ? "opaque" : "blended", layout, eyes);
  request.vertex_code = shaders::scene_vert;
  request.fragment_code = shaders::scene_frag;
  request.bindings = SceneGeometry::bindings();
  request.attributes = SceneGeometry::attributes();
  request.blending = blending;
  request.depth = blending == Blending::Opaque ? DepthUse::TestAndWrite : DepthUse::TestOnly;
  return create_pipeline(device, request);
}

vk::raii::Pipeline create_background_pipeline(const Device& device, vk::PipelineLayout layout, const EyeTargets& eyes) {
  PipelineRequest request = eye_request("background", layout, eyes);
  request.vertex_code = shaders::fullscreen_vert;
  request.topology = vk::PrimitiveTopology::eTriangleStrip;
  request.fragment_code = shaders::background_frag;
  request.depth = DepthUse::TestOnly;
  request.depth_compare = vk::CompareOp::eEqual;  // only where the depth is still the cleared one
  return create_pipeline(device, request);
}

vk::raii::Pipeline create_shadow_pipeline(const Device& device, vk::PipelineLayout layout) {
  return create_pipeline(device, {.name = "shadow",
                                  .vertex_code = shaders::shadow_vert,
                                  .layout = layout,
                                  .bindings = SceneGeometry::bindings(),
                                  .attributes = {SceneGeometry::attributes().data(), 1},
                                  .depth_format = kDepthFormat,
                                  .depth = DepthUse::TestAndWrite,
                                  .depth_compare = vk::CompareOp::eLessOrEqual,
                                  .depth_bias_constant = kShadowBiasConstant,
                                  .depth_bias_slope = kShadowBiasSlope});
}

}  // namespace

ScenePass::ScenePass(const Device& device, const EyeTargets& eyes, vk::DescriptorSetLayout frame_set_layout)
    : layout_(create_pipeline_layout(device, {.sets = {&frame_set_layout, 1}})),
      shadow_(create_shadow_pipeline(device, *layout_)),
      opaque_(create_scene_pipeline(device, *layout_, eyes, Blending::Opaque)),
      background_(create_background_pipeline(device, *layout_, eyes)),
      blended_(create_scene_pipeline(device, *layout_, eyes, Blending::Premultiplied)) {}

void ScenePass::record_draws(const vk::raii::CommandBuffer& command, const Input& input, std::size_t first,
                             std::size_t end) const {
  for (const std::uint32_t i : input.order.subspan(first, end - first)) {
    const Draw& draw = input.geometry.draws()[i];
    if (input.visible.empty() || input.visible[draw.node] != 0) {
      command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, input.frame_set, i * input.draw_stride);
      command.setCullMode(draw.double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
      command.drawIndexed(draw.index_count, 1, draw.first_index, draw.first_vertex, 0);
    }
  }
}

void ScenePass::record_shadow(const vk::raii::CommandBuffer& command, const Input& input) const {
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, *shadow_);
  input.geometry.bind(command);
  record_draws(command, input, 0, input.geometry.opaque_count());
}

void ScenePass::record_eyes(const vk::raii::CommandBuffer& command, const Input& input) const {
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, *opaque_);
  input.geometry.bind(command);
  record_draws(command, input, 0, input.geometry.opaque_count());

  command.bindPipeline(vk::PipelineBindPoint::eGraphics, *background_);
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, input.frame_set, std::uint32_t{0});
  command.setCullMode(vk::CullModeFlagBits::eNone);
  command.draw(4, 1, 0, 0);

  command.bindPipeline(vk::PipelineBindPoint::eGraphics, *blended_);
  record_draws(command, input, input.geometry.opaque_count(), input.geometry.draws().size());
}

}  // namespace afm::render
