// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/clock.h"
#include "core/latest_value.h"
#include "core/result.h"
#include "devices/hdapi_health.h"
#include "devices/hdapi_library.h"
#include "haptics/device_registry.h"

namespace afm::haptics {

// A PHANTOM Omni, a Touch, or what else the vendor's library drives. At most one in a process.
//
// Three threads meet here and none waits for another. The vendor's scheduler calls once a millisecond, takes the newest
// command of the servo to the device and leaves the hand's place behind. The servo reads and writes at its own pace.
// The supervisor watches the scheduler and says what changed.
//
// - The scheduler's side trusts no servo: a command older than kStaleNs fades to exactly zero within kReleaseNs, and
//   comes back over kReturnNs.
// - The servo's side trusts no scheduler: with no callback for kStallNs the device is not healthy, so the governor
// cuts.
// - No step of the force is larger than the device's own limit allows, except that zero passes at once.
// - The force output is on only while the device is Ready; before a calibration it is off.
class HdapiDevice final : public HapticDevice {
 public:
  static constexpr std::int64_t kStaleNs = 5'000'000;
  static constexpr std::int64_t kReleaseNs = 10'000'000;
  static constexpr std::int64_t kReturnNs = 100'000'000;
  static constexpr std::int64_t kStallNs = 5'000'000;
  static constexpr std::int64_t kCalibrationCheckNs = 100'000'000;
  static constexpr std::int64_t kSameLineNs = 10'000'000'000;  // between two that say the same

  // Caller of supervise(): the device's thread, or a test at its own pace.
  enum class Supervision { Thread, Caller };

  // Takes the device called `name`, or, if that is empty, the first of the default device, "Default Device" and
  // "Default PHANToM" that answers, asks for its limits and starts the scheduler. DeviceMissing: none answers; the
  // message has every name that was tried and what the library said. Failed: it reports limits that cannot be, or
  // cannot be started. `clock` outlives the device and is the one whose time read() is given.
  static core::Result<std::unique_ptr<HdapiDevice>> open(const HdapiFunctions& functions, const core::Clock& clock,
                                                         const std::string& name,
                                                         Supervision supervision = Supervision::Thread);

  // Properties of a device, read without starting it.
  static core::Result<DeviceSpec> query(const HdapiFunctions& functions, const std::string& name);

  // Zero force, force output off, then the scheduler stops, the callback goes, and the device is released.
  ~HdapiDevice() override;

  const DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t now_ns) noexcept override;
  void write(const ForceCommand& command) noexcept override;

  // Health of the device at `now_ns`. Any thread.
  HdapiHealth health(std::int64_t now_ns) const noexcept;

  // Switches the force output off when the scheduler has stalled. Gives a line for the log when the health has changed
  // since the last line, the same one at most every ten seconds. One thread, never the servo's: the library may take
  // its time, or hang.
  std::optional<std::string> supervise();

 private:
  struct Frame {
    std::int64_t time_ns = 0;
    glm::dvec3 position_m{0.0};
    double motor_heat = 0;
    std::uint32_t buttons = 0;
    std::uint32_t ready = 0;
  };
  struct TimedForce {
    std::int64_t time_ns = 0;
    glm::dvec3 force_n{0.0};
  };
  enum class Output { Unknown, Off, On };

  HdapiDevice(const HdapiFunctions& functions, const core::Clock& clock, HdapiHandle handle, DeviceSpec spec);

  core::Result<void> start(Supervision supervision);

  // the scheduler's thread
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

  // between the threads
  core::LatestValue<Frame> frames_;
  core::LatestValue<TimedForce> commands_;
  std::atomic<bool> called_{false};
  std::atomic<std::int64_t> last_frame_ns_{0};
  std::atomic<HdapiHealth> health_{HdapiHealth::Starting};
  std::atomic<std::uint32_t> error_code_{0};  // what led to it, 0: no error of the library
  std::atomic<bool> output_cut_{false};       // by the supervisor
  std::atomic<bool> closing_{false};
  std::atomic<bool> released_{false};  // zero force was sent after closing began

  // the scheduler's thread
  Frame frame_;
  bool has_position_ = false;
  glm::dvec3 raw_position_m_{0.0};
  std::uint32_t calibration_style_ = 0;
  HdapiHealth calibration_ = HdapiHealth::Starting;
  std::int64_t calibration_checked_ns_ = 0;
  HdapiHealth fault_ = HdapiHealth::Ready;
  std::uint32_t fault_code_ = 0;
  std::int64_t fault_until_ns_ = 0;
  Output output_ = Output::Unknown;
  TimedForce command_;
  std::int64_t trust_ns_ = 0;  // of kReturnNs: how far the servo's commands count
  glm::dvec3 force_n_{0.0};

  // the servo's thread
  Frame seen_;
  std::int64_t tick_ns_ = 0;

  // the supervisor's thread
  HdapiHealth told_ = HdapiHealth::Starting;
  std::array<std::int64_t, static_cast<std::size_t>(HdapiHealth::DeviceFault) + 1> told_ns_{};  // when it was
  bool cut_ = false;
  std::thread supervisor_;
};

// For the registry.
core::Result<std::unique_ptr<HapticDevice>> open_hdapi(const DeviceRequest& request, ProbeLog& log);
void probe_hdapi(const Environment& environment, ProbeLog& log);

}  // namespace afm::haptics
