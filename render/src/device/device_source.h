// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "device/vulkan.h"

namespace afm::render {

// Creates instance and device where another library must do it: a headset's runtime adds its own requirements to the
// renderer's, and chooses the device that the headset is plugged into. Throws vk::SystemError like Vulkan.
class DeviceSource {
 public:
  virtual ~DeviceSource() = default;
  virtual vk::raii::Instance create_instance(const vk::raii::Context& loader, const vk::InstanceCreateInfo& info) = 0;
  virtual vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance) = 0;
  virtual vk::raii::Device create_device(const vk::raii::PhysicalDevice& physical,
                                         const vk::DeviceCreateInfo& info) = 0;
};

}  // namespace afm::render
