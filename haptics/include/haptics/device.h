// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>

#include "scene/shared/shared_blocks.h"

// The servo's interface to a haptic device. The device frame is right +x, up +y, towards the user +z, in metres; its
// axes are parallel to the room's.
namespace afm::haptics {

struct DeviceSpec {
  std::string name;
  double max_force_n = 0;                                              // nominal peak
  double max_continuous_force_n = 0;                                   // continuous rating of the motors
  double max_stiffness_n_per_m = 0;                                    // stable at the servo's rate
  double max_slew_n_per_s = std::numeric_limits<double>::infinity();   // beyond it the driver cuts the force
  double max_speed_m_per_s = std::numeric_limits<double>::infinity();  // likewise
  double force_lasts_s = std::numeric_limits<double>::infinity();  // not renewed for so long, its driver takes it away
  bool measures = false;     // sensors tell where the hand is: they flicker, and what they tell can be wrong
  bool has_own_hand = true;  // false: it goes where follow() says
  glm::dvec3 workspace_min_m{0.0};
  glm::dvec3 workspace_max_m{0.0};
  glm::dvec3 contact_point_m{0.0};  // where the hand is when the tip touches the undeformed sample (Z = 0)
};

// An Omni, whose vendor's sheet most devices of this class follow: what the simulated and the recorded hand hold. 60 mm
// above and 40 mm below the contact point are for use, the uppermost 20 mm for the recoil after pull-off. Z = 0 lies at
// the origin.
DeviceSpec omni_like(std::string name);

// The same device, its places from the contact point, which is then the origin: what a recording can keep of it.
DeviceSpec from_contact(DeviceSpec spec);

// Description of a device in the shared segment. For a spec that is from_contact(), the round trip changes nothing
// except a name that is too long.
scene::SharedDevice shared(const DeviceSpec& spec);
DeviceSpec spec_of(const scene::SharedDevice& device);

// The force that the servo lets a device have at most: 2.0 N, the default of careful drivers for hands
// (sawSensablePhantom), and less for a device whose nominal peak leaves no reserve of a tenth.
double force_cap_n(const DeviceSpec& spec);

// The same device for an operator who wants less: its nominal peak is such that force_cap_n() is not above `max_n`.
inline constexpr double kLeastForceLimitN = 0.1;
DeviceSpec limited_to(DeviceSpec spec, double max_n);

// Usable share of a device's slew and speed limits: a driver cuts the force when its own limit is exceeded.
inline constexpr double kUsableLimitShare = 0.8;

// `wanted`, or what the device leaves for use where that is less.
double usable_slew_n_per_s(const DeviceSpec& spec, double wanted_n_per_s);

// Finite and not absurdly far: what a hand's position must be before anything is computed from it.
bool is_within_reach(const glm::dvec3& position_m) noexcept;

struct DeviceSample {
  glm::dvec3 position_m{0.0};
  bool turn_on = false;               // the button that enables the force, held down
  bool healthy = true;                // false: the device failed, the rest is not to be used
  double motor_heat = 0;              // as the device measures it: 1 is as hot as its motors may become, 0 if unknown
  std::uint32_t finished_script = 0;  // revision of the newest HandScript that was played to its end
};

// A force for a hand. Only SafetyGovernor can make one, so no other code can push a device.
class ForceCommand {
 public:
  const glm::dvec3& force_n() const noexcept { return force_n_; }

 private:
  friend class SafetyGovernor;
  explicit ForceCommand(const glm::dvec3& force_n) : force_n_(force_n) {}

  glm::dvec3 force_n_;
};

// A haptic device, used by the servo's thread alone. read() and write() are called in turn, once per tick, and neither
// waits, allocates nor throws.
class HapticDevice {
 public:
  HapticDevice() = default;
  HapticDevice(const HapticDevice&) = delete;
  HapticDevice& operator=(const HapticDevice&) = delete;
  virtual ~HapticDevice() = default;

  virtual const DeviceSpec& spec() const noexcept = 0;
  virtual DeviceSample read(std::int64_t now_ns) noexcept = 0;
  virtual void write(const ForceCommand& command) noexcept = 0;

  // Next motion of the simulated user. A real device ignores it.
  virtual void follow(const scene::HandScript& /*script*/) noexcept {}
};

}  // namespace afm::haptics
