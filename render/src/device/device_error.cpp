// SPDX-License-Identifier: Apache-2.0
#include "device/device_error.h"

#include <fmt/format.h>

namespace afm::render {

std::string describe_error(const vk::SystemError& error, const Device& device, const std::string& doing) {
  const auto result = static_cast<vk::Result>(error.code().value());
  if (result == vk::Result::eErrorDeviceLost) {
    return fmt::format(
        "the graphics device {} was lost while {}: its driver restarted or it hung; start again; if the problem "
        "returns, read the kernel log (dmesg)",
        device.name(), doing);
  }
  if (result == vk::Result::eErrorOutOfDeviceMemory || result == vk::Result::eErrorOutOfHostMemory) {
    return fmt::format("out of memory on {} for {}: choose a smaller window or picture, or fewer samples",
                       device.name(), doing);
  }
  return fmt::format("{} failed on {} ({}): run touchafm doctor", doing, device.name(), vk::to_string(result));
}

}  // namespace afm::render
