// SPDX-License-Identifier: Apache-2.0
#include "passes/shadow_map.h"

#include "device/barriers.h"
#include "device/pipelines.h"
#include "drawing/eye_targets.h"
#include "drawing/frame_blocks.h"

namespace afm::render {
namespace {

constexpr ImageUse kShadowSampled{vk::PipelineStageFlagBits2::eFragmentShader, vk::AccessFlagBits2::eShaderSampledRead,
                                  vk::ImageLayout::eShaderReadOnlyOptimal};

constexpr vk::Extent2D kSize{kShadowMapSize, kShadowMapSize};

DeviceImage create_map(const Device& device, const char* name, vk::ImageUsageFlags usage) {
  return create_image(
      device, name,
      {.format = kDepthFormat, .extent = kSize, .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | usage});
}

void begin_drawing(const vk::raii::CommandBuffer& command, vk::ImageView view, vk::AttachmentLoadOp before) {
  const vk::RenderingAttachmentInfo depth{.imageView = view,
                                          .imageLayout = kDepthTested.layout,
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
      view_(create_view(device, depth_, kDepthAspect, 0, 1)),
      static_view_(create_view(device, static_, kDepthAspect, 0, 1)) {}

void ShadowMap::begin(const vk::raii::CommandBuffer& command) const {
  record_barriers(command, {image_barrier(*depth_.image, kDepthAspect, kShadowSampled.discarded(), kDepthTested)});
  begin_drawing(command, *view_, vk::AttachmentLoadOp::eClear);
}

void ShadowMap::end(const vk::raii::CommandBuffer& command) const {
  command.endRendering();
  record_barriers(command, {image_barrier(*depth_.image, kDepthAspect, kDepthTested, kShadowSampled)});
}

void ShadowMap::begin_static(const vk::raii::CommandBuffer& command) const {
  record_barriers(command, {image_barrier(*static_.image, kDepthAspect, kCopiedFrom.discarded(), kDepthTested)});
  begin_drawing(command, *static_view_, vk::AttachmentLoadOp::eClear);
}

void ShadowMap::end_static(const vk::raii::CommandBuffer& command) const {
  command.endRendering();
  record_barriers(command, {image_barrier(*static_.image, kDepthAspect, kDepthTested, kCopiedFrom)});
}

void ShadowMap::begin_on_static(const vk::raii::CommandBuffer& command, const vk::Rect2D& dirty) const {
  if (dirty.extent.width == 0 || dirty.extent.height == 0) {
    record_barriers(command, {image_barrier(*depth_.image, kDepthAspect, kShadowSampled, kDepthTested)});
  } else {
    record_barriers(command, {image_barrier(*depth_.image, kDepthAspect, kShadowSampled, kCopiedTo)});
    const vk::ImageSubresourceLayers depth{.aspectMask = kDepthAspect, .layerCount = 1};
    const vk::Offset3D offset{dirty.offset.x, dirty.offset.y, 0};
    command.copyImage(*static_.image, kCopiedFrom.layout, *depth_.image, kCopiedTo.layout,
                      vk::ImageCopy{.srcSubresource = depth,
                                    .srcOffset = offset,
                                    .dstSubresource = depth,
                                    .dstOffset = offset,
                                    .extent = {dirty.extent.width, dirty.extent.height, 1}});
    record_barriers(command, {image_barrier(*depth_.image, kDepthAspect, kCopiedTo, kDepthTested)});
  }
  begin_drawing(command, *view_, vk::AttachmentLoadOp::eLoad);
}

}  // namespace afm::render
