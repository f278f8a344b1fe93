// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/printable.h"
#include "device/device.h"
#include "headset/runtime_parts.h"

namespace afm::render {
namespace {

constexpr const char* kInstallRuntime =
    "install libopenxr-loader1 (Debian) and the runtime of your headset, such as SteamVR, WiVRn or Monado, and start "
    "it";
constexpr std::uint32_t kLargestEyePx = 8192;

// Throws like vk::raii does for its own calls.
void check_vulkan(VkResult result, const char* call) {
  if (result != VK_SUCCESS) throw vk::SystemError(vk::make_error_code(static_cast<vk::Result>(result)), call);
}

// Throws if the runtime itself refused a call.
void check_made(XrResult result, const char* call) {
  if (XR_FAILED(result)) {
    throw vk::SystemError(vk::make_error_code(vk::Result::eErrorInitializationFailed),
                          fmt::format("{}: {}", call, name_of(result)));
  }
}

// Text from a runtime, which may contain anything.
template <std::size_t kSize>
std::string words_of(const char (&said)[kSize]) {
  return core::printable({said, ::strnlen(said, kSize)});
}

}  // namespace

const std::vector<HeadsetExtension>& headset_extensions() {
  static const std::vector<HeadsetExtension> rows{
      {XR_EXT_LOCAL_FLOOR_EXTENSION_NAME, "the floor is that of the play area"},
      {XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME, "a late picture is moved as if all of it were equally far away"},
      {XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME, "the refresh rate is known only while frames are shown"}};
  return rows;
}

bool HeadsetRuntimeParts::has(const char* extension) const {
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const char* name) { return std::string_view(name) == extension; });
}

core::Result<void> HeadsetRuntimeParts::open() {
  extensions.clear();
  for (const HeadsetExtension& row : headset_extensions()) extensions.push_back(row.name);
  auto opened = calls.open({XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME}, extensions);
  if (opened) opened = find_headset();
  if (opened) return opened;
  calls.close();
  return core::failure(opened.error().category, fmt::format("no headset: {}; {}; {}", opened.error().message,
                                                            manifest.empty() ? "no manifest of a runtime is installed"
                                                                             : "tried the runtime of " + manifest,
                                                            kInstallRuntime));
}

core::Result<void> HeadsetRuntimeParts::find_headset() {
  try {
    auto properties = openxr_struct<XrInstanceProperties>(XR_TYPE_INSTANCE_PROPERTIES);
    check_openxr(calls.GetInstanceProperties(calls.handle(), &properties), "xrGetInstanceProperties");
    const XrVersion version = properties.runtimeVersion;
    runtime_name = fmt::format("{} {}.{}.{}", words_of(properties.runtimeName), XR_VERSION_MAJOR(version),
                               XR_VERSION_MINOR(version), XR_VERSION_PATCH(version));
    const XrSystemGetInfo get{
        .type = XR_TYPE_SYSTEM_GET_INFO, .next = nullptr, .formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    check_openxr(calls.GetSystem(calls.handle(), &get, &system), "xrGetSystem");
    auto found = openxr_struct<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
    check_openxr(calls.GetSystemProperties(calls.handle(), system, &found), "xrGetSystemProperties");
    headset_name = words_of(found.systemName);
    most_layers = found.graphicsProperties.maxLayerCount;
    auto required = openxr_struct<XrGraphicsRequirementsVulkan2KHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_VULKAN2_KHR);
    check_openxr(calls.GetVulkanGraphicsRequirements2KHR(calls.handle(), system, &required),
                 "xrGetVulkanGraphicsRequirements2KHR");
    if (required.minApiVersionSupported > XR_MAKE_VERSION(1, 3, 0)) {
      return core::failure(core::ErrorCategory::DeviceMissing, "the OpenXR runtime wants a newer Vulkan than 1.3");
    }
    const auto views = openxr_list<XrViewConfigurationView>(
        "xrEnumerateViewConfigurationViews", openxr_struct<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW),
        [&](auto... more) {
          return calls.EnumerateViewConfigurationViews(calls.handle(), system,
                                                       XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, more...);
        });
    if (views.size() != 2) throw OpenXrFailure(XR_ERROR_RUNTIME_FAILURE, "xrEnumerateViewConfigurationViews");
    eye_px = {std::max(views[0].recommendedImageRectWidth, views[1].recommendedImageRectWidth),
              std::max(views[0].recommendedImageRectHeight, views[1].recommendedImageRectHeight)};
    if (eye_px.x == 0 || eye_px.y == 0 || eye_px.x > kLargestEyePx || eye_px.y > kLargestEyePx) {
      return core::failure(core::ErrorCategory::DeviceMissing,
                           fmt::format("the OpenXR runtime recommends pictures of {} x {} pixels", eye_px.x, eye_px.y));
    }
  } catch (const OpenXrFailure& failure) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("the OpenXR runtime has no headset for us ({})", failure.what()));
  }
  return {};
}

