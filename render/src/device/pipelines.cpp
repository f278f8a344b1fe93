// SPDX-License-Identifier: Apache-2.0
#include "device/pipelines.h"

#include <array>
#include <cstddef>
#include <vector>

#include "device/shader_interface.h"

namespace afm::render {
namespace {

constexpr std::array kDynamicStates{vk::DynamicState::eViewport, vk::DynamicState::eScissor,
                                    vk::DynamicState::eCullMode, vk::DynamicState::eFrontFace};

// Specialisation constants of all shaders; one that does not use them ignores them.
struct Constants {
  std::uint32_t variant;
  vk::Bool32 one_light;
};
constexpr std::array<vk::SpecializationMapEntry, 2> kConstants{
    {{.constantID = AFM_CONSTANT_VARIANT, .offset = offsetof(Constants, variant), .size = sizeof(std::uint32_t)},
     {.constantID = AFM_CONSTANT_ONE_LIGHT, .offset = offsetof(Constants, one_light), .size = sizeof(vk::Bool32)}}};

vk::raii::ShaderModule create_module(const Device& device, std::span<const std::uint32_t> code) {
  return vk::raii::ShaderModule(*device, {.codeSize = code.size_bytes(), .pCode = code.data()});
}

vk::PipelineColorBlendAttachmentState blend_state(Blending blending) {
  using Component = vk::ColorComponentFlagBits;
  return {.blendEnable = blending == Blending::Premultiplied,
          .srcColorBlendFactor = vk::BlendFactor::eOne,
          .dstColorBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
          .colorBlendOp = vk::BlendOp::eAdd,
          .srcAlphaBlendFactor = vk::BlendFactor::eOne,
          .dstAlphaBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
          .alphaBlendOp = vk::BlendOp::eAdd,
          .colorWriteMask = Component::eR | Component::eG | Component::eB | Component::eA};
}

vk::PipelineDepthStencilStateCreateInfo depth_state(const PipelineRequest& request) {
  return {.depthTestEnable = request.depth != DepthUse::None,
          .depthWriteEnable = request.depth == DepthUse::TestAndWrite,
          .depthCompareOp = request.depth_compare};
}

}  // namespace

vk::raii::Pipeline create_pipeline(const Device& device, const PipelineRequest& request) {
  const Constants constants{request.variant, request.one_light ? VK_TRUE : VK_FALSE};
  const vk::SpecializationInfo specialization{.mapEntryCount = static_cast<std::uint32_t>(kConstants.size()),
                                              .pMapEntries = kConstants.data(),
                                              .dataSize = sizeof(constants),
                                              .pData = &constants};
  std::vector<vk::raii::ShaderModule> modules;
  std::vector<vk::PipelineShaderStageCreateInfo> stages;
  modules.push_back(create_module(device, request.vertex_code));
  stages.push_back({.stage = vk::ShaderStageFlagBits::eVertex,
                    .module = *modules.back(),
                    .pName = "main",
                    .pSpecializationInfo = &specialization});
  if (!request.fragment_code.empty()) {
    modules.push_back(create_module(device, request.fragment_code));
    stages.push_back({.stage = vk::ShaderStageFlagBits::eFragment,
                      .module = *modules.back(),
                      .pName = "main",
                      .pSpecializationInfo = &specialization});
  }

  const vk::PipelineVertexInputStateCreateInfo vertex_input{
      .vertexBindingDescriptionCount = static_cast<std::uint32_t>(request.bindings.size()),
      .pVertexBindingDescriptions = request.bindings.data(),
      .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(request.attributes.size()),
      .pVertexAttributeDescriptions = request.attributes.data()};
  const vk::PipelineInputAssemblyStateCreateInfo assembly{.topology = request.topology};
  const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
  const vk::PipelineRasterizationStateCreateInfo raster{.polygonMode = vk::PolygonMode::eFill, .lineWidth = 1.0F};
  const vk::PipelineMultisampleStateCreateInfo multisample{.rasterizationSamples = request.samples};
  const auto depth = depth_state(request);
  const auto blend_attachment = blend_state(request.blending);
  const bool has_color = request.color_format != vk::Format::eUndefined;
  const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = has_color ? 1U : 0U,
                                                    .pAttachments = &blend_attachment};
  const vk::PipelineDynamicStateCreateInfo dynamic{
      .dynamicStateCount = static_cast<std::uint32_t>(kDynamicStates.size()), .pDynamicStates = kDynamicStates.data()};
  const vk::PipelineRenderingCreateInfo rendering{.viewMask = request.view_mask,
                                                  .colorAttachmentCount = has_color ? 1U : 0U,
                                                  .pColorAttachmentFormats = &request.color_format,
                                                  .depthAttachmentFormat = request.depth_format};
  vk::raii::Pipeline pipeline(*device, nullptr,
                              vk::GraphicsPipelineCreateInfo{.pNext = &rendering,
                                                             .stageCount = static_cast<std::uint32_t>(stages.size()),
                                                             .pStages = stages.data(),
                                                             .pVertexInputState = &vertex_input,
                                                             .pInputAssemblyState = &assembly,
                                                             .pViewportState = &viewport,
                                                             .pRasterizationState = &raster,
                                                             .pMultisampleState = &multisample,
                                                             .pDepthStencilState = &depth,
                                                             .pColorBlendState = &blend,
                                                             .pDynamicState = &dynamic,
                                                             .layout = request.layout});
  device.set_name(pipeline, request.name);
  return pipeline;
}

vk::raii::PipelineLayout create_pipeline_layout(const Device& device, const LayoutRequest& request) {
  const vk::PushConstantRange push{.stageFlags = request.push_stages, .offset = 0, .size = request.push_size};
  return vk::raii::PipelineLayout(*device, {.setLayoutCount = static_cast<std::uint32_t>(request.sets.size()),
                                            .pSetLayouts = request.sets.data(),
                                            .pushConstantRangeCount = request.push_size > 0 ? 1U : 0U,
                                            .pPushConstantRanges = &push});
}

void set_viewport(const vk::raii::CommandBuffer& command, vk::Extent2D extent, float guard_band) {
  const auto width = static_cast<float>(extent.width);
  const auto height = static_cast<float>(extent.height);
  command.setViewport(0, vk::Viewport{.x = 0.5F * width * (1.0F - guard_band),
                                      .y = 0.5F * height * (1.0F - guard_band),
                                      .width = width * guard_band,
                                      .height = height * guard_band,
                                      .minDepth = 0.0F,
                                      .maxDepth = 1.0F});
  command.setScissor(0, vk::Rect2D{.extent = extent});
  command.setCullMode(vk::CullModeFlagBits::eNone);
  command.setFrontFace(vk::FrontFace::eCounterClockwise);
}

}  // namespace afm::render
