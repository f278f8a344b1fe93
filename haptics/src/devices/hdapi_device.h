// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/clock.h"
#include "core/result.h"
#include "devices/hdapi_health.h"
#include "devices/hdapi_library.h"
#include "drivers/driver_faults.h"
#include "drivers/driver_mailbox.h"
#include "drivers/place_filter.h"
#include "haptics/device_registry.h"

namespace afm::haptics {

// PHANTOM Omni, Touch, or another device driven by the vendor's library. At most one per process.
//
// Three threads share it, and none waits for another. The vendor's scheduler calls once a millisecond, passes the
// servo's newest command to the device, and stores the hand's position. The servo reads and writes at its own rate. The
// supervisor watches the scheduler and reports changes.
//
// - The scheduler's side does not trust the servo: it fades an old command to zero (CommandFade).
// - The servo's side does not trust the scheduler: without a callback for kStallNs the device is not healthy, so the
//   governor cuts the force.
// - No step of the force exceeds the device's own limit, except that zero takes effect at once.
// - The force output is on only while the device is Ready; it is off before a calibration.
class HdapiDevice final : public HapticDevice {
 public:
  static constexpr std::int64_t kStallNs = 5'000'000;
  static constexpr std::int64_t kCalibrationCheckNs = 100'000'000;

  // Caller of supervise(): the device's own thread, or a test.
  enum class Supervision { Thread, Caller };

  // Opens the device called `name` or, if that is empty, the first of the default device, "Default Device" and "Default
  // PHANToM" that answers; reads its limits and starts the scheduler. DeviceMissing: none answers; the message has all
  // names tried and the library's messages. Failed: its limits are impossible, or it cannot be started. `clock` must
  // outlive the device, and is the one that provides the time of read().
  static core::Result<std::unique_ptr<HdapiDevice>> open(const HdapiFunctions& functions, const core::Clock& clock,
                                                         const std::string& name,
                                                         Supervision supervision = Supervision::Thread);

  // Reads the properties of a device without starting it.
  static core::Result<DeviceSpec> query(const HdapiFunctions& functions, const std::string& name);

  // Sends zero force, switches the force output off, stops the scheduler, removes the callback, and closes the device.
  ~HdapiDevice() override;

  const DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t now_ns) noexcept override { return mailbox_.read(now_ns); }
  void write(const ForceCommand& command) noexcept override { mailbox_.write(command); }

  // Health of the device at `now_ns`. Any thread.
  HdapiHealth health(std::int64_t now_ns) const noexcept;

  // Switches the force output off if the scheduler has stalled. Returns a log line if the health has changed since the
  // last one; the same line at most every ten seconds. One thread, never the servo's, because the library may be slow
  // or hang.
  std::optional<std::string> supervise();

 private:
  enum class Output { Unknown, Off, On };
  struct Calibration {
    std::uint32_t style = 0;
    HdapiHealth health = HdapiHealth::Starting;
    std::int64_t checked_ns = 0;
  };
  HdapiDevice(const HdapiFunctions& functions, const core::Clock& clock, HdapiHandle handle, DeviceSpec spec);

  core::Result<void> start(Supervision supervision);

  // scheduler's thread
  static std::uint32_t call(void* self) noexcept;
  void run_frame() noexcept;
  void read_hand(std::int64_t now_ns) noexcept;
  void follow_calibration(std::int64_t now_ns) noexcept;
  void switch_output(bool on) noexcept;
  void send_force(std::int64_t now_ns, std::int64_t elapsed_ns) noexcept;
  void take_errors(std::int64_t now_ns) noexcept;
  void raise(HdapiHealth fault, std::uint32_t error_code, std::int64_t now_ns) noexcept;
  HdapiHealth own_health(std::int64_t now_ns) const noexcept;

  HdapiFunctions hd_;
  const core::Clock& clock_;
  HdapiHandle handle_;
  DeviceSpec spec_;
  std::optional<HdapiSchedulerHandle> callback_;
  bool scheduler_started_ = false;
  bool measures_heat_ = false;

  // shared by the threads
  DriverMailbox mailbox_{kStallNs};
  std::atomic<bool> called_{false};
  std::atomic<std::int64_t> last_frame_ns_{0};
  std::atomic<HdapiHealth> health_{HdapiHealth::Starting};
  std::atomic<std::uint32_t> error_code_{0};  // cause of the health; 0: not an error of the library
  std::atomic<bool> output_cut_{false};       // output cut by the supervisor
  std::atomic<bool> closing_{false};
  std::atomic<bool> released_{false};  // true: zero force sent since closing began

  // scheduler's thread
  DriverFrame frame_;
  PlaceFilter places_;
  Calibration calibration_;
  HeldFault<HdapiHealth> fault_;
  Output output_ = Output::Unknown;
  glm::dvec3 force_n_{0.0};

  // supervisor's thread
  ToldHealth<HdapiHealth, HdapiHealth::DeviceFault> told_;
  bool cut_ = false;
  std::thread supervisor_;
};

// Entry for the registry.
core::Result<std::unique_ptr<HapticDevice>> open_hdapi(const DeviceRequest& request, ProbeLog& log);
void probe_hdapi(const Environment& environment, ProbeLog& log);

}  // namespace afm::haptics
