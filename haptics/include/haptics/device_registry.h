// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "haptics/device.h"
#include "haptics/release_path.h"

// The haptic devices that TouchAFM can use, what each is called, and how a person gets one.
namespace afm::haptics {

// The value of an environment variable, empty if it is not set. A lab names libraries and ports by them.
using Environment = std::function<std::string(const char* variable)>;
inline constexpr const char* kHdLibraryVariable = "TOUCHAFM_HD_LIBRARY";  // path or name of the vendor's library
inline constexpr const char* kHdDeviceVariable = "TOUCHAFM_HD_DEVICE";    // the device's name in the vendor's set-up

// One thing that was looked for and what came of it: lower case, no full stop.
struct ProbeLine {
  std::string subject;
  bool usable = false;
  std::string said;
};

// Record of the search for one kind of device.
class ProbeLog {
 public:
  explicit ProbeLog(std::string_view subject) : subject_(subject) {}

  // The device itself.
  void found(std::string said) { tried(subject_, true, std::move(said)); }
  void missing(std::string said) { tried(subject_, false, std::move(said)); }

  // Requirement of the device.
  void tried(std::string subject, bool usable, std::string said) {
    lines_.push_back({std::move(subject), usable, std::move(said)});
  }

  const std::vector<ProbeLine>& lines() const { return lines_; }

 private:
  std::string subject_;
  std::vector<ProbeLine> lines_;
};

// A device that nobody has named may be one that a person does not mean to use.
enum class DeviceChoice { ByName, Automatic };

struct DeviceRequest {
  const Environment& environment;
  const core::Clock& clock;  // outlives the device
  DeviceChoice choice = DeviceChoice::ByName;
  OfferReleasePath offer{};  // may be empty; for a device that another process can be let into
};

// A kind of device: one row of the registry (docs/adding-a-device.md).
struct DeviceKind {
  std::string_view word;     // after --haptics
  std::string_view subject;  // of its ProbeLine; begins with the word
  std::string_view meaning;  // in the help: "an Inverse3 through its maker's service"
  bool renders_force;        // in the hand itself
  std::string_view remedy;   // where its driver is installed but it does not answer; empty if a probe cannot tell

  // Both tell what they tried, the device itself last.
  core::Result<std::unique_ptr<HapticDevice>> (*open)(const DeviceRequest& request, ProbeLog& log);
  void (*probe)(const Environment& environment, ProbeLog& log);  // starts nothing
};

// The best first; the last one, the simulated hand, is always there.
std::span<const DeviceKind> device_kinds();

// The last one.
const DeviceKind& simulated_kind();

// Null if there is none of that word.
const DeviceKind* find_device_kind(std::string_view word);

struct OpenedDevice {
  std::unique_ptr<HapticDevice> device;
  std::vector<ProbeLine> lines;  // what was tried, in order; the last one was taken
};

// Longer than any driver takes that works. One that takes longer to open a device, or to look for one, hangs in its
// maker's library: the process ends with DeviceMissing and a line that names the kind.
inline constexpr std::chrono::milliseconds kOpeningPatience{10'000};

// DeviceMissing: it is not there; the message has all that was tried. `clock` outlives the device. Takes up to some
// seconds.
core::Result<OpenedDevice> open_device(const DeviceKind& kind, const Environment& environment, const core::Clock& clock,
                                       const OfferReleasePath& offer = {},
                                       std::chrono::milliseconds patience = kOpeningPatience);

// The first one that opens.
OpenedDevice open_best_device(const Environment& environment, const core::Clock& clock,
                              const OfferReleasePath& offer = {});

// Looks for every kind of device without starting any.
std::vector<ProbeLine> probe_devices(const Environment& environment,
                                     std::chrono::milliseconds patience = kOpeningPatience);

}  // namespace afm::haptics
