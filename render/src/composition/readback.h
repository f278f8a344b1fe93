// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/barriers.h"
#include "device/memory.h"
#include "render/image_file.h"

namespace afm::render {

// Copy of all layers of an image with four bytes per pixel in host memory, which is reused for the next one.
class HostCopy {
 public:
  // Requires the image in eTransferSrcOptimal, and the result of an earlier record() finished and no longer needed.
  void record(const Device& device, const vk::raii::CommandBuffer& command, vk::Image image, std::uint32_t layers,
              vk::Extent2D extent);

  // Result of the last record(), once its commands are done; valid until the next one. As of an image of kEyeFormat.
  ImageSpan picture(std::uint32_t layer) const;

 private:
  Buffer buffer_;
  vk::Extent2D extent_;
};

// Copies one layer of an image of kEyeFormat in eShaderReadOnlyOptimal, and leaves it in that layout; waits for the
// queue.
Image read_back(const Device& device, vk::Image image, std::uint32_t layer, vk::Extent2D extent);

}  // namespace afm::render
