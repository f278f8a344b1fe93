// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "memory.h"

namespace afm::render {

// The depth image that the key light sees, and the comparing sampler that reads it.
class ShadowMap {
 public:
  explicit ShadowMap(const Device& device);

  // Everything between them is drawn into the map; afterwards fragment shaders can sample it.
  void begin(const vk::raii::CommandBuffer& command) const;
  void end(const vk::raii::CommandBuffer& command) const;

  vk::DescriptorImageInfo descriptor() const;

 private:
  DeviceImage depth_;
  vk::raii::ImageView view_;
  vk::raii::Sampler sampler_;
};

}  // namespace afm::render
