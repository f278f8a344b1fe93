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
#include "haptics/hand_controls.h"
#include "haptics/haptic_ports.h"
#include "haptics/release_path.h"

// Haptic devices that TouchAFM supports, their names, and how to set them up.
namespace afm::haptics {

// Value of an environment variable, empty if it is not set. The variables name libraries and ports.
using Environment = std::function<std::string(const char* variable)>;
inline constexpr const char* kHdLibraryVariable = "TOUCHAFM_HD_LIBRARY";  // path or name of the vendor's library
inline constexpr const char* kHdDeviceVariable = "TOUCHAFM_HD_DEVICE";    // name of the device in the vendor's set-up
inline constexpr const char* kFdLibraryVariable = "TOUCHAFM_FD_LIBRARY";  // path or name of Force Dimension's library
inline constexpr const char* kFdDeviceVariable = "TOUCHAFM_FD_DEVICE";    // serial number, or "#0" for the first device

// Item of a search and its result: lower case, no full stop.
struct ProbeLine {
  std::string subject;
  bool usable = false;
  std::string said;
};

// Record of the search for one kind of device.
class ProbeLog {
 public:
  explicit ProbeLog(std::string_view subject) : subject_(subject) {}

  // Records that the device itself was found.
  void found(std::string said) { tried(subject_, true, std::move(said)); }
  void missing(std::string said) { tried(subject_, false, std::move(said)); }

  // Records the result for a requirement of the device.
  void tried(std::string subject, bool usable, std::string said) {
    lines_.push_back({std::move(subject), usable, std::move(said)});
  }

  const std::vector<ProbeLine>& lines() const { return lines_; }

 private:
  std::string subject_;
  std::vector<ProbeLine> lines_;
};

// Automatic selection must not take a device that the user may not want to use.
enum class DeviceChoice { ByName, Automatic };

struct DeviceRequest {
  const Environment& environment;
  const core::Clock& clock;  // clock of the device's read(); must outlive the device
  DeviceChoice choice = DeviceChoice::ByName;
  OfferReleasePath offer{};  // callback for a device that another process can write to; may be empty
};

// Kind of device: one row of the registry (docs/adding-a-device.md).
struct DeviceKind {
  std::string_view word;     // value of --haptics
  std::string_view subject;  // subject of its ProbeLine; begins with the word
  std::string_view meaning;  // description in the help: "an Inverse3 through its maker's service"
  bool renders_force;        // true: the hand itself feels the force
  bool vibrates;             // true: the devices have a DeviceSpec::max_vibration_n, unless their model is unknown
  HandControls controls;     // names of the controls on the wall
  std::string_view remedy;   // advice for a silent device with an installed driver; empty: a probe cannot detect that
  std::string_view proof;    // substitute for hardware in the tests of the driver; empty: none
  std::string_view models;   // lower-case words of makers and models that a fault report keeps in a device's name
  std::span<const KnownPort> ports;  // ports of these devices; empty: their service or library finds them

  // Both functions log what they tried, the device itself last.
  core::Result<std::unique_ptr<HapticDevice>> (*open)(const DeviceRequest& request, ProbeLog& log);
  void (*probe)(const Environment& environment, ProbeLog& log);  // search that starts nothing
};

// Kinds in order of preference; the last one, the simulated hand, is always available.
std::span<const DeviceKind> device_kinds();

// The last kind of device_kinds(), the simulated hand.
const DeviceKind& simulated_kind();

// Kind with that word, null if there is none.
const DeviceKind* find_device_kind(std::string_view word);

struct OpenedDevice {
  std::unique_ptr<HapticDevice> device;
  std::vector<ProbeLine> lines;  // attempts in order; the last one succeeded
};

// Longer than any working driver takes. A driver that takes longer to open or probe a device hangs in the vendor's
// library: the process then ends with DeviceMissing and a line that names the kind.
inline constexpr std::chrono::milliseconds kOpeningPatience{10'000};

// DeviceMissing: it is not connected; the message lists all attempts. `clock` must outlive the device. Takes up to some
// seconds.
core::Result<OpenedDevice> open_device(const DeviceKind& kind, const Environment& environment, const core::Clock& clock,
                                       const OfferReleasePath& offer = {},
                                       std::chrono::milliseconds patience = kOpeningPatience);

// Opens the first device that works.
OpenedDevice open_best_device(const Environment& environment, const core::Clock& clock,
                              const OfferReleasePath& offer = {});

// Probes every kind of device without starting any. A device that was found has the `proof` of its kind.
std::vector<ProbeLine> probe_devices(const Environment& environment,
                                     std::chrono::milliseconds patience = kOpeningPatience);

}  // namespace afm::haptics
