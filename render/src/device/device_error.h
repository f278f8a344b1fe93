// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "device/device.h"
#include "render/device_failure.h"

namespace afm::render {

// Message for a Vulkan failure, one line. `doing`: "drawing a frame".
std::string describe_error(const vk::SystemError& error, const Device& device, const std::string& doing);

// Does `work`; a failure of Vulkan leaves as a DeviceFailure.
template <class Work>
auto rethrow_as_device_failure(const Device& device, const char* doing, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const vk::SystemError& error) {
    throw DeviceFailure(describe_error(error, device, doing));
  }
}

}  // namespace afm::render
