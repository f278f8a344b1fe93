// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/latest_value.h"
#include "core/result.h"
#include "devices/force_rumble.h"
#include "drivers/driver_thread.h"
#include "haptics/device_registry.h"
#include "haptics/simulated_device.h"

namespace afm::haptics {

struct SdlFunctions;  // haptics/src/sdl_library.h
class GamepadPort;    // haptics/src/gamepad_port.h

// Game controller or joystick supported by SDL2. It moves the aim of a simulated hand, as a mouse does. The governor's
// force acts on that hand, so that the tip snaps in, sticks and flies off on the wall, and the user feels as much of
// the force as the device can render.
//
// - A game controller moves the aim at a bounded speed: left stick up and down, right stick or d-pad sideways; A is
//   Turn-On. Its motors render jumps and the force (ForceRumble).
// - A joystick with force feedback sets the position of the aim by its deflection, its first button is Turn-On, and a
//   constant effect pushes it in the direction of the force, at full strength for the cap.
//
// SDL runs in a separate thread, about 250 times a second, which exchanges data with the servo's tick through two
// mailboxes. Neither trusts the other: without an update for kStallNs, or unplugged, the device is not healthy; a force
// that the servo has not renewed for kStaleNs stops, and a rumble ends by itself after kRumbleMs.
class GamepadDevice final : public HapticDevice {
 public:
  static constexpr std::int64_t kStallNs = 100'000'000;
  static constexpr std::int64_t kCoastNs = 20'000'000;  // longest time without an update before the aim stops
  static constexpr std::int64_t kStaleNs = 20'000'000;
  static constexpr std::uint32_t kRumbleMs = 60;
  static constexpr double kFastestMPerS = 0.10;  // largest speed of a game controller's aim
  static constexpr double kReachM = 0.060;       // range of a joystick's aim, in each direction

  // Message without a gamepad, with the command that grants access to one.
  static constexpr const char* kNone =
      "none is plugged in, or permission is denied; in that case: sudo usermod -aG input \"$(id -un)\", then log in "
      "again";

  // Properties of the connected device.
  struct Facts {
    std::string name;
    bool force_feedback = false;
    bool rumble = false;
  };

  // All connected devices, in SDL's order; starts none.
  static core::Result<std::vector<Facts>> list(const SdlFunctions& sdl);

  enum class Wanted { Any, ForceFeedback };

  // Opens the first one with force feedback or, if any is acceptable, the first one. DeviceMissing: there is none.
  // `clock` must outlive the device, and is the one that provides the time of read().
  static core::Result<std::unique_ptr<GamepadDevice>> open(const SdlFunctions& sdl, const core::Clock& clock,
                                                           Wanted wanted);

  // Stops motors and effects first.
  ~GamepadDevice() override;

  const DeviceSpec& spec() const noexcept override { return spec_; }
  DeviceSample read(std::int64_t now_ns) noexcept override;
  void write(const ForceCommand& command) noexcept override;
  bool driver_is_realtime() const noexcept override { return thread_.is_realtime(); }

 private:
  // Latest stick positions from SDL, -1 to 1 along the device frame.
  struct Frame {
    std::int64_t time_ns = 0;
    std::array<double, 3> sticks{};
    std::uint32_t turn_on = 0;
    std::uint32_t attached = 0;
  };
  struct Feeling {
    std::int64_t time_ns = 0;
    std::array<double, 3> force_n{};
    Rumble rumble;
  };

  GamepadDevice(const core::Clock& clock, std::unique_ptr<GamepadPort> port);

  void run();
  void show(const Feeling& feeling, std::int64_t now_ns);
  void move_aim(std::int64_t now_ns) noexcept;

  const core::Clock& clock_;
  std::unique_ptr<GamepadPort> port_;
  DeviceSpec spec_;

  // shared by the threads
  core::LatestValue<Frame> frames_;
  core::LatestValue<Feeling> feelings_;
  std::atomic<bool> closing_{false};

  // servo's thread
  SimulatedDevice hand_;
  ForceRumble rumble_;
  Frame seen_;
  glm::dvec3 aim_m_;
  std::uint32_t script_ = 0;
  std::int64_t tick_ns_ = 0;

  // SDL's thread
  Rumble told_;
  std::int64_t logged_ns_ = 0;
  DriverThread thread_;
};

// Entry for the registry. A gamepad lying on the desk must not replace the mouse: unless it is named, only a joystick
// with force feedback is accepted.
core::Result<std::unique_ptr<HapticDevice>> open_gamepad(const DeviceRequest& request, ProbeLog& log);
void probe_gamepads(const Environment& environment, ProbeLog& log);

}  // namespace afm::haptics
