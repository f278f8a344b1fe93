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

// Off in the programs; on in every test, together with synchronisation validation.
enum class Validation { Off, On };

// Use of the pictures: shown in a Window, which must be opened before the context, or only read back.
enum class Presentation { None, Window };

// One Vulkan device as the `devices` command lists it.
struct DeviceDescription {
  std::string name;
  std::string kind;    // "discrete GPU", "CPU", ...
  std::string driver;  // name and version as the driver reports them
  bool usable = false;
  std::string reason;  // why not, empty if usable
};

// The Vulkan instance, the chosen device and its queue. Prefers a discrete GPU, then an integrated or virtual one, and
// takes a CPU device (lavapipe) when there is nothing else. Must outlive every Renderer made from it; one thread at a
// time.
class Context {
 public:
  // DeviceMissing: no loader, no driver, no device that can do what the renderer needs, or, with Validation::On, no
  // validation layer. The message says what to install.
  // `runtime`: of the headset that the device shows pictures in; it then chooses the device, and must be there for as
  // long as this call takes.
  static core::Result<Context> open(Validation validation = Validation::Off,
                                    Presentation presentation = Presentation::None, HeadsetRuntime* runtime = nullptr);

  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  const std::string& device_name() const;

  // True if the device has multiview: both eyes in one pass.
  bool draws_both_eyes_at_once() const;

  // Pixels of the longest picture, each way.
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
