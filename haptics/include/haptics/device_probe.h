// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/result.h"
#include "haptics/device.h"

// Which haptic device a person gets, and why.
namespace afm::haptics {

enum class DeviceChoice {
  Auto,       // HDAPI if it answers, else Haply's, else a joystick with force feedback, else the simulated hand
  Simulated,  // the simulated hand
  Hdapi,      // a device behind the vendor's library, or an error
  Haply,      // an Inverse3 behind its maker's service, or an error
  Gamepad,    // a joystick with force feedback, else any gamepad that SDL2 knows, or an error
};

// What a lab may set; empty: the usual. app/ takes them from the environment variables of these names.
inline constexpr const char* kHdLibraryVariable = "TOUCHAFM_HD_LIBRARY";
inline constexpr const char* kHdDeviceVariable = "TOUCHAFM_HD_DEVICE";
inline constexpr const char* kHaplyPortVariable = "TOUCHAFM_HAPLY_PORT";
inline constexpr std::uint16_t kHaplyServicePort = 10001;  // of the maker's service on this machine
struct ProbeSettings {
  std::string hd_library;  // path or name of the vendor's library
  std::string hd_device;   // the device's name in the vendor's set-up
  std::uint16_t haply_port = kHaplyServicePort;
};

// One thing that was looked for and what came of it: lower case, no full stop.
inline constexpr const char* kHdapiDevice = "hdapi device";  // subjects
inline constexpr const char* kHaplyDevice = "haply device";
inline constexpr const char* kGamepad = "gamepad";
inline constexpr const char* kSimulatedHand = "simulated hand";
struct ProbeLine {
  std::string subject;
  bool usable = false;
  std::string said;
};

struct OpenedDevice {
  std::unique_ptr<HapticDevice> device;
  std::vector<ProbeLine> lines;  // what was tried, in order; the last one was taken
};

// Opens what was chosen. DeviceMissing: the chosen device is not there; the message has all that was tried. `clock`
// outlives the device. Takes up to some seconds.
core::Result<OpenedDevice> open_device(DeviceChoice choice, const ProbeSettings& settings, const core::Clock& clock);

// Looks for every kind of device without starting any.
std::vector<ProbeLine> probe_devices(const ProbeSettings& settings);

}  // namespace afm::haptics
