// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "device/device_source.h"
#include "device/vulkan.h"
#include "render/context.h"

namespace afm::render {

// Remedy if no driver or no device can be used.
inline constexpr const char* kInstallDriver =
    "install a Vulkan driver (Debian: mesa-vulkan-drivers, which also draws without a GPU)";

struct ChosenDevice {
  vk::raii::PhysicalDevice physical{nullptr};
  std::string name;  // name as in list_devices()
  std::uint32_t queue_family = 0;
};

// DeviceMissing says what to install.
core::Result<std::vector<vk::raii::PhysicalDevice>> physical_devices(const vk::raii::Instance& instance);

// Distinct name of each device, in the same order.
std::vector<std::string> device_names(const std::vector<vk::raii::PhysicalDevice>& devices);

// Reason why the renderer cannot use this device; empty if it can.
std::string missing_ability(const vk::raii::PhysicalDevice& physical);

// Kind of device in words: "discrete GPU", "CPU".
std::string kind_of(vk::PhysicalDeviceType type);

// Device named by `gpu`, as in find_device(); if empty, the best one: a discrete GPU before an integrated or
// virtual one, and a CPU device last. `source`, which may be null, has one device, and `gpu` is then empty.
// DeviceMissing: none serves; WrongUsage: `gpu` is ambiguous.
core::Result<ChosenDevice> choose_device(const vk::raii::Instance& instance, Presentation presentation,
                                         const std::string& gpu, DeviceSource* source);

}  // namespace afm::render