VkPhysicalDevice HeadsetRuntimeParts::wanted_device(VkInstance instance) const {
  const XrVulkanGraphicsDeviceGetInfoKHR info{.type = XR_TYPE_VULKAN_GRAPHICS_DEVICE_GET_INFO_KHR,
                                              .next = nullptr,
                                              .systemId = system,
                                              .vulkanInstance = instance};
  VkPhysicalDevice wanted = VK_NULL_HANDLE;
  check_openxr(calls.GetVulkanGraphicsDevice2KHR(calls.handle(), &info, &wanted), "xrGetVulkanGraphicsDevice2KHR");
  return wanted;
}

core::Result<void> HeadsetRuntimeParts::check_device(const Device& device) const {
  try {
    if (vk::PhysicalDevice(wanted_device(*device.instance())) == *device.physical()) return {};
  } catch (const OpenXrFailure& failure) {
    return core::failure(core::ErrorCategory::DeviceMissing, failure.what());
  }
  return core::failure(core::ErrorCategory::DeviceMissing,
                       "the headset has moved to another graphics device: end the program and start it again");
}

vk::raii::Instance HeadsetRuntimeParts::create_instance(const vk::raii::Context& loader,
                                                        const vk::InstanceCreateInfo& info) {
  vulkan = loader.getDispatcher()->vkGetInstanceProcAddr;
  const XrVulkanInstanceCreateInfoKHR create{.type = XR_TYPE_VULKAN_INSTANCE_CREATE_INFO_KHR,
                                             .next = nullptr,
                                             .systemId = system,
                                             .createFlags = 0,
                                             .pfnGetInstanceProcAddr = vulkan,
                                             .vulkanCreateInfo = &static_cast<const VkInstanceCreateInfo&>(info),
                                             .vulkanAllocator = nullptr};
  VkInstance made = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;
  check_made(calls.CreateVulkanInstanceKHR(calls.handle(), &create, &made, &result), "xrCreateVulkanInstanceKHR");
  check_vulkan(result, "xrCreateVulkanInstanceKHR");
  return {loader, made};
}

vk::raii::PhysicalDevice HeadsetRuntimeParts::choose_device(const vk::raii::Instance& instance) {
  try {
    return {instance, wanted_device(*instance)};
  } catch (const OpenXrFailure& failure) {
    throw vk::SystemError(vk::make_error_code(vk::Result::eErrorInitializationFailed), failure.what());
  }
}

vk::raii::Device HeadsetRuntimeParts::create_device(const vk::raii::PhysicalDevice& physical,
                                                    const vk::DeviceCreateInfo& info) {
  const XrVulkanDeviceCreateInfoKHR create{.type = XR_TYPE_VULKAN_DEVICE_CREATE_INFO_KHR,
                                           .next = nullptr,
                                           .systemId = system,
                                           .createFlags = 0,
                                           .pfnGetInstanceProcAddr = vulkan,
                                           .vulkanPhysicalDevice = *physical,
                                           .vulkanCreateInfo = &static_cast<const VkDeviceCreateInfo&>(info),
                                           .vulkanAllocator = nullptr};
  VkDevice made = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;
  check_made(calls.CreateVulkanDeviceKHR(calls.handle(), &create, &made, &result), "xrCreateVulkanDeviceKHR");
  check_vulkan(result, "xrCreateVulkanDeviceKHR");
  return {physical, made};
}

core::Result<std::unique_ptr<HeadsetRuntime>> HeadsetRuntime::connect(std::string manifest) {
  auto parts = std::make_unique<HeadsetRuntimeParts>(std::move(manifest));
  if (auto opened = parts->open(); !opened) return tl::unexpected(opened.error());
  return std::unique_ptr<HeadsetRuntime>(new HeadsetRuntime(std::move(parts)));
}

HeadsetRuntime::HeadsetRuntime(std::unique_ptr<HeadsetRuntimeParts> parts) : parts_(std::move(parts)) {}
HeadsetRuntime::~HeadsetRuntime() = default;

const std::string& HeadsetRuntime::runtime_name() const { return parts_->runtime_name; }
const std::string& HeadsetRuntime::headset_name() const { return parts_->headset_name; }
glm::uvec2 HeadsetRuntime::eye_px() const { return parts_->eye_px; }
DeviceSource& HeadsetRuntime::device_source() { return *parts_; }

}  // namespace afm::render
