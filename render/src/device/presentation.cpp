// SPDX-License-Identifier: Apache-2.0
#include "device/presentation.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace afm::render {

std::vector<const char*> surface_extensions() {
  std::uint32_t count = 0;
  const char* const* names = glfwGetRequiredInstanceExtensions(&count);
  return {names, names + count};
}

bool can_present(const vk::raii::Instance& instance, const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
  return glfwGetPhysicalDevicePresentationSupport(*instance, *physical, family) == GLFW_TRUE;
}

}  // namespace afm::render
