// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>

#include "scene/shared/shared_blocks.h"

// Interface between the servo and a haptic device. The device frame is right +x, up +y, towards the user +z, in metres;
// its axes are parallel to the room's.
namespace afm::haptics {

// Largest amplitude of any vibration on a hand.
inline constexpr double kMostVibrationN = 0.1;

struct DeviceSpec {
  std::string name;
  double max_force_n = 0;                                              // nominal peak force
  double max_continuous_force_n = 0;                                   // continuous rating of the motors
  double max_stiffness_n_per_m = 0;                                    // largest stable stiffness at the servo's rate
  double max_slew_n_per_s = std::numeric_limits<double>::infinity();   // rate above which the driver cuts the force
  double max_speed_m_per_s = std::numeric_limits<double>::infinity();  // speed above which the driver cuts the force
  double force_lasts_s = std::numeric_limits<double>::infinity();      // age at which the driver drops a force
  double max_vibration_n = 0;                                          // largest amplitude of a vibration; 0: none
  bool measures = false;     // true: sensors measure the position, which flickers and can be wrong
  bool has_own_hand = true;  // false: the hand is moved by follow()
  glm::dvec3 workspace_min_m{0.0};
  glm::dvec3 workspace_max_m{0.0};
  glm::dvec3 contact_point_m{0.0};  // position of the hand when the tip touches the undeformed sample (Z = 0)
};

// An Omni, whose data sheet most devices of this class follow; used for the simulated and the recorded hand. The
// workspace extends 60 mm above and 40 mm below the contact point; its top 20 mm are for the recoil after pull-off. Z =
// 0 is at the origin.
DeviceSpec omni_like(std::string name);

// The device with positions relative to the contact point, which is then the origin: the part that a recording can
// keep.
DeviceSpec from_contact(DeviceSpec spec);

// Description of a device in the shared segment. For a spec that is from_contact(), the round trip changes nothing
// except a name that is too long.
scene::SharedDevice shared(const DeviceSpec& spec);
DeviceSpec spec_of(const scene::SharedDevice& device);

// Largest force that the servo lets a device apply: 2.0 N, the default of careful drivers for hands
// (sawSensablePhantom), or less for a device whose nominal peak leaves no reserve of 10 %.
double force_cap_n(const DeviceSpec& spec);

// The device as limited by the operator: its nominal peak is reduced until force_cap_n() is at most `max_n`.
inline constexpr double kLeastForceLimitN = 0.1;
DeviceSpec limited_to(DeviceSpec spec, double max_n);

// Fraction of a device's slew and speed limits that TouchAFM uses, because a driver cuts the force when its own limit
// is exceeded.
inline constexpr double kUsableLimitShare = 0.8;

// `wanted_n_per_s`, limited to the usable share of the device's slew limit.
double usable_slew_n_per_s(const DeviceSpec& spec, double wanted_n_per_s);

// True if a position is finite and plausible, which must be checked before any computation with it.
bool is_within_reach(const glm::dvec3& position_m) noexcept;

struct DeviceSample {
  glm::dvec3 position_m{0.0};
  bool turn_on = false;               // true: the button that enables the force is held down
  bool healthy = true;                // false: the device failed, and the other fields are invalid
  double motor_heat = 0;              // heat as measured by the device: 1 is the limit of its motors, 0 if unknown
  std::uint32_t finished_script = 0;  // revision of the newest HandScript played to its end
};

// Force for a hand. Only SafetyGovernor can create one, so no other code can move a device.
class ForceCommand {
 public:
  const glm::dvec3& force_n() const noexcept { return force_n_; }

 private:
  friend class SafetyGovernor;
  explicit ForceCommand(const glm::dvec3& force_n) : force_n_(force_n) {}

  glm::dvec3 force_n_;
};

// Haptic device, used only by the servo's thread. read() and write() are called in turn, once per tick; neither waits,
// allocates nor throws.
class HapticDevice {
 public:
  HapticDevice() = default;
  HapticDevice(const HapticDevice&) = delete;
  HapticDevice& operator=(const HapticDevice&) = delete;
  virtual ~HapticDevice() = default;

  virtual const DeviceSpec& spec() const noexcept = 0;
  virtual DeviceSample read(std::int64_t now_ns) noexcept = 0;
  virtual void write(const ForceCommand& command) noexcept = 0;

  // False if the driver has a thread on the way to the hand that did not get the servo's scheduling.
  virtual bool driver_is_realtime() const noexcept { return true; }

  // Next motion of the simulated user. A real device ignores it.
  virtual void follow(const scene::HandScript& /*script*/) noexcept {}
};

}  // namespace afm::haptics
