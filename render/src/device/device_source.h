// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/vulkan.h"

namespace afm::render {

// Makes instance and device where another library must: a headset's runtime adds what it needs to what the renderer
// asks for, and names the device that the headset is plugged into. Throws vk::SystemError as Vulkan does.
class DeviceSource {
 public:
  virtual ~DeviceSource() = default;
  virtual vk::raii::Instance create_instance(const vk::raii::Context& loader, const vk::InstanceCreateInfo& info) = 0;
  virtual vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance) = 0;
  virtual vk::raii::Device create_device(const vk::raii::PhysicalDevice& physical,
                                         const vk::DeviceCreateInfo& info) = 0;
};

}  // namespace afm::render
