// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/barriers.h"
#include "device/memory.h"
#include "render/image_file.h"

namespace afm::render {

// All layers of an image of kEyeFormat in host memory, which is kept for the next one.
class HostCopy {
 public:
  // The image lies in eTransferSrcOptimal; what an earlier record() wrote is done and not needed any more.
  void record(const Device& device, const vk::raii::CommandBuffer& command, const DeviceImage& image);

  // Of the last record(), once its commands are done; until the next one.
  ImageSpan picture(std::uint32_t layer) const;

 private:
  Buffer buffer_;
  vk::Extent2D extent_;
};

// Copies one layer of an image of kEyeFormat that lies in eShaderReadOnlyOptimal, and leaves it there; waits for the
// queue.
Image read_back(const Device& device, vk::Image image, std::uint32_t layer, vk::Extent2D extent);

}  // namespace afm::render
