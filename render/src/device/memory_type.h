// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "device/vulkan.h"

namespace afm::render {

// Index of the first of a device's memory types among `type_bits` that has all of `needed`; if any of these has
// `useful` too, the first that has. Every Vulkan device has the combinations that are needed here: host-visible and
// coherent, or device-local.
std::uint32_t memory_type(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t type_bits,
                          vk::MemoryPropertyFlags needed, vk::MemoryPropertyFlags useful = {});

}  // namespace afm::render
