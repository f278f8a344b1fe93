// SPDX-License-Identifier: Apache-2.0
#include "readback.h"

#include <cstring>

#include "barriers.h"

namespace afm::render {

Image read_back(const Device& device, vk::Image image, std::uint32_t layer, vk::Extent2D extent) {
  const std::size_t bytes = std::size_t{4} * extent.width * extent.height;
  const Buffer host = create_host_buffer(device, "read back", bytes, vk::BufferUsageFlagBits::eTransferDst);
  const ImageUse shown{vk::PipelineStageFlagBits2::eAllCommands, vk::AccessFlagBits2::eNone,
                       vk::ImageLayout::eShaderReadOnlyOptimal};
  const ImageUse copied{vk::PipelineStageFlagBits2::eCopy, vk::AccessFlagBits2::eTransferRead,
                        vk::ImageLayout::eTransferSrcOptimal};
  device.run_once([&](const vk::raii::CommandBuffer& command) {
    record_barriers(command, {image_barrier(image, vk::ImageAspectFlagBits::eColor, shown, copied)});
    command.copyImageToBuffer(image, vk::ImageLayout::eTransferSrcOptimal, *host.buffer,
                              vk::BufferImageCopy{.imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                                       .baseArrayLayer = layer,
                                                                       .layerCount = 1},
                                                  .imageExtent = {extent.width, extent.height, 1}});
    record_barriers(command, {image_barrier(image, vk::ImageAspectFlagBits::eColor, copied, shown)});
    const vk::MemoryBarrier2 to_host{.srcStageMask = vk::PipelineStageFlagBits2::eCopy,
                                     .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                     .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                     .dstAccessMask = vk::AccessFlagBits2::eHostRead};
    command.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &to_host});
  });
  Image result{.width = extent.width, .height = extent.height, .rgba = std::vector<std::uint8_t>(bytes)};
  std::memcpy(result.rgba.data(), host.mapped, bytes);
  return result;
}

}  // namespace afm::render
