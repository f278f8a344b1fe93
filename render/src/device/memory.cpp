// SPDX-License-Identifier: Apache-2.0
#include "device/memory.h"

#include <array>
#include <cstring>

#include "device/memory_type.h"

namespace afm::render {
namespace {

constexpr vk::MemoryPropertyFlags kHostMemory =
    vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;

// Maps host-visible memory.
Buffer create_buffer(const Device& device, const std::string& name, vk::DeviceSize size, vk::BufferUsageFlags usage,
                     vk::MemoryPropertyFlags needed, vk::MemoryPropertyFlags useful = {}) {
  Buffer result;
  result.size = size;
  result.buffer = vk::raii::Buffer(*device, {.size = size, .usage = usage});
  const auto needs = result.buffer.getMemoryRequirements();
  const std::uint32_t type = memory_type(device.physical().getMemoryProperties(), needs.memoryTypeBits, needed, useful);
  result.memory = vk::raii::DeviceMemory(*device, {.allocationSize = needs.size, .memoryTypeIndex = type});
  result.buffer.bindMemory(*result.memory, 0);
  device.set_name(result.buffer, name);
  if (needed & vk::MemoryPropertyFlagBits::eHostVisible) {
    result.mapped = static_cast<std::byte*>(result.memory.mapMemory(0, VK_WHOLE_SIZE));
  }
  return result;
}

}  // namespace

Buffer create_host_buffer(const Device& device, const std::string& name, vk::DeviceSize size,
                          vk::BufferUsageFlags usage) {
  return create_buffer(device, name, size, usage, kHostMemory);
}

Buffer create_readback_buffer(const Device& device, const std::string& name, vk::DeviceSize size,
                              vk::BufferUsageFlags usage) {
  return create_buffer(device, name, size, usage, kHostMemory, vk::MemoryPropertyFlagBits::eHostCached);
}

Buffer upload_buffer(const Device& device, const std::string& name, std::span<const std::byte> bytes,
                     vk::BufferUsageFlags usage) {
  const Buffer staging =
      create_host_buffer(device, name + " staging", bytes.size(), vk::BufferUsageFlagBits::eTransferSrc);
  std::memcpy(staging.mapped, bytes.data(), bytes.size());
  Buffer result = create_buffer(device, name, bytes.size(), usage | vk::BufferUsageFlagBits::eTransferDst,
                                vk::MemoryPropertyFlagBits::eDeviceLocal);
  device.run_once([&](const vk::raii::CommandBuffer& command) {
    command.copyBuffer(*staging.buffer, *result.buffer, vk::BufferCopy{.size = bytes.size()});
  });
  return result;
}

DeviceImage create_image(const Device& device, const std::string& name, const ImageRequest& request) {
  DeviceImage result;
  result.format = request.format;
  result.extent = request.extent;
  result.layers = request.layers;
  const std::array formats{request.format, request.seen_as};
  const vk::ImageFormatListCreateInfo list{.viewFormatCount = static_cast<std::uint32_t>(formats.size()),
                                           .pViewFormats = formats.data()};
  const bool two_formats = request.seen_as != vk::Format::eUndefined;
  result.image =
      vk::raii::Image(*device, {.pNext = two_formats ? &list : nullptr,
                                .flags = two_formats ? vk::ImageCreateFlagBits::eMutableFormat : vk::ImageCreateFlags(),
                                .imageType = vk::ImageType::e2D,
                                .format = request.format,
                                .extent = {request.extent.width, request.extent.height, 1},
                                .mipLevels = request.mip_levels,
                                .arrayLayers = request.layers,
                                .samples = request.samples,
                                .usage = request.usage});
  const auto needs = result.image.getMemoryRequirements();
  const std::uint32_t type = memory_type(device.physical().getMemoryProperties(), needs.memoryTypeBits,
                                         vk::MemoryPropertyFlagBits::eDeviceLocal);
  result.memory = vk::raii::DeviceMemory(*device, {.allocationSize = needs.size, .memoryTypeIndex = type});
  result.image.bindMemory(*result.memory, 0);
  device.set_name(result.image, name);
  return result;
}

vk::raii::ImageView create_view(const Device& device, const DeviceImage& image, vk::ImageAspectFlags aspect,
                                std::uint32_t first, std::uint32_t layers, vk::Format seen_as) {
  return vk::raii::ImageView(*device, {.image = *image.image,
                                       .viewType = layers > 1 ? vk::ImageViewType::e2DArray : vk::ImageViewType::e2D,
                                       .format = seen_as == vk::Format::eUndefined ? image.format : seen_as,
                                       .subresourceRange = {.aspectMask = aspect,
                                                            .baseMipLevel = 0,
                                                            .levelCount = VK_REMAINING_MIP_LEVELS,
                                                            .baseArrayLayer = first,
                                                            .layerCount = layers}});
}

}  // namespace afm::render
