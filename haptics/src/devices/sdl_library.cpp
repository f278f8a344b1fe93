// SPDX-License-Identifier: Apache-2.0
#include "devices/sdl_library.h"

#include <dlfcn.h>

#include <utility>

#include "drivers/function_binder.h"

namespace afm::haptics {

core::Result<SdlFunctions> load_sdl() {
  void* library = ::dlopen(kSdlLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return core::failure(core::ErrorCategory::DeviceMissing, linker_error());
  SdlFunctions sdl;
  FunctionBinder binder(library);
  binder.bind("SDL_SetHint", sdl.set_hint);
  binder.bind("SDL_InitSubSystem", sdl.init);
  binder.bind("SDL_QuitSubSystem", sdl.quit);
  binder.bind("SDL_GetError", sdl.error);
  binder.bind("SDL_NumJoysticks", sdl.count);
  binder.bind("SDL_IsGameController", sdl.is_controller);
  binder.bind("SDL_GameControllerOpen", sdl.open_controller);
  binder.bind("SDL_GameControllerClose", sdl.close_controller);
  binder.bind("SDL_GameControllerGetJoystick", sdl.joystick_of);
  binder.bind("SDL_GameControllerGetAxis", sdl.controller_axis);
  binder.bind("SDL_GameControllerGetButton", sdl.controller_button);
  binder.bind("SDL_JoystickOpen", sdl.open_joystick);
  binder.bind("SDL_JoystickClose", sdl.close_joystick);
  binder.bind("SDL_JoystickName", sdl.name);
  binder.bind("SDL_JoystickUpdate", sdl.update);
  binder.bind("SDL_JoystickGetAttached", sdl.attached);
  binder.bind("SDL_JoystickGetAxis", sdl.axis);
  binder.bind("SDL_JoystickGetButton", sdl.button);
  binder.bind("SDL_JoystickHasRumble", sdl.has_rumble);
  binder.bind("SDL_JoystickRumble", sdl.rumble);
  binder.bind("SDL_JoystickIsHaptic", sdl.is_haptic);
  binder.bind("SDL_HapticOpenFromJoystick", sdl.open_haptic);
  binder.bind("SDL_HapticClose", sdl.close_haptic);
  binder.bind("SDL_HapticQuery", sdl.effects);
  binder.bind("SDL_HapticNewEffect", sdl.new_effect);
  binder.bind("SDL_HapticUpdateEffect", sdl.update_effect);
  binder.bind("SDL_HapticRunEffect", sdl.run_effect);
  binder.bind("SDL_HapticStopEffect", sdl.stop_effect);
  if (auto refusal = binder.refusal(); !refusal.empty())
    return core::failure(core::ErrorCategory::DeviceMissing, std::move(refusal));
  return sdl;
}

}  // namespace afm::haptics
