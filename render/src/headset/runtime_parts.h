// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "device/device_source.h"
#include "headset/openxr_calls.h"
#include "render/headset.h"

namespace afm::render {

struct HeadsetRuntimeParts : DeviceSource {
  explicit HeadsetRuntimeParts(std::string the_manifest) : manifest(std::move(the_manifest)) {}

  // Connects, or reconnects after close(). DeviceMissing as in HeadsetRuntime::connect().
  core::Result<void> open();
  void close() { calls.close(); }

  // Call after reconnecting: fails unless the runtime still chooses the device that everything is drawn with.
  core::Result<void> check_device(const Device& device) const;

  bool has(const char* extension) const;

  vk::raii::Instance create_instance(const vk::raii::Context& loader, const vk::InstanceCreateInfo& info) override;
  vk::raii::PhysicalDevice choose_device(const vk::raii::Instance& instance) override;
  vk::raii::Device create_device(const vk::raii::PhysicalDevice& physical, const vk::DeviceCreateInfo& info) override;

  std::string manifest;  // path of the runtime's manifest file, for messages
  OpenXrInstance calls;
  XrSystemId system = XR_NULL_SYSTEM_ID;
  std::vector<const char*> extensions;  // supported optional extensions
  std::string runtime_name, headset_name;
  glm::uvec2 eye_px{0};
  std::uint32_t most_layers = 0;  // limit on layers per frame
  PFN_vkGetInstanceProcAddr vulkan = nullptr;

 private:
  core::Result<void> find_headset();
  VkPhysicalDevice wanted_device(VkInstance instance) const;
};

// Optional extension, and the feature lost without it.
struct HeadsetExtension {
  const char* name;
  const char* without;
};
const std::vector<HeadsetExtension>& headset_extensions();

}  // namespace afm::render
