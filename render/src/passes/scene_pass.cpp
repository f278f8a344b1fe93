// SPDX-License-Identifier: Apache-2.0
#include "passes/scene_pass.h"

#include <array>

#include "device/barriers.h"
#include "device/pipelines.h"
#include "shaders/background_frag.h"
#include "shaders/copies_vert.h"
#include "shaders/copies_vert_one_view.h"
#include "shaders/fullscreen_vert.h"
#include "shaders/material_frag.h"
#include "shaders/material_frag_one_view.h"
#include "shaders/material_vert.h"
#include "shaders/material_vert_one_view.h"
#include "shaders/per_vertex_frag.h"
#include "shaders/per_vertex_vert.h"
#include "shaders/per_vertex_vert_one_view.h"
#include "shaders/scene_frag.h"
#include "shaders/scene_frag_one_view.h"
#include "shaders/scene_vert.h"
#include "shaders/scene_vert_one_view.h"
#include "shaders/shadow_copies_vert.h"
#include "shaders/shadow_vert.h"
#include "shaders/smooth_frag.h"
#include "shaders/smooth_vert.h"
#include "shaders/smooth_vert_one_view.h"

namespace afm::render {
namespace {

constexpr EyeCode kSceneVertex{shaders::scene_vert, shaders::scene_vert_one_view};
constexpr EyeCode kSceneFragment{shaders::scene_frag, shaders::scene_frag_one_view};
constexpr EyeCode kCopiesVertex{shaders::copies_vert, shaders::copies_vert_one_view};
constexpr EyeCode kFineVertex{shaders::per_vertex_vert, shaders::per_vertex_vert_one_view};
constexpr EyeCode kFineFragment{shaders::per_vertex_frag, shaders::per_vertex_frag};
constexpr EyeCode kSmoothVertex{shaders::smooth_vert, shaders::smooth_vert_one_view};
constexpr EyeCode kSmoothFragment{shaders::smooth_frag, shaders::smooth_frag};
constexpr EyeCode kMaterialVertex{shaders::material_vert, shaders::material_vert_one_view};
constexpr EyeCode kMaterialFragment{shaders::material_frag, shaders::material_frag_one_view};
constexpr EyeCode kBackgroundVertex{shaders::fullscreen_vert, shaders::fullscreen_vert};
constexpr EyeCode kBackgroundFragment{shaders::background_frag, shaders::background_frag};

PipelineRequest scene_request(const ScenePass::Look& look, Blending blending) {
  const bool opaque = blending == Blending::Opaque;
  return {.name = opaque ? "opaque" : "blended",
          .layout = look.layout,
          .bindings = SceneGeometry::bindings(),
          .attributes = SceneGeometry::attributes(),
          .blending = blending,
          .depth = opaque ? DepthUse::TestAndWrite : DepthUse::TestOnly,
          .one_light = look.one_light};
}

EyePipeline plain_pipeline(const Device& device, const ScenePass::Look& look, Blending blending,
                           std::uint32_t variant) {
  PipelineRequest request = scene_request(look, blending);
  request.variant = variant;
  return {device, request, kSceneVertex, kSceneFragment};
}

EyePipeline copies_pipeline(const Device& device, const ScenePass::Look& look, std::uint32_t variant) {
  PipelineRequest request = scene_request(look, Blending::Opaque);
  request.name = "copies";
  request.bindings = SceneGeometry::copy_bindings();
  request.attributes = SceneGeometry::copy_attributes();
  request.variant = variant;
  return {device, request, kCopiesVertex, kSceneFragment};
}

// Area of the background: only where the depth is still cleared, or everywhere, which also clears the depth.
enum class Background { Behind, Erasing };
PipelineRequest background_request(vk::PipelineLayout layout, Background background) {
  const bool behind = background == Background::Behind;
  return {.name = behind ? "background" : "erasing background",
          .layout = layout,
          .topology = vk::PrimitiveTopology::eTriangleStrip,
          .depth = behind ? DepthUse::TestOnly : DepthUse::TestAndWrite,
          .depth_compare = behind ? vk::CompareOp::eEqual : vk::CompareOp::eAlways};
}

vk::PrimitiveTopology topology(scene::Topology topology) {
  switch (topology) {
    case scene::Topology::Points:
      return vk::PrimitiveTopology::ePointList;
    case scene::Topology::Lines:
      return vk::PrimitiveTopology::eLineList;
    default:
      return vk::PrimitiveTopology::eTriangleList;
  }
}

PipelineRequest variant_request(const ScenePass::Look& look, const ShaderVariant& variant) {
  return {.name = "look",
          .layout = look.layout,
          .bindings = SceneGeometry::variant_bindings(),
          .attributes = SceneGeometry::variant_attributes(),
          .topology = topology(variant.topology),
          .blending = variant.blended ? Blending::Premultiplied : Blending::Opaque,
          .depth = variant.blended ? DepthUse::TestOnly : DepthUse::TestAndWrite,
          .variant = variant.bits,
          .one_light = look.one_light};
}

vk::raii::PipelineLayout create_scene_layout(const Device& device, vk::DescriptorSetLayout frame,
                                             const FrameSetLayouts& layouts) {
  const std::array sets{frame, *layouts.draw};
  return create_pipeline_layout(device, {.sets = sets});
}

vk::raii::PipelineLayout create_variant_layout(const Device& device, const FrameSetLayouts& layouts,
                                               vk::DescriptorSetLayout material) {
  const std::array sets{*layouts.eyes, *layouts.draw, material};
  return create_pipeline_layout(device, {.sets = sets});
}

PipelineRequest shadow_request(vk::PipelineLayout layout) {
  return {.name = "shadow",
          .vertex_code = shaders::shadow_vert,
          .layout = layout,
          .bindings = SceneGeometry::bindings(),
          .attributes = {SceneGeometry::attributes().data(), 1},
          .depth_format = kDepthFormat,
          .depth = DepthUse::TestAndWrite,
          .depth_compare = vk::CompareOp::eLessOrEqual};
}

vk::raii::Pipeline create_shadow_of_copies(const Device& device, vk::PipelineLayout layout) {
  const auto& of_copies = SceneGeometry::copy_attributes();
  const std::array attributes{of_copies[0], of_copies[3], of_copies[4]};
  PipelineRequest request = shadow_request(layout);
  request.name = "shadow of copies";
  request.vertex_code = shaders::shadow_copies_vert;
  request.bindings = SceneGeometry::copy_bindings();
  request.attributes = attributes;
  return create_pipeline(device, request);
}

}  // namespace

ScenePass::ScenePass(const Device& device, const FrameSetLayouts& layouts, const SceneMaterials& materials,
                     const std::vector<ShaderVariant>& variants, Lighting lighting)
    : device_(device),
      one_light_(lighting == Lighting::KeyAlone),
      layout_(create_scene_layout(device, *layouts.eyes, layouts)),
      shadow_layout_(create_scene_layout(device, *layouts.shadow, layouts)),
      variant_layout_(create_variant_layout(device, layouts, materials.layout())),
      opaque_{plain_pipelines(device, plain_look(), Blending::Opaque, 0),
              plain_pipelines(device, plain_look(), Blending::Opaque, AFM_FEATURE_FOG)},
      copies_{copies_pipeline(device, plain_look(), 0), copies_pipeline(device, plain_look(), AFM_FEATURE_FOG)},
      fine_(device, scene_request(plain_look(), Blending::Opaque), kFineVertex, kFineFragment),
      background_(device, background_request(*layout_, Background::Behind), kBackgroundVertex, kBackgroundFragment),
      erasing_background_(device, background_request(*layout_, Background::Erasing), kBackgroundVertex,
                          kBackgroundFragment),
      blended_{plain_pipelines(device, plain_look(), Blending::Premultiplied, 0),
               plain_pipelines(device, plain_look(), Blending::Premultiplied, AFM_FEATURE_FOG)} {
  for (const ShaderVariant& variant : variants) {
    variants_.emplace_back(device, variant_request({*variant_layout_, one_light_}, variant), kMaterialVertex,
                           kMaterialFragment);
  }
}

ScenePass::PlainPipelines ScenePass::plain_pipelines(const Device& device, const Look& look, Blending blending,
                                                     std::uint32_t variant) {
  return {plain_pipeline(device, look, blending, variant),
          plain_pipeline(device, look, blending, variant | AFM_FEATURE_DOUBLE_SIDED),
          plain_pipeline(device, look, blending, variant | AFM_FEATURE_UNLIT),
          {device, scene_request(look, blending), kSmoothVertex, kSmoothFragment}};
}

void ScenePass::set_state(const vk::raii::CommandBuffer& command, vk::PipelineLayout layout, const Input& input,
                          std::uint32_t i, Sides& sides) {
  const bool double_sided = input.geometry.draws()[i].double_sided;
  const auto culled = double_sided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack;
  const auto front = input.draws.mirrored[i] != 0 ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise;
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, AFM_SET_DRAW, input.draw_set,
                             i * input.draw_stride);
  if (sides.culled != culled) command.setCullMode(culled);
  if (sides.front != front) command.setFrontFace(front);
  sides = {culled, front};
}

