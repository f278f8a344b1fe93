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

PipelineRequest scene_request(vk::PipelineLayout layout, Blending blending) {
  const bool opaque = blending == Blending::Opaque;
  return {.name = opaque ? "opaque" : "blended",
          .vertex_code = shaders::scene_vert,
          .fragment_code = shaders::scene_frag,
          .layout = layout,
          .bindings = SceneGeometry::bindings(),
          .attributes = SceneGeometry::attributes(),
          .blending = blending,
          .depth = opaque ? DepthUse::TestAndWrite : DepthUse::TestOnly};
}

PipelineRequest background_request(vk::PipelineLayout layout) {
  return {.name = "background",
          .vertex_code = shaders::fullscreen_vert,
          .fragment_code = shaders::background_frag,
          .layout = layout,
          .topology = vk::PrimitiveTopology::eTriangleStrip,
          .depth = DepthUse::TestOnly,
          .depth_compare = vk::CompareOp::eEqual};  // only where the depth is still the cleared one
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

ScenePass::ScenePass(const Device& device, vk::DescriptorSetLayout frame_set_layout)
    : layout_(create_pipeline_layout(device, {.sets = {&frame_set_layout, 1}})),
      shadow_(create_shadow_pipeline(device, *layout_)),
      opaque_(device, scene_request(*layout_, Blending::Opaque)),
      background_(device, background_request(*layout_)),
      blended_(device, scene_request(*layout_, Blending::Premultiplied)) {}

void ScenePass::record_draws(const vk::raii::CommandBuffer& command, const Input& input,
                             std::span<const std::uint32_t> draws) const {
  for (const std::uint32_t i : draws) {
    const Draw& draw = input.geometry.draws()[i];
    command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, input.frame_set, i * input.draw_stride);
    command.setCullMode(draw.double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    command.drawIndexed(draw.index_count, 1, draw.first_index, draw.first_vertex, 0);
  }
}

void ScenePass::record_shadow(const vk::raii::CommandBuffer& command, const Input& input) const {
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, *shadow_);
  input.geometry.bind(command);
  record_draws(command, input, input.draws.shadow);
}

void ScenePass::record_eyes(const vk::raii::CommandBuffer& command, const EyeDrawing& drawing, const Input& input) {
  const auto bind = [&](EyePipeline& pipeline) {
    command.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline.get(drawing.pass, drawing.samples));
  };
  bind(opaque_);
  input.geometry.bind(command);
  record_draws(command, input, input.draws.opaque);

  bind(background_);
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, input.frame_set, std::uint32_t{0});
  command.setCullMode(vk::CullModeFlagBits::eNone);
  command.draw(4, 1, 0, 0);

  bind(blended_);
  record_draws(command, input, input.draws.blended);
}

}  // namespace afm::render
