// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "device/vulkan.h"

namespace afm::render {

bool has_extension(const std::vector<vk::ExtensionProperties>& extensions, std::string_view name);

// Instance extension needed to query a surface for VK_NV_present_barrier.
inline constexpr const char* kAsksSurfaces = VK_KHR_GET_SURFACE_CAPABILITIES_2_EXTENSION_NAME;
bool has_present_barrier(const vk::raii::Context& loader, const vk::raii::PhysicalDevice& physical);

}  // namespace afm::render
