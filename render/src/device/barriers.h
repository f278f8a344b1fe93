// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>

#include "device/vulkan.h"

namespace afm::render {

// Use of an image at one point of a command buffer. Every barrier of the renderer is made of two of these, with stages
// and accesses spelled out at the call.
struct ImageUse {
  vk::PipelineStageFlags2 stages;
  vk::AccessFlags2 access;
  vk::ImageLayout layout = vk::ImageLayout::eUndefined;

  // Same use, with the image's contents discarded: only the earlier accesses have to finish.
  constexpr ImageUse discarded() const { return {stages, access, vk::ImageLayout::eUndefined}; }
};

// Uses shared by several passes.
inline constexpr ImageUse kColorDrawn{
    vk::PipelineStageFlagBits2::eColorAttachmentOutput,
    // read access for a pass that loads the output of another
    vk::AccessFlagBits2::eColorAttachmentRead | vk::AccessFlagBits2::eColorAttachmentWrite,
    vk::ImageLayout::eColorAttachmentOptimal};
inline constexpr ImageUse kDepthTested{
    vk::PipelineStageFlagBits2::eEarlyFragmentTests | vk::PipelineStageFlagBits2::eLateFragmentTests,
    vk::AccessFlagBits2::eDepthStencilAttachmentRead | vk::AccessFlagBits2::eDepthStencilAttachmentWrite,
    vk::ImageLayout::eDepthAttachmentOptimal};
inline constexpr ImageUse kCopiedFrom{vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferRead,
                                      vk::ImageLayout::eTransferSrcOptimal};
inline constexpr ImageUse kCopiedTo{vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferWrite,
                                    vk::ImageLayout::eTransferDstOptimal};

inline constexpr auto kColorAspect = vk::ImageAspectFlagBits::eColor;
inline constexpr auto kDepthAspect = vk::ImageAspectFlagBits::eDepth;

struct LayerRange {
  std::uint32_t first = 0;
  std::uint32_t count = VK_REMAINING_ARRAY_LAYERS;
};

inline vk::ImageMemoryBarrier2 image_barrier(vk::Image image, vk::ImageAspectFlags aspect, const ImageUse& before,
                                             const ImageUse& after, LayerRange layers = {}) {
  return {.srcStageMask = before.stages,
          .srcAccessMask = before.access,
          .dstStageMask = after.stages,
          .dstAccessMask = after.access,
          .oldLayout = before.layout,
          .newLayout = after.layout,
          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
          .image = image,
          .subresourceRange = {.aspectMask = aspect,
                               .levelCount = VK_REMAINING_MIP_LEVELS,
                               .baseArrayLayer = layers.first,
                               .layerCount = layers.count}};
}

inline void record_barriers(const vk::raii::CommandBuffer& command,
                            std::initializer_list<vk::ImageMemoryBarrier2> barriers) {
  command.pipelineBarrier2({.imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
                            .pImageMemoryBarriers = barriers.begin()});
}

}  // namespace afm::render
