// SPDX-License-Identifier: Apache-2.0
#include "shadow_map.h"

#include "barriers.h"
#include "eye_targets.h"
#include "frame_blocks.h"
#include "pipelines.h"

namespace afm::render {
namespace {

constexpr ImageUse kSampled{vk::PipelineStageFlagBits2::eVertexShader | vk::PipelineStageFlagBits2::eFragmentShader,
                            vk::AccessFlagBits2::eShaderSampledRead, vk::ImageLayout::eShaderReadOnlyOptimal};
constexpr ImageUse kDrawn{
    vk::PipelineStageFlagBits2::eEarlyFragmentTests | vk::PipelineStageFlagBits2::eLateFragmentTests,
    vk::AccessFlagBits2::eDepthStencilAttachmentRead | vk::AccessFlagBits2::eDepthStencilAttachmentWrite,
    vk::ImageLayout::eDepthAttachmentOptimal};

}  // namespace

ShadowMap::ShadowMap(const Device& device)
    : depth_(
          create_image(device, "shadow map",
                       {.format = kDepthFormat,
                        .extent = {kShadowMapSize, kShadowMapSize},
                        .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled})),
      view_(create_view(device, depth_, vk::ImageAspectFlagBits::eDepth, 0, 1)),
      sampler_(*device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear,
                                              .minFilter = vk::Filter::eLinear,
                                              .addressModeU = vk::SamplerAddressMode::eClampToBorder,
                                              .addressModeV = vk::SamplerAddressMode::eClampToBorder,
                                              .addressModeW = vk::SamplerAddressMode::eClampToBorder,
                                              .compareEnable = VK_TRUE,
                                              .compareOp = vk::CompareOp::eLessOrEqual,
                                              .borderColor = vk::BorderColor::eFloatOpaqueWhite}) {}

void ShadowMap::begin(const vk::raii::CommandBuffer& command) const {
  record_barriers(command,
                  {image_barrier(*depth_.image, vk::ImageAspectFlagBits::eDepth, kSampled.discarded(), kDrawn)});
  const vk::RenderingAttachmentInfo depth{.imageView = *view_,
                                          .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eStore,
                                          .clearValue = vk::ClearDepthStencilValue{.depth = 1.0F}};
  command.beginRendering({.renderArea = {.extent = depth_.extent}, .layerCount = 1, .pDepthAttachment = &depth});
  set_viewport(command, depth_.extent);
}

void ShadowMap::end(const vk::raii::CommandBuffer& command) const {
  command.endRendering();
  record_barriers(command, {image_barrier(*depth_.image, vk::ImageAspectFlagBits::eDepth, kDrawn, kSampled)});
}

vk::DescriptorImageInfo ShadowMap::descriptor() const {
  return {.sampler = *sampler_, .imageView = *view_, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
}

}  // namespace afm::render
