// SPDX-License-Identifier: Apache-2.0
#include "device/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "core/check.h"
#include "core/interruption.h"
#include "device/device_choice.h"
#include "device/extensions.h"
#include "device/presentation.h"
#include "device/shader_interface.h"

namespace afm::render {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

// Callback with the C interface's types, or, since 1.4.304 (Debian 13), with Vulkan-Hpp's own.
using MessageCallback = decltype(vk::DebugUtilsMessengerCreateInfoEXT::pfnUserCallback);
template <class>
struct OnMessage;
template <class Severity, class Types, class Data>
struct OnMessage<VkBool32 (*)(Severity, Types, const Data*, void*)> {
  static VKAPI_ATTR VkBool32 VKAPI_CALL call(Severity, Types, const Data* data, void* sink) {
    static_cast<MessageSink*>(sink)->add(data->pMessage);
    return VK_FALSE;
  }
};

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(MessageSink& sink) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  return {.messageSeverity = Severity::eWarning | Severity::eError,
          .messageType = Type::eValidation | Type::ePerformance,
          .pfnUserCallback = OnMessage<MessageCallback>::call,
          .pUserData = &sink};
}

// Throws std::system_error if the threads of a CPU driver, one per processor and one for the queue, cannot be started.
// lavapipe ignores threads that fail to start, and then never finishes.
void check_threads() {
  std::atomic<bool> done{false};
  std::vector<std::jthread> threads;
  const auto release = [&] {
    done = true;
    done.notify_all();
  };
  try {
    for (unsigned int i = 0; i < std::thread::hardware_concurrency() + 1; ++i) {
      threads.emplace_back([&done] { done.wait(false); });
    }
  } catch (...) {
    release();
    throw;
  }
  release();
}

bool has_validation_layer(const vk::raii::Context& loader) {
  const auto layers = loader.enumerateInstanceLayerProperties();
  return std::any_of(layers.begin(), layers.end(), [](const vk::LayerProperties& layer) {
    return std::string_view(layer.layerName) == kValidationLayer;
  });
}

}  // namespace

core::Result<std::unique_ptr<vk::raii::Context>> open_loader() {
  try {
    return std::make_unique<vk::raii::Context>();
  } catch (const std::runtime_error&) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "cannot open the Vulkan loader libvulkan.so.1: install libvulkan1 and a driver "
                         "(Debian: mesa-vulkan-drivers, which also draws without a GPU)");
  }
}

void MessageSink::add(std::string message) {
  const std::scoped_lock lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> MessageSink::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(messages_, {});
}

core::Result<vk::raii::Instance> create_instance(const vk::raii::Context& loader, Validation validation,
                                                 Presentation presentation, MessageSink& sink, DeviceSource* source) {
  const bool validate = validation == Validation::On;
  if (validate && !has_validation_layer(loader)) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         "cannot find the Vulkan validation layer: install vulkan-validationlayers");
  }
  const vk::ApplicationInfo application{.pApplicationName = "touchafm", .apiVersion = VK_API_VERSION_1_3};
  const std::array layers{kValidationLayer};
  std::vector<const char*> extensions;
  if (presentation == Presentation::Window) {
    extensions = surface_extensions();
    if (has_extension(loader.enumerateInstanceExtensionProperties(), kAsksSurfaces))
      extensions.push_back(kAsksSurfaces);
  }
  if (validate) {
    extensions.insert(extensions.end(), {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME});
  }
  const std::array enabled{vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  const auto messages = messenger_info(sink);
  const vk::ValidationFeaturesEXT features{.pNext = &messages,
                                           .enabledValidationFeatureCount = static_cast<std::uint32_t>(enabled.size()),
                                           .pEnabledValidationFeatures = enabled.data()};
  const vk::InstanceCreateInfo info{
      .pNext = validate ? &features : nullptr,
      .pApplicationInfo = &application,
      .enabledLayerCount = validate ? static_cast<std::uint32_t>(layers.size()) : 0U,
      .ppEnabledLayerNames = layers.data(),
      .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
      .ppEnabledExtensionNames = extensions.data(),
  };
  try {
    return source != nullptr ? source->create_instance(loader, info) : vk::raii::Instance(loader, info);
  } catch (const vk::SystemError& error) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         std::string("cannot start Vulkan (") + error.what() + "): " + kInstallDriver);
  }
}

