// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/memory.h"

namespace afm::render {

// The depth image that the key light sees, the comparing sampler that reads it, and an image of what rests, from which
// places of it are restored.
class ShadowMap {
 public:
  explicit ShadowMap(const Device& device);

  // Everything between them is drawn into the map, which is empty before; afterwards shaders can sample it.
  void begin(const vk::raii::CommandBuffer& command) const;
  void end(const vk::raii::CommandBuffer& command) const;

  // Everything between them is drawn into the image of what rests, which is empty before.
  void begin_static(const vk::raii::CommandBuffer& command) const;
  void end_static(const vk::raii::CommandBuffer& command) const;

  // As begin(), with a map whose `dirty` part, which may be empty, is copied from the static one and whose rest is as
  // it was.
  void begin_on_static(const vk::raii::CommandBuffer& command, const vk::Rect2D& dirty) const;

  vk::DescriptorImageInfo descriptor() const;

 private:
  DeviceImage depth_, static_;
  vk::raii::ImageView view_, static_view_;
  vk::raii::Sampler sampler_;
};

}  // namespace afm::render
