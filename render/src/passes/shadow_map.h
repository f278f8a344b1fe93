// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/memory.h"

namespace afm::render {

// Depth image seen by the key light, and an image of the static casters, from which parts of it are restored.
class ShadowMap {
 public:
  explicit ShadowMap(const Device& device);

  // Clears the map; draws between begin() and end() go into it. Fragment shaders can sample it afterwards.
  void begin(const vk::raii::CommandBuffer& command) const;
  void end(const vk::raii::CommandBuffer& command) const;

  // Clears the image of the static casters; the following draws go into it.
  void begin_static(const vk::raii::CommandBuffer& command) const;
  void end_static(const vk::raii::CommandBuffer& command) const;

  // Like begin(), but copies the `dirty` part, which may be empty, from the static image and keeps the rest.
  void begin_on_static(const vk::raii::CommandBuffer& command, const vk::Rect2D& dirty) const;

  vk::ImageView view() const { return *view_; }

 private:
  DeviceImage depth_, static_;
  vk::raii::ImageView view_, static_view_;
};

}  // namespace afm::render
