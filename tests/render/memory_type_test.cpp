// SPDX-License-Identifier: Apache-2.0
#include "device/memory_type.h"

#include <gtest/gtest.h>

namespace afm::render {
namespace memory_type_test {

using Flag = vk::MemoryPropertyFlagBits;

constexpr vk::MemoryPropertyFlags kHost = Flag::eHostVisible | Flag::eHostCoherent;
constexpr std::uint32_t kAll = 0xffff'ffff;

// The types of a discrete GPU, in the order of NVIDIA's driver.
vk::PhysicalDeviceMemoryProperties discrete_gpu() {
  vk::PhysicalDeviceMemoryProperties memory;
  for (const vk::MemoryPropertyFlags flags : {vk::MemoryPropertyFlags(), vk::MemoryPropertyFlags(Flag::eDeviceLocal),
                                              kHost, kHost | Flag::eHostCached, kHost | Flag::eDeviceLocal}) {
    memory.memoryTypes[memory.memoryTypeCount++].propertyFlags = flags;
  }
  return memory;
}

TEST(MemoryType, IsTheFirstThatHasWhatIsNeeded) {
  EXPECT_EQ(memory_type(discrete_gpu(), kAll, Flag::eDeviceLocal), 1U);
  EXPECT_EQ(memory_type(discrete_gpu(), kAll, kHost), 2U);
}

TEST(MemoryType, IsOneThatIsUsefulTooWhereThereIsOne) {
  EXPECT_EQ(memory_type(discrete_gpu(), kAll, kHost, Flag::eHostCached), 3U);
  EXPECT_EQ(memory_type(discrete_gpu(), kAll, kHost, Flag::eLazilyAllocated), 2U);
}

TEST(MemoryType, IsAmongThoseThatTheResourceTakes) {
  EXPECT_EQ(memory_type(discrete_gpu(), 0b10100, kHost), 2U);
  EXPECT_EQ(memory_type(discrete_gpu(), 0b10000, kHost, Flag::eHostCached), 4U);
}

}  // namespace memory_type_test
}  // namespace afm::render
