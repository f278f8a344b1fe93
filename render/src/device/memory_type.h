// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "device/vulkan.h"

namespace afm::render {

// Index of a memory type among `type_bits` that has all of `needed`: the first one that also has `useful`, or else the
// first. Every Vulkan device has the combinations needed here: host-visible and coherent, or device-local.
std::uint32_t memory_type(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t type_bits,
                          vk::MemoryPropertyFlags needed, vk::MemoryPropertyFlags useful = {});

}  // namespace afm::render
