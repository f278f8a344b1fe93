// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "device/vulkan.h"

namespace afm::render {

// Instance extensions that GLFW needs for surfaces. Empty before a window has been opened.
std::vector<const char*> surface_extensions();

// True if this queue can present to this machine's windows.
bool can_present(const vk::raii::Instance& instance, const vk::raii::PhysicalDevice& physical, std::uint32_t family);

}  // namespace afm::render
