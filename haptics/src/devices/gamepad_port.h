// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>

#include "core/result.h"
#include "devices/force_rumble.h"
#include "devices/gamepad_device.h"
#include "devices/sdl_library.h"

namespace afm::haptics {

// Controller or joystick opened by SDL. One thread after open(). The destructor stops motors and effects, closes it,
// and shuts down SDL once.
class GamepadPort {
 public:
  // Opens joystick `index` of SDL's list. The caller has initialised SDL's subsystems, and the port shuts them down on
  // destruction.
  static core::Result<std::unique_ptr<GamepadPort>> open(const SdlFunctions& sdl, int index);

  GamepadPort(const GamepadPort&) = delete;
  GamepadPort& operator=(const GamepadPort&) = delete;
  ~GamepadPort();

  const GamepadDevice::Facts& facts() const { return facts_; }

  // Polls SDL; false once the device is unplugged.
  bool update();
  std::array<double, 3> sticks() const;  // positions to the right, up and towards the user, -1 to 1
  bool turn_on() const;

  // Rumbles until the next call, for at most GamepadDevice::kRumbleMs.
  void rumble(const Rumble& rumble);

  // Pushes until the next call. `share` is a fraction of the device's strength, in the device frame, with a length of
  // at most 1.
  void push(const glm::dvec3& share);

 private:
  explicit GamepadPort(const SdlFunctions& sdl) : sdl_(sdl) {}

  void open_force();

  SdlFunctions sdl_;
  GamepadDevice::Facts facts_;
  SDL_GameController* controller_ = nullptr;  // null for a joystick
  SDL_Joystick* joystick_ = nullptr;          // joystick of the controller, or a plain joystick
  SDL_Haptic* haptic_ = nullptr;
  SDL_HapticEffect effect_{};
  int effect_id_ = -1;
};

}  // namespace afm::haptics
