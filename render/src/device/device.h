// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/result.h"
#include "device/device_source.h"
#include "device/vulkan.h"
#include "render/context.h"

namespace afm::render {

// Collects the messages of the validation layer, which may call from any thread.
class MessageSink {
 public:
  void add(std::string message);
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

// Steps shared by Device::open() and list_devices(); DeviceMissing says what to install.
core::Result<std::unique_ptr<vk::raii::Context>> open_loader();
core::Result<vk::raii::Instance> create_instance(const vk::raii::Context& loader, Validation validation,
                                                 Presentation presentation, MessageSink& sink,
                                                 DeviceSource* source = nullptr);
DeviceDescription describe(const vk::raii::PhysicalDevice& physical, std::string name);

// Implementation of Context: the Vulkan objects shared by all parts of the renderer.
class Device {
 public:
  // `gpu` as in ContextOptions. `source` creates instance and device in place of the Vulkan loader; may be null.
  static core::Result<std::unique_ptr<Device>> open(Validation validation, Presentation presentation,
                                                    const std::string& gpu, DeviceSource* source);

  const vk::raii::Device& operator*() const { return device_; }
  const vk::raii::Device* operator->() const { return &device_; }
  const vk::raii::Instance& instance() const { return instance_; }
  const vk::raii::PhysicalDevice& physical() const { return physical_; }
  const vk::raii::Queue& queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }
  const std::string& name() const { return name_; }
  MessageSink& messages() { return *messages_; }

  // True if both eyes can be drawn in one pass.
  bool multiview() const { return multiview_; }

  // True if surfaces may offer VK_NV_present_barrier, which changes their pictures in step with other machines.
  bool present_barrier() const { return present_barrier_; }

  // True for Mesa 22.3's lavapipe, which draws a clipped triangle into only the first view of a multiview pass.
  bool clips_first_view_only() const { return clips_first_view_only_; }

  // Size in pixels of the largest point that is drawn: 1 on a device without the feature.
  float largest_point_px() const { return largest_point_px_; }

  // Call before destroying resources that the device may still use. Returns at once if the device is lost.
  void wait_idle() const noexcept;
  void finish_all() const;  // same as wait_idle(), but throws vk::SystemError

  std::uint64_t largest_heap_bytes() const;

  // Waits until the device has finished. Throws vk::SystemError; ends the process if it takes longer than
  // kLongestWorkNs, because a hanging device cannot even be closed.
  static constexpr std::uint64_t kLongestWorkNs = 120'000'000'000;  // beyond the 10 s of GPU drivers
  // Interval between calls of `meanwhile`; without one the caller wakes up less often.
  static constexpr std::uint64_t kTurnNs = 5'000'000, kIdleTurnNs = 100'000'000;
  void wait_for(const vk::raii::Fence& fence, const std::function<void()>& meanwhile = {}) const;
  void wait_for(const vk::raii::Semaphore& timeline, std::uint64_t value,
                const std::function<void()>& meanwhile = {}) const;
  [[noreturn]] void give_up() const;

  // Records with `record`, submits and waits; used for uploads at start and for readback.
  void run_once(const std::function<void(const vk::raii::CommandBuffer&)>& record) const;

  // Names an object in validation messages and captures.
  template <class Object>
  void set_name(const Object& object, const std::string& name) const {
    if (!naming_) {
      return;
    }
    const auto handle = reinterpret_cast<std::uint64_t>(static_cast<typename Object::CType>(*object));
    device_.setDebugUtilsObjectNameEXT(
        {.objectType = Object::objectType, .objectHandle = handle, .pObjectName = name.c_str()});
  }

 private:
  Device() = default;
  void create_device(Presentation presentation, DeviceSource* source);

  std::unique_ptr<MessageSink> messages_ = std::make_unique<MessageSink>();
  std::unique_ptr<vk::raii::Context> loader_;
  vk::raii::Instance instance_{nullptr};
  vk::raii::DebugUtilsMessengerEXT messenger_{nullptr};
  vk::raii::PhysicalDevice physical_{nullptr};
  std::string name_;
  std::uint32_t queue_family_ = 0;
  bool naming_ = false;
  bool multiview_ = false;
  bool present_barrier_ = false;
  bool clips_first_view_only_ = false;
  float largest_point_px_ = 1.0F;
  vk::raii::Device device_{nullptr};
  vk::raii::Queue queue_{nullptr};
  vk::raii::CommandPool pool_{nullptr};
};

}  // namespace afm::render
