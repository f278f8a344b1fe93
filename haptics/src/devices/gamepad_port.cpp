// SPDX-License-Identifier: Apache-2.0
#include "devices/gamepad_port.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace afm::haptics {

namespace {

constexpr double kFull = 32767.0;
constexpr int kStickAxis = 0;  // first axis of a joystick: axis 0 is right, axis 1 towards the user
constexpr Uint8 kTrigger = 0;

double share_of(Sint16 value) { return std::max(-1.0, static_cast<double>(value) / kFull); }
Uint16 strength(double share) { return static_cast<Uint16>(std::lround(65535.0 * std::clamp(share, 0.0, 1.0))); }

}  // namespace

core::Result<std::unique_ptr<GamepadPort>> GamepadPort::open(const SdlFunctions& sdl, int index) {
  std::unique_ptr<GamepadPort> port(new GamepadPort(sdl));
  if (sdl.is_controller(index) == SDL_TRUE) {
    port->controller_ = sdl.open_controller(index);
    if (port->controller_ != nullptr) port->joystick_ = sdl.joystick_of(port->controller_);
  } else {
    port->joystick_ = sdl.open_joystick(index);
  }
  if (port->joystick_ == nullptr) {
    return core::failure(core::ErrorCategory::DeviceMissing,
                         fmt::format("cannot open gamepad {}: {}", index, sdl.error()));
  }
  const char* name = sdl.name(port->joystick_);
  port->facts_.name = name == nullptr ? "unnamed gamepad" : name;
  port->facts_.rumble = sdl.has_rumble(port->joystick_) == SDL_TRUE;
  port->open_force();
  return port;
}

// Looks for a constant force effect; a controller's motors do not provide one.
void GamepadPort::open_force() {
  if (controller_ != nullptr || sdl_.is_haptic(joystick_) != 1) return;
  haptic_ = sdl_.open_haptic(joystick_);
  if (haptic_ == nullptr || (sdl_.effects(haptic_) & SDL_HAPTIC_CONSTANT) == 0) return;
  effect_.type = SDL_HAPTIC_CONSTANT;
  effect_.constant.direction.type = SDL_HAPTIC_CARTESIAN;
  effect_.constant.direction.dir[1] = 1;
  effect_.constant.length = SDL_HAPTIC_INFINITY;
  effect_id_ = sdl_.new_effect(haptic_, &effect_);
  facts_.force_feedback = effect_id_ >= 0 && sdl_.run_effect(haptic_, effect_id_, 1) == 0;
}

GamepadPort::~GamepadPort() {
  if (haptic_ != nullptr) {
    if (effect_id_ >= 0) sdl_.stop_effect(haptic_, effect_id_);
    sdl_.close_haptic(haptic_);
  }
  if (joystick_ != nullptr) sdl_.rumble(joystick_, 0, 0, 0);
  if (controller_ != nullptr) {
    sdl_.close_controller(controller_);
  } else if (joystick_ != nullptr) {
    sdl_.close_joystick(joystick_);
  }
  sdl_.quit(SDL_INIT_GAMECONTROLLER | SDL_INIT_HAPTIC);
}

bool GamepadPort::update() {
  sdl_.update();
  return sdl_.attached(joystick_) == SDL_TRUE;
}

// SDL counts down and towards the user as positive.
std::array<double, 3> GamepadPort::sticks() const {
  if (controller_ == nullptr) {
    return {share_of(sdl_.axis(joystick_, kStickAxis)), -share_of(sdl_.axis(joystick_, kStickAxis + 1)), 0.0};
  }
  const auto pressed = [&](SDL_GameControllerButton button) {
    return sdl_.controller_button(controller_, button) != 0 ? 1.0 : 0.0;
  };
  const double right = share_of(sdl_.controller_axis(controller_, SDL_CONTROLLER_AXIS_RIGHTX)) +
                       pressed(SDL_CONTROLLER_BUTTON_DPAD_RIGHT) - pressed(SDL_CONTROLLER_BUTTON_DPAD_LEFT);
  const double near = share_of(sdl_.controller_axis(controller_, SDL_CONTROLLER_AXIS_RIGHTY)) +
                      pressed(SDL_CONTROLLER_BUTTON_DPAD_DOWN) - pressed(SDL_CONTROLLER_BUTTON_DPAD_UP);
  return {std::clamp(right, -1.0, 1.0), -share_of(sdl_.controller_axis(controller_, SDL_CONTROLLER_AXIS_LEFTY)),
          std::clamp(near, -1.0, 1.0)};
}

bool GamepadPort::turn_on() const {
  if (controller_ == nullptr) return sdl_.button(joystick_, kTrigger) != 0;
  return sdl_.controller_button(controller_, SDL_CONTROLLER_BUTTON_A) != 0;
}

void GamepadPort::rumble(const Rumble& rumble) {
  sdl_.rumble(joystick_, strength(rumble.heavy), strength(rumble.light), GamepadDevice::kRumbleMs);
}

// SDL's direction is the one that the force comes from; its axes point right and towards the user. The hand's upward
// direction is away from the user on the stick.
void GamepadPort::push(const glm::dvec3& share) {
  const double length = std::hypot(share.x, share.y);
  SDL_HapticConstant& constant = effect_.constant;
  const auto level = static_cast<Sint16>(std::lround(kFull * std::min(1.0, length)));
  if (level == constant.level && level == 0) return;
  constant.level = level;
  if (level > 0) {
    constant.direction.dir[0] = static_cast<Sint32>(std::lround(-1000.0 * share.x / length));
    constant.direction.dir[1] = static_cast<Sint32>(std::lround(1000.0 * share.y / length));
  }
  sdl_.update_effect(haptic_, effect_id_, &effect_);
}

}  // namespace afm::haptics
