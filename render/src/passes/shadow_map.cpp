// SPDX-License-Identifier: Apache-2.0
#include "passes/shadow_map.h"

#include "device/barriers.h"
#include "device/frame_blocks.h"
#include "device/pipelines.h"
#include "passes/eye_targets.h"

namespace afm::render {
namespace {

constexpr ImageUse kSampled{vk::PipelineStageFlagBits2::eVertexShader | vk::PipelineStageFlagBits2::eFragmentShader,
                            vk::AccessFlagBits2::eShaderSampledRead, vk::ImageLayout::eShaderReadOnlyOptimal};
constexpr ImageUse kDrawn{
    vk::PipelineStageFlagBits2::eEarlyFragmentTests | vk::PipelineStageFlagBits2::eLateFragmentTests,
    vk::AccessFlagBits2::eDepthStencilAttachmentRead | vk::AccessFlagBits2::eDepthStencilAttachmentWrite,
    vk::ImageLayout::eDepthAttachmentOptimal};

constexpr ImageUse kCopiedFrom{vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferRead,
                               vk::ImageLayout::eTransferSrcOptimal};
constexpr ImageUse kCopiedTo{vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferWrite,
                             vk::ImageLayout::eTransferDstOptimal};

constexpr auto kDepth = vk::ImageAspectFlagBits::eDepth;
constexpr vk::Extent2D kSize{kShadowMapSize, kShadowMapSize};

DeviceImage create_map(const Device& device, const char* name, vk::ImageUsageFlags usage) {
  return create_image(
      device, name,
      {.format = kDepthFormat, .extent = kSize, .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | usage});
}

void begin_drawing(const vk::raii::CommandBuffer& command, vk::ImageView view, vk::AttachmentLoadOp before) {
  const vk::RenderingAttachmentInfo depth{.imageView = view,
                                          .imageLayout = kDrawn.layout,
                                          .loadOp = before,
                                          .storeOp = vk::AttachmentStoreOp::eStore,
                                          .clearValue = vk::ClearDepthStencilValue{.depth = 1.0F}};
  command.beginRendering({.renderArea = {.extent = kSize}, .layerCount = 1, .pDepthAttachment = &depth});
  set_viewport(command, kSize);
}

}  // namespace

ShadowMap::ShadowMap(const Device& device)
    : depth_(create_map(device, "shadow map", vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst)),
      static_(create_map(device, "static shadow map", vk::ImageUsageFlagBits::eTransferSrc)),
      view_(create_view(device, depth_, kDepth, 0, 1)),
      static_view_(create_view(device, static_, kDepth, 0, 1)),
      sampler_(*device, vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear,
                                              .minFilter = vk::Filter::eLinear,
                                              .addressModeU = vk::SamplerAddressMode::eClampToBorder,
                                              .addressModeV = vk::SamplerAddressMode::eClampToBorder,
                                              .addressModeW = vk::SamplerAddressMode::eClampToBorder,
                                              .compareEnable = VK_TRUE,
                                              .compareOp = vk::CompareOp::eLessOrEqual,
                                              .borderColor = vk::BorderColor::eFloatOpaqueWhite}) {}

void ShadowMap::begin(const vk::raii::CommandBuffer& command) const {
  record_barriers(command, {image_barrier(*depth_.image, kDepth, kSampled.discarded(), kDrawn)});
  begin_drawing(command, *view_, vk::AttachmentLoadOp::eClear);
}

void ShadowMap::end(const vk::raii::CommandBuffer& command) const {
  command.endRendering();
  record_barriers(command, {image_barrier(*depth_.image, kDepth, kDrawn, kSampled)});
}

void ShadowMap::begin_static(const vk::raii::CommandBuffer& command) const {
  record_barriers(command, {image_barrier(*static_.image, kDepth, kCopiedFrom.discarded(), kDrawn)});
  begin_drawing(command, *static_view_, vk::AttachmentLoadOp::eClear);
}

void ShadowMap::end_static(const vk::raii::CommandBuffer& command) const {
  command.endRendering();
  record_barriers(command, {image_barrier(*static_.image, kDepth, kDrawn, kCopiedFrom)});
}

void ShadowMap::begin_on_static(const vk::raii::CommandBuffer& command, const vk::Rect2D& dirty) const {
  if (dirty.extent.width == 0 || dirty.extent.height == 0) {
    record_barriers(command, {image_barrier(*depth_.image, kDepth, kSampled, kDrawn)});
  } else {
    record_barriers(command, {image_barrier(*depth_.image, kDepth, kSampled, kCopiedTo)});
    const vk::ImageSubresourceLayers depth{.aspectMask = kDepth, .layerCount = 1};
    const vk::Offset3D offset{dirty.offset.x, dirty.offset.y, 0};
    command.copyImage(*static_.image, kCopiedFrom.layout, *depth_.image, kCopiedTo.layout,
                      vk::ImageCopy{.srcSubresource = depth,
                                    .srcOffset = offset,
                                    .dstSubresource = depth,
                                    .dstOffset = offset,
                                    .extent = {dirty.extent.width, dirty.extent.height, 1}});
    record_barriers(command, {image_barrier(*depth_.image, kDepth, kCopiedTo, kDrawn)});
  }
  begin_drawing(command, *view_, vk::AttachmentLoadOp::eLoad);
}

vk::DescriptorImageInfo ShadowMap::descriptor() const {
  return {.sampler = *sampler_, .imageView = *view_, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
}

}  // namespace afm::render