void ScenePass::draw_one(const vk::raii::CommandBuffer& command, const Input& input, std::uint32_t i) {
  const Draw& draw = input.geometry.draws()[i];
  if (draw.reshaped) command.bindVertexBuffers(0, input.shapes, vk::DeviceSize{0});
  command.drawIndexed(draw.index_count, input.draws.copies[i], draw.first_index, draw.first_vertex, draw.first_copy);
  if (draw.reshaped) input.geometry.bind(command);
}

void ScenePass::bind_buffers(const vk::raii::CommandBuffer& command, const Input& input) {
  input.geometry.bind(command);
  if (input.copies) command.bindVertexBuffers(kCopyBinding, input.copies, vk::DeviceSize{0});
}

EyePipeline& ScenePass::plain_one(const Draw& draw, Shading shading, bool hazy, PlainPipelines& plain) {
  if (draw.most_copies > 0) return copies_[hazy ? 1 : 0];
  if (shading == Shading::ByVertex) return fine_;
  if (shading == Shading::LightByVertex) return plain.smooth;
  if (draw.unlit) return plain.unlit;
  return draw.double_sided ? plain.double_sided : plain.single_sided;
}

void ScenePass::record_in_eyes(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing, const Input& input,
                               std::span<const std::uint32_t> draws, PlainPipelines& plain) {
  const EyePipeline* bound = nullptr;
  vk::DescriptorSet bound_material;
  Sides sides;
  for (const std::uint32_t i : draws) {
    if (input.box && input.frame->bounds(i).within(*input.box).empty()) continue;
    const Draw& draw = input.geometry.draws()[i];
    EyePipeline& pipeline =
        draw.variant ? variants_[*draw.variant] : plain_one(draw, input.draws.shading[i], input.draws.hazy, plain);
    if (&pipeline != bound) {
      command.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline.get(drawing.pass, drawing.samples));
      bound = &pipeline;
    }
    set_state(command, *layout_, input, i, sides);
    if (const auto material = draw.variant ? input.materials.set(draw.material) : bound_material;
        material != bound_material) {
      command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *variant_layout_, AFM_SET_MATERIAL, material,
                                 nullptr);
      bound_material = material;
    }
    draw_one(command, input, i);
  }
}