DeviceDescription describe(const vk::raii::PhysicalDevice& physical, std::string name) {
  const auto properties = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const auto& core_properties = properties.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = properties.get<vk::PhysicalDeviceDriverProperties>();
  DeviceDescription description;
  description.name = std::move(name);
  description.kind = kind_of(core_properties.deviceType);
  description.driver =
      std::string(std::string_view(driver.driverName)) + " " + std::string(std::string_view(driver.driverInfo));
  description.reason = missing_ability(physical);
  description.usable = description.reason.empty();
  return description;
}

void Device::create_device(Presentation presentation, DeviceSource* source) {
  std::vector<const char*> extensions;
  if (presentation == Presentation::Window) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  present_barrier_ = presentation == Presentation::Window && has_present_barrier(*loader_, physical_);
  if (present_barrier_) extensions.push_back(VK_NV_PRESENT_BARRIER_EXTENSION_NAME);
  const float priority = 1.0F;
  const vk::DeviceQueueCreateInfo queue_info{
      .queueFamilyIndex = queue_family_, .queueCount = 1, .pQueuePriorities = &priority};
  vk::PhysicalDevicePresentBarrierFeaturesNV barrier{.presentBarrier = VK_TRUE};
  // maintenance4: SPIR-V 1.6 declares a compute shader's size in the form that needs this feature
  vk::PhysicalDeviceVulkan13Features features13{.pNext = present_barrier_ ? &barrier : nullptr,
                                                .synchronization2 = VK_TRUE,
                                                .dynamicRendering = VK_TRUE,
                                                .maintenance4 = VK_TRUE};
  vk::PhysicalDeviceVulkan12Features features12{.pNext = &features13, .timelineSemaphore = VK_TRUE};
  multiview_ = physical_.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features>()
                   .get<vk::PhysicalDeviceVulkan11Features>()
                   .multiview == VK_TRUE;
  const vk::PhysicalDeviceVulkan11Features features11{.pNext = &features12,
                                                      .multiview = multiview_ ? VK_TRUE : VK_FALSE};
  const vk::PhysicalDeviceFeatures features{.largePoints = physical_.getFeatures().largePoints};
  if (features.largePoints == VK_TRUE) {
    largest_point_px_ = std::min<float>(AFM_LARGEST_POINT, physical_.getProperties().limits.pointSizeRange[1]);
  }
  const vk::DeviceCreateInfo info{.pNext = &features11,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue_info,
                                  .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                  .ppEnabledExtensionNames = extensions.data(),
                                  .pEnabledFeatures = &features};
  device_ = source != nullptr ? source->create_device(physical_, info) : vk::raii::Device(physical_, info);
  queue_ = device_.getQueue(queue_family_, 0);
  const auto properties = physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  clips_first_view_only_ = properties.get<vk::PhysicalDeviceDriverProperties>().driverID == vk::DriverId::eMesaLlvmpipe;
  pool_ = vk::raii::CommandPool(
      device_, {.flags = vk::CommandPoolCreateFlagBits::eTransient, .queueFamilyIndex = queue_family_});
}

