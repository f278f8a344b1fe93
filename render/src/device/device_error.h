// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "device/device.h"
#include "render/device_failure.h"

namespace afm::render {

// One-line message for a Vulkan failure. `doing` is an activity: "drawing a frame".
std::string describe_error(const vk::SystemError& error, const Device& device, const std::string& doing);

// Runs `work` and turns a Vulkan failure into a DeviceFailure.
template <class Work>
auto rethrow_as_device_failure(const Device& device, const char* doing, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const vk::SystemError& error) {
    throw DeviceFailure(describe_error(error, device, doing));
  }
}

}  // namespace afm::render
