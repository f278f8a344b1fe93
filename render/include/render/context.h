// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::render {

class Device;
class HeadsetRuntime;

// Vulkan validation layer, with synchronisation validation. Off in the programs, on in every test.
enum class Validation { Off, On };

// Destination of the pictures: a Window, which must be opened before the context, or readback only.
enum class Presentation { None, Window };

// One Vulkan device as the `devices` command lists it.
struct DeviceDescription {
  std::string name;    // name from the driver; the second of two equal ones gets " #2"
  std::string kind;    // "discrete GPU", "CPU", ...
  std::string driver;  // name and version reported by the driver
  bool usable = false;
  std::string reason;  // reason why it is not usable; empty if it is
};

struct ContextOptions {
  Validation validation = Validation::Off;
  Presentation presentation = Presentation::None;
  std::string gpu{};                  // name of the device, or a part of it that is unique; empty: the best device
  HeadsetRuntime* runtime = nullptr;  // headset that shows the pictures; its runtime chooses the device, `gpu` is empty
};

// The Vulkan instance, the chosen device and its queue. Prefers a discrete GPU, then an integrated or virtual one, and
// uses a CPU device (lavapipe) only as a last resort. Must outlive every Renderer created from it; one thread at a
// time.
class Context {
 public:
  // DeviceMissing: no loader, no driver, no device with the features the renderer needs, or, with Validation::On, no
  // validation layer. The message says what to install. WrongUsage: several devices could be meant by `gpu`. A
  // headset's runtime must outlive this call.
  static core::Result<Context> open(const ContextOptions& options);
  static core::Result<Context> open() { return open(ContextOptions{}); }

  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  const std::string& device_name() const;

  // True if there is no GPU, so that the processor draws (lavapipe).
  bool draws_on_processor() const;

  // True if the device has multiview, which draws both eyes in one pass.
  bool draws_both_eyes_at_once() const;

  // Largest width and height of a picture, in pixels.
  std::uint32_t largest_picture_px() const;

  // Messages of the validation layer since the last call. Always empty with Validation::Off.
  std::vector<std::string> take_validation_messages();

  Device& device() { return *device_; }

 private:
  explicit Context(std::unique_ptr<Device> device);
  std::unique_ptr<Device> device_;
};

// Every Vulkan device of this machine. DeviceMissing as in Context::open() if there is no loader or no driver.
core::Result<std::vector<DeviceDescription>> list_devices();

}  // namespace afm::render
