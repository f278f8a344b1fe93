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

// One controller or joystick that SDL has opened. One thread after open(). Its destructor stops motors and effects,
// closes it, and leaves SDL.
class GamepadPort {
 public:
  // Joystick `index` of SDL's list, whose subsystems the caller has started: the port leaves them when it goes.
  static core::Result<std::unique_ptr<GamepadPort>> open(const SdlFunctions& sdl, int index);

  GamepadPort(const GamepadPort&) = delete;
  GamepadPort& operator=(const GamepadPort&) = delete;
  ~GamepadPort();

  const GamepadDevice::Facts& facts() const { return facts_; }

  // Asks SDL for news; false once it is unplugged.
  bool update();
  std::array<double, 3> sticks() const;  // right, up, towards the user, -1 to 1
  bool turn_on() const;

  // As long as the next call, and at most GamepadDevice::kRumbleMs.
  void rumble(const Rumble& rumble);

  // Until the next call. `share`: of the device's strength, in the device frame, at most 1 long.
  void push(const glm::dvec3& share);

 private:
  explicit GamepadPort(const SdlFunctions& sdl) : sdl_(sdl) {}

  void open_force();

  SdlFunctions sdl_;
  GamepadDevice::Facts facts_;
  SDL_GameController* controller_ = nullptr;  // null: a joystick
  SDL_Joystick* joystick_ = nullptr;          // of the controller, or by itself
  SDL_Haptic* haptic_ = nullptr;
  SDL_HapticEffect effect_{};
  int effect_id_ = -1;
};

}  // namespace afm::haptics
