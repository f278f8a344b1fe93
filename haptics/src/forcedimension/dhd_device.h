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
#include "drivers/driver_faults.h"
#include "drivers/driver_mailbox.h"
#include "drivers/driver_thread.h"
#include "drivers/place_filter.h"
#include "forcedimension/dhd_health.h"
#include "forcedimension/dhd_library.h"
#include "haptics/device_registry.h"

namespace afm::haptics {

// Force Dimension omega, delta, sigma or lambda, or a Novint Falcon, driven by Force Dimension's library. No hardware
// has proved it: its tests drive a stand-in for the library.
//
// Three threads share it, and none waits for another. The library's calls are transfers over USB and may block, so a
// separate thread makes them, once a millisecond: it reads the hand, and passes the servo's newest command on. The
// servo reads and writes at its own rate. The supervisor watches that thread and reports changes.
//
// - The driver's thread does not trust the servo: it fades an old command to zero (CommandFade).
// - The servo does not trust the driver's thread: without a new position for kStallNs the device is not healthy, so the
//   governor cuts the force; the supervisor switches it off.
// - The device does not trust this process: without a new force for kWatchdogNs its own watchdog switches the force
// off.
// - The force is on only while the device is Ready; otherwise the brakes are. A force that the user switched off at the
//   device stays off until the user switches it on there.
// - The library carries the weight of the arm (gravity compensation) with every force, also with zero. With the force
//   off the brakes keep the arm from falling fast.
class DhdDevice final : public HapticDevice {
 public:
  static constexpr std::int64_t kPeriodNs = 1'000'000;
  static constexpr std::int64_t kStallNs = 10'000'000;
  static constexpr std::int64_t kWatchdogNs = 20'000'000;
  static constexpr std::int64_t kStatusNs = 10'000'000;     // time between two readings of the status
  static constexpr std::int64_t kForceModeNs = 50'000'000;  // time within which the device must switch its force on

  // Caller of run_cycle() and supervise(): the device's own threads, or a test.
  enum class Supervision { Threads, Caller };

  // Opens the device that `wanted` names (dhd::take_device) and starts its thread. DeviceMissing: none answers.
  // WrongUsage: `wanted` cannot be a name. Failed: it cannot be started. `clock` must outlive the device, and is the
  // one that provides the time of read().
  static core::Result<std::unique_ptr<DhdDevice>> open(const DhdFunctions& functions, const core::Clock& clock,
                                                       const std::string& wanted,
                                                       Supervision supervision = Supervision::Threads);

  // Reads the profile of a device without starting it.
  static core::Result<DeviceSpec> query(const DhdFunctions& functions, const std::string& wanted);

  // Sends zero force, switches the force off and the brakes on, and closes the device.
  ~DhdDevice() override;

  const DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t now_ns) noexcept override { return mailbox_.read(now_ns); }
  void write(const ForceCommand& command) noexcept override { mailbox_.write(command); }
  bool driver_is_realtime() const noexcept override { return thread_.is_realtime(); }

  // Health of the device at `now_ns`. Any thread.
  DhdHealth health(std::int64_t now_ns) const noexcept;

  // One period of the driver's thread, which calls the library.
  void run_cycle() noexcept;

  // Switches the force off if the driver's thread is caught in the library. Returns a log line if the health has
  // changed since the last one, or the motors cannot give the whole force. One thread, never the servo's.
  std::optional<std::string> supervise();

 private:
  enum class Output { Unknown, Off, On };

  DhdDevice(const DhdFunctions& functions, const core::Clock& clock, DhdId id, DeviceSpec spec);

  void prepare();
  core::Result<void> start();
  void serve() noexcept;

  // driver's thread, or the destructor's without one
  void follow_status(std::int64_t now_ns) noexcept;
  void follow_force_mode(bool in_force_mode, int cause, std::int64_t now_ns) noexcept;
  void read_hand(std::int64_t now_ns) noexcept;
  void switch_output(bool on, std::int64_t now_ns) noexcept;
  void send_force(std::int64_t now_ns, std::int64_t elapsed_ns) noexcept;
  void raise(DhdHealth fault, int error, std::int64_t now_ns) noexcept;
  void raise_last_error(std::int64_t now_ns) noexcept;
  DhdHealth own_health(std::int64_t now_ns) const noexcept;
  void release() noexcept;

  bool cut_force() noexcept;  // callable from any thread; false: the library refused

  DhdFunctions dhd_;
  const core::Clock& clock_;
  DhdId id_;
  DeviceSpec spec_;

  // shared by the threads
  DriverMailbox mailbox_{kStallNs};
  std::atomic<bool> called_{false};
  std::atomic<std::int64_t> last_fresh_ns_{0};  // time of the newest position from the device itself
  std::atomic<DhdHealth> health_{DhdHealth::Starting};
  std::atomic<int> error_{0};            // cause of the health; 0: not an error of the library
  std::atomic<bool> output_cut_{false};  // true: cut by the supervisor
  std::atomic<bool> saturated_{false};   // true: the motors gave less than the requested force
  std::atomic<bool> closing_{false};
  std::atomic<bool> released_{false};  // true: the driver's thread has ended with zero force

  // driver's thread
  DriverFrame frame_;
  PlaceFilter places_;
  HeldFault<DhdHealth> fault_;
  DhdHealth state_ = DhdHealth::Starting;  // health by the device's status
  std::optional<DhdHealth> switched_off_;  // health after the user switched the force off at the device
  bool passive_ = true;                    // true: without power or in reset mode, where no current flows
  Output output_ = Output::Unknown;
  std::int64_t cycle_ns_ = 0;
  std::int64_t status_ns_ = 0;
  std::int64_t output_on_ns_ = 0;

  // supervisor's thread
  ToldHealth<DhdHealth, DhdHealth::DeviceFault> told_;
  std::int64_t saturation_told_ns_ = 0;
  bool cut_ = false;

  bool threaded_ = false;
  DriverThread thread_;
  std::thread supervisor_;
};

// Entry for the registry.
core::Result<std::unique_ptr<HapticDevice>> open_force_dimension(const DeviceRequest& request, ProbeLog& log);
void probe_force_dimension(const Environment& environment, ProbeLog& log);

}  // namespace afm::haptics
