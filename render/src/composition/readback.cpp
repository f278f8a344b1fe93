// SPDX-License-Identifier: Apache-2.0
#include "composition/readback.h"

#include "drawing/eye_targets.h"

namespace afm::render {
namespace {

static_assert(kEyeFormat == vk::Format::eB8G8R8A8Unorm);
constexpr auto kOrder = ChannelOrder::Bgra;

std::size_t bytes_of(vk::Extent2D extent) { return std::size_t{4} * extent.width * extent.height; }

void record_copy(const vk::raii::CommandBuffer& command, vk::Image image, std::uint32_t first_layer,
                 std::uint32_t layers, vk::Extent2D extent, const Buffer& to) {
  command.copyImageToBuffer(image, vk::ImageLayout::eTransferSrcOptimal, *to.buffer,
                            vk::BufferImageCopy{.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                                     .baseArrayLayer = first_layer,
                                                                     .layerCount = layers},
                                                .imageExtent = {extent.width, extent.height, 1}});
  const vk::MemoryBarrier2 to_host{.srcStageMask = vk::PipelineStageFlagBits2::eCopy,
                                   .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                   .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                   .dstAccessMask = vk::AccessFlagBits2::eHostRead};
  command.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &to_host});
}

}  // namespace

void HostCopy::record(const Device& device, const vk::raii::CommandBuffer& command, vk::Image image,
                      std::uint32_t layers, vk::Extent2D extent) {
  extent_ = extent;
  const std::size_t bytes = layers * bytes_of(extent_);
  if (buffer_.size != bytes) {
    buffer_ = create_readback_buffer(device, "read back", bytes, vk::BufferUsageFlagBits::eTransferDst);
  }
  record_copy(command, image, 0, layers, extent_, buffer_);
}

ImageSpan HostCopy::picture(std::uint32_t layer) const {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(buffer_.mapped);
  return {extent_.width, extent_.height, {bytes + layer * bytes_of(extent_), bytes_of(extent_)}, kOrder};
}

Image read_back(const Device& device, vk::Image image, std::uint32_t layer, vk::Extent2D extent) {
  const Buffer host =
      create_readback_buffer(device, "read back", bytes_of(extent), vk::BufferUsageFlagBits::eTransferDst);
  const ImageUse shown{vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eNone,
                       vk::ImageLayout::eShaderReadOnlyOptimal};
  device.run_once([&](const vk::raii::CommandBuffer& command) {
    record_barriers(command, {image_barrier(image, vk::ImageAspectFlagBits::eColor, shown, kCopiedFrom)});
    record_copy(command, image, layer, 1, extent, host);
    record_barriers(command, {image_barrier(image, vk::ImageAspectFlagBits::eColor, kCopiedFrom, shown)});
  });
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(host.mapped);
  return to_image({extent.width, extent.height, {bytes, bytes_of(extent)}, kOrder});
}

}  // namespace afm::render
