// SPDX-License-Identifier: Apache-2.0
#include "device/device_choice.h"

#include <string_view>
#include <utility>

#include "device/device_names.h"
#include "device/extensions.h"
#include "device/presentation.h"

namespace afm::render {
namespace {

std::optional<std::uint32_t> graphics_family(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if (families[i].queueFlags & vk::QueueFlagBits::eGraphics) {
      return i;
    }
  }
  return std::nullopt;
}

bool shows_windows(const vk::raii::Instance& instance, const vk::raii::PhysicalDevice& physical) {
  return has_extension(physical.enumerateDeviceExtensionProperties(), VK_KHR_SWAPCHAIN_EXTENSION_NAME) &&
         can_present(instance, physical, *graphics_family(physical));
}

int preference(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return 4;
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return 3;
    case vk::PhysicalDeviceType::eVirtualGpu:
      return 2;
    case vk::PhysicalDeviceType::eCpu:
      return 1;
    case vk::PhysicalDeviceType::eOther:
      break;
  }
  return 0;
}

template <class Item>
void keep_only(std::vector<Item>& items, std::size_t place) {
  Item kept = std::move(items[place]);
  items.clear();
  items.push_back(std::move(kept));
}

}  // namespace

std::string missing_ability(const vk::raii::PhysicalDevice& physical) {
  if (physical.getProperties().apiVersion < VK_API_VERSION_1_3) {
    return "its driver is older than Vulkan 1.3";
  }
  if (!graphics_family(physical)) {
    return "it has no graphics queue";
  }
  return {};
}

std::string kind_of(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return "discrete GPU";
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return "integrated GPU";
    case vk::PhysicalDeviceType::eVirtualGpu:
      return "virtual GPU";
    case vk::PhysicalDeviceType::eCpu:
      return "CPU";
    case vk::PhysicalDeviceType::eOther:
      break;
  }
  return "other";
}

// EnumeratePhysicalDevices fails or returns nothing if the loader has no driver.
core::Result<std::vector<vk::raii::PhysicalDevice>> physical_devices(const vk::raii::Instance& instance) {
  try {
    std::vector<vk::raii::PhysicalDevice> found;
    for (auto& physical : vk::raii::PhysicalDevices(instance)) {
      found.push_back(std::move(physical));
    }
    if (!found.empty()) {
      return found;
    }
  } catch (const vk::SystemError&) {
    // said by the failure below
  }
  return core::failure(core::ErrorCategory::DeviceMissing, std::string("found no Vulkan device: ") + kInstallDriver);
}

std::vector<std::string> device_names(const std::vector<vk::raii::PhysicalDevice>& devices) {
  std::vector<std::string> names;
  names.reserve(devices.size());
  for (const auto& device : devices) names.emplace_back(std::string_view(device.getProperties().deviceName));
  return distinct_names(std::move(names));
}

core::Result<ChosenDevice> choose_device(const vk::raii::Instance& instance, Presentation presentation,
                                         const std::string& gpu, DeviceSource* source) {
  auto candidates = physical_devices(instance);
  if (!candidates) return tl::unexpected(candidates.error());
  if (source != nullptr) {
    candidates->clear();
    candidates->push_back(source->choose_device(instance));
  }
  std::vector<std::string> names = device_names(*candidates);
  if (!gpu.empty()) {
    const auto wanted = find_device(names, gpu);
    if (!wanted) return tl::unexpected(wanted.error());
    keep_only(*candidates, *wanted);
    keep_only(names, *wanted);
  }
  ChosenDevice chosen;
  int best = -1;
  bool display_refuses = false;
  std::string reasons;
  for (std::size_t i = 0; i < candidates->size(); ++i) {
    auto& candidate = (*candidates)[i];
    const auto type = candidate.getProperties().deviceType;
    std::string reason = missing_ability(candidate);
    if (reason.empty() && presentation == Presentation::Window && !shows_windows(instance, candidate)) {
      reason = "it cannot present to this display";
      display_refuses = true;
    }
    if (!reason.empty()) {
      reasons += (reasons.empty() ? "" : "; ") + names[i] + ": " + reason;
    } else if (preference(type) > best) {
      best = preference(type);
      chosen = {.physical = std::move(candidate), .name = names[i], .queue_family = 0};
      chosen.queue_family = *graphics_family(chosen.physical);
    }
  }
  if (best < 0 && display_refuses) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "this display shows no Vulkan pictures (" + reasons +
                             "): use a display with a colour depth of 24 or 30 bits, and check that its server runs");
  }
  if (best < 0) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "no Vulkan device can draw this (" + reasons + "): " + kInstallDriver);
  }
  return chosen;
}

}  // namespace afm::render
