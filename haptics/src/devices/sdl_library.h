// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SDL2/SDL.h>

#include <string>

#include "core/result.h"

namespace afm::haptics {

// SDL functions needed by a gamepad, loaded at run time, so that the servo starts on a machine without SDL and its
// window libraries.
struct SdlFunctions {
  decltype(&SDL_SetHint) set_hint = nullptr;
  decltype(&SDL_InitSubSystem) init = nullptr;
  decltype(&SDL_QuitSubSystem) quit = nullptr;
  decltype(&SDL_GetError) error = nullptr;
  decltype(&SDL_NumJoysticks) count = nullptr;
  decltype(&SDL_IsGameController) is_controller = nullptr;
  decltype(&SDL_GameControllerOpen) open_controller = nullptr;
  decltype(&SDL_GameControllerClose) close_controller = nullptr;
  decltype(&SDL_GameControllerGetJoystick) joystick_of = nullptr;
  decltype(&SDL_GameControllerGetAxis) controller_axis = nullptr;
  decltype(&SDL_GameControllerGetButton) controller_button = nullptr;
  decltype(&SDL_JoystickOpen) open_joystick = nullptr;
  decltype(&SDL_JoystickClose) close_joystick = nullptr;
  decltype(&SDL_JoystickName) name = nullptr;
  decltype(&SDL_JoystickUpdate) update = nullptr;
  decltype(&SDL_JoystickGetAttached) attached = nullptr;
  decltype(&SDL_JoystickGetAxis) axis = nullptr;
  decltype(&SDL_JoystickGetButton) button = nullptr;
  decltype(&SDL_JoystickHasRumble) has_rumble = nullptr;
  decltype(&SDL_JoystickRumble) rumble = nullptr;
  decltype(&SDL_JoystickIsHaptic) is_haptic = nullptr;
  decltype(&SDL_HapticOpenFromJoystick) open_haptic = nullptr;
  decltype(&SDL_HapticClose) close_haptic = nullptr;
  decltype(&SDL_HapticQuery) effects = nullptr;
  decltype(&SDL_HapticNewEffect) new_effect = nullptr;
  decltype(&SDL_HapticUpdateEffect) update_effect = nullptr;
  decltype(&SDL_HapticRunEffect) run_effect = nullptr;
  decltype(&SDL_HapticStopEffect) stop_effect = nullptr;
};

inline constexpr const char* kSdlLibrary = "libSDL2-2.0.so.0";

// Loads kSdlLibrary once, for the lifetime of the process. The error is the dynamic linker's message.
core::Result<SdlFunctions> load_sdl();

}  // namespace afm::haptics