const vk::raii::Pipeline& ScenePass::shadow_pipeline(bool copied) {
  vk::raii::Pipeline& pipeline = copied ? shadow_copies_ : shadow_;
  if (!*pipeline) {
    pipeline = copied ? create_shadow_of_copies(device_, *shadow_layout_)
                      : create_pipeline(device_, shadow_request(*shadow_layout_));
  }
  return pipeline;
}

void ScenePass::record_shadow(const vk::raii::CommandBuffer& command, const Input& input,
                              std::span<const std::uint32_t> draws) {
  bind_buffers(command, input);
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *shadow_layout_, 0, input.frame_set, nullptr);
  const vk::raii::Pipeline* bound = nullptr;
  Sides sides;
  for (const std::uint32_t i : draws) {
    const vk::raii::Pipeline& pipeline = shadow_pipeline(input.geometry.draws()[i].most_copies > 0);
    if (&pipeline != bound) command.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
    bound = &pipeline;
    set_state(command, *shadow_layout_, input, i, sides);
    draw_one(command, input, i);
  }
}

void ScenePass::record_background(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing,
                                  EyePipeline& pipeline) {
  command.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline.get(drawing.pass, drawing.samples));
  command.setCullMode(vk::CullModeFlagBits::eNone);
  command.draw(4, 1, 0, 0);
}

// Draws the background over the old contents of a box, and clears its depth.
void ScenePass::erase(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing, const PixelBox& box) {
  if (!one_light_) return record_background(command, drawing, erasing_background_);
  const std::array cleared{
      vk::ClearAttachment{.aspectMask = kColorAspect, .clearValue = kPlainBackground},
      vk::ClearAttachment{.aspectMask = kDepthAspect, .clearValue = vk::ClearDepthStencilValue{.depth = 0.0F}}};
  command.clearAttachments(cleared, vk::ClearRect{.rect = box.rect(), .layerCount = 1});
}

void ScenePass::record_eyes(const vk::raii::CommandBuffer& command, const EyePassConfig& drawing, const Input& input) {
  bind_buffers(command, input);
  command.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, input.frame_set, nullptr);
  const std::size_t fog = input.draws.hazy ? 1 : 0;
  if (input.box) erase(command, drawing, *input.box);
  record_in_eyes(command, drawing, input, input.draws.opaque, opaque_[fog]);
  if (!input.box && !one_light_) record_background(command, drawing, background_);
  record_in_eyes(command, drawing, input, input.draws.blended, blended_[fog]);
  command.setFrontFace(vk::FrontFace::eCounterClockwise);
}

}  // namespace afm::render