core::Result<std::unique_ptr<Device>> Device::open(Validation validation, Presentation presentation,
                                                   const std::string& gpu, DeviceSource* source) {
  auto loader = open_loader();
  if (!loader) {
    return tl::unexpected(loader.error());
  }
  std::unique_ptr<Device> device(new Device());
  device->loader_ = std::move(*loader);
  auto instance = create_instance(*device->loader_, validation, presentation, *device->messages_, source);
  if (!instance) {
    return tl::unexpected(instance.error());
  }
  device->instance_ = std::move(*instance);
  device->naming_ = validation == Validation::On;
  if (validation == Validation::On) {
    device->messenger_ = vk::raii::DebugUtilsMessengerEXT(device->instance_, messenger_info(*device->messages_));
  }
  auto chosen = choose_device(device->instance_, presentation, gpu, source);
  if (!chosen) {
    return tl::unexpected(chosen.error());
  }
  device->physical_ = std::move(chosen->physical);
  device->name_ = std::move(chosen->name);
  device->queue_family_ = chosen->queue_family;
  if (device->physical_.getProperties().deviceType == vk::PhysicalDeviceType::eCpu) check_threads();
  try {
    device->create_device(presentation, source);
  } catch (const vk::SystemError& error) {
    return core::failure(core::ErrorCategory::DeviceMissing, "cannot open the Vulkan device " + device->name_ + " (" +
                                                                 error.what() + "): " + kInstallDriver);
  }
  return device;
}

std::uint64_t Device::largest_heap_bytes() const {
  const auto properties = physical_.getMemoryProperties();
  vk::DeviceSize largest = 0;
  for (std::uint32_t i = 0; i < properties.memoryHeapCount; ++i) {
    largest = std::max(largest, properties.memoryHeaps[i].size);
  }
  return largest;
}

void Device::wait_idle() const noexcept {
  try {
    finish_all();
  } catch (const vk::SystemError&) {
    // a lost device or lack of memory is said by the next call that needs the device
  }
}

void Device::finish_all() const {
  const vk::raii::Fence fence(device_, vk::FenceCreateInfo{});
  queue_.submit2({}, *fence);
  wait_for(fence);
}

void Device::run_once(const std::function<void(const vk::raii::CommandBuffer&)>& record) const {
  const vk::raii::CommandBuffers commands(
      device_, {.commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1});
  const auto& command = commands.front();
  command.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  record(command);
  command.end();
  const vk::raii::Fence fence(device_, vk::FenceCreateInfo{});
  const vk::CommandBufferSubmitInfo submit{.commandBuffer = *command};
  queue_.submit2(vk::SubmitInfo2{.commandBufferInfoCount = 1, .pCommandBufferInfos = &submit}, *fence);
  wait_for(fence);
}

namespace {

// `wait` takes a timeout.
template <class Wait>
void wait_in_turns(const Device& device, Wait&& wait, const std::function<void()>& meanwhile) {
  const std::uint64_t turn_ns = meanwhile ? Device::kTurnNs : Device::kIdleTurnNs;
  for (std::uint64_t turn = 0; turn <= Device::kLongestWorkNs / turn_ns; ++turn) {
    if (wait(turn_ns) == vk::Result::eSuccess) return;
    if (meanwhile) meanwhile();
  }
  device.give_up();
}

}  // namespace

void Device::wait_for(const vk::raii::Semaphore& timeline, std::uint64_t value,
                      const std::function<void()>& meanwhile) const {
  const vk::SemaphoreWaitInfo info{.semaphoreCount = 1, .pSemaphores = &*timeline, .pValues = &value};
  wait_in_turns(*this, [&](std::uint64_t limit_ns) { return device_.waitSemaphores(info, limit_ns); }, meanwhile);
}

void Device::wait_for(const vk::raii::Fence& fence, const std::function<void()>& meanwhile) const {
  wait_in_turns(
      *this, [&](std::uint64_t limit_ns) { return device_.waitForFences(*fence, VK_TRUE, limit_ns); }, meanwhile);
}

void Device::give_up() const {
  core::end_at_once(core::ExitCode::RunFailed,
                    fmt::format("error: the graphics device {} did not finish its work within {} s: it hangs, or a "
                                "limit denies it threads or memory (ulimit -u, ulimit -v)",
                                name_, kLongestWorkNs / 1'000'000'000));
}

}  // namespace afm::render
