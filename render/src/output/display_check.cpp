// SPDX-License-Identifier: Apache-2.0
#include "device/device.h"
#include "device/device_error.h"
#include "output/swapchain.h"
#include "output/window_handle.h"
#include "render/context.h"

namespace afm::render {

core::Result<void> check_display() {
  try {
    auto window = WindowHandle::open({.title = "TouchAFM", .width = 64, .height = 64, .hidden = true});
    if (!window) return tl::unexpected(window.error());
    auto device = Device::open(Validation::Off, Presentation::Window, {}, nullptr);
    if (!device) return tl::unexpected(device.error());
    const vk::raii::SurfaceKHR surface = (*window)->create_surface((*device)->instance());
    const auto format = choose_surface_format(**device, *surface);
    if (!format) return tl::unexpected(format.error());
    return {};
  } catch (const vk::SystemError& error) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         std::string("the display takes no Vulkan pictures (") + error.what() + ")");
  }
}

}  // namespace afm::render
