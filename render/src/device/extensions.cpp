// SPDX-License-Identifier: Apache-2.0
#include "device/extensions.h"

#include <algorithm>

namespace afm::render {

bool has_extension(const std::vector<vk::ExtensionProperties>& extensions, std::string_view name) {
  return std::any_of(extensions.begin(), extensions.end(), [&](const vk::ExtensionProperties& extension) {
    return std::string_view(extension.extensionName) == name;
  });
}

bool has_present_barrier(const vk::raii::Context& loader, const vk::raii::PhysicalDevice& physical) {
  using Features = vk::PhysicalDevicePresentBarrierFeaturesNV;
  return has_extension(loader.enumerateInstanceExtensionProperties(), kAsksSurfaces) &&
         has_extension(physical.enumerateDeviceExtensionProperties(), VK_NV_PRESENT_BARRIER_EXTENSION_NAME) &&
         physical.getFeatures2<vk::PhysicalDeviceFeatures2, Features>().get<Features>().presentBarrier == VK_TRUE;
}

}  // namespace afm::render
