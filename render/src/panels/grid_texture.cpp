// SPDX-License-Identifier: Apache-2.0
#include "panels/grid_texture.h"

#include <bit>
#include <cstring>

#include "device/barriers.h"

namespace afm::render {

void GridTexture::record_upload(const vk::raii::CommandBuffer& command, const Device& device, const GridSheet& sheet,
                                vk::DescriptorSetLayout layout, vk::Sampler sampler) {
  if (sheet.empty()) return;
  if (texture_.image.extent.height < sheet.height()) {
    const vk::Extent2D extent{GridSheet::kWidth, std::bit_ceil(sheet.height())};
    texture_ = create_panel_texture(
        device, "colour grids",
        {.format = vk::Format::eR8G8B8A8Unorm, .extent = extent, .usage = vk::ImageUsageFlagBits::eTransferDst}, layout,
        sampler);
    staging_ = create_host_buffer(device, "colour grids' staging", vk::DeviceSize{4} * extent.width * extent.height,
                                  vk::BufferUsageFlagBits::eTransferSrc);
  }
  std::memcpy(staging_.mapped, sheet.texels().data(), sheet.texels().size_bytes());
  const vk::Image image = *texture_.image.image;
  record_barriers(command, {image_barrier(image, kColorAspect, kPanelSampled.discarded(), kCopiedTo)});
  command.copyBufferToImage(*staging_.buffer, image, kCopiedTo.layout,
                            vk::BufferImageCopy{.imageSubresource = {.aspectMask = kColorAspect, .layerCount = 1},
                                                .imageExtent = {GridSheet::kWidth, sheet.height(), 1}});
  record_barriers(command, {image_barrier(image, kColorAspect, kCopiedTo, kPanelSampled)});
}

}  // namespace afm::render
