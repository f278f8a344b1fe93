// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "device/device.h"

namespace afm::render {

// A buffer with dedicated memory. `mapped` is null in device-local memory; otherwise it is valid and coherent for the
// buffer's lifetime.
struct Buffer {
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Buffer buffer{nullptr};
  std::byte* mapped = nullptr;
  vk::DeviceSize size = 0;
};

// An image with dedicated memory.
struct DeviceImage {
  vk::raii::DeviceMemory memory{nullptr};
  vk::raii::Image image{nullptr};
  vk::Format format = vk::Format::eUndefined;
  vk::Extent2D extent;
  std::uint32_t layers = 1;
};

struct ImageRequest {
  vk::Format format = vk::Format::eUndefined;
  vk::Extent2D extent{};
  vk::ImageUsageFlags usage{};
  std::uint32_t layers = 1;
  std::uint32_t mip_levels = 1;
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::Format seen_as = vk::Format::eUndefined;  // additional format for views
};

// Buffer for data written by the CPU.
Buffer create_host_buffer(const Device& device, const std::string& name, vk::DeviceSize size,
                          vk::BufferUsageFlags usage);

// Buffer for data read by the CPU, in cached memory if there is any. The first host-visible memory type of a GPU is
// often uncached, and every byte of a picture would be fetched separately.
Buffer create_readback_buffer(const Device& device, const std::string& name, vk::DeviceSize size,
                              vk::BufferUsageFlags usage);

// Copies `bytes` into device-local memory and waits until it is done.
Buffer upload_buffer(const Device& device, const std::string& name, std::span<const std::byte> bytes,
                     vk::BufferUsageFlags usage);

DeviceImage create_image(const Device& device, const std::string& name, const ImageRequest& request);

// View of `layers` layers from `first`: an array view if there is more than one. Uses the image's format unless another
// is given.
vk::raii::ImageView create_view(const Device& device, const DeviceImage& image, vk::ImageAspectFlags aspect,
                                std::uint32_t first, std::uint32_t layers, vk::Format seen_as = vk::Format::eUndefined);

}  // namespace afm::render
