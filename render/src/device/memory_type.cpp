// SPDX-License-Identifier: Apache-2.0
#include "device/memory_type.h"

#include "core/check.h"

namespace afm::render {

std::uint32_t memory_type(const vk::PhysicalDeviceMemoryProperties& memory, std::uint32_t type_bits,
                          vk::MemoryPropertyFlags needed, vk::MemoryPropertyFlags useful) {
  for (const vk::MemoryPropertyFlags wanted : {needed | useful, needed}) {
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
      const bool allowed = (type_bits & (1U << type)) != 0;
      if (allowed && (memory.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
    }
  }
  AFM_CHECK(false);
}

}  // namespace afm::render
