// SPDX-License-Identifier: Apache-2.0
// Interface to SDL, which no other file of the exhibit includes.
#include <SDL2/SDL.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <span>

#include "exhibit/sound/sound_output.h"
#include "exhibit/sound/stream_clock.h"

namespace afm::exhibit {

namespace {

constexpr const char* kSdl = "libSDL2-2.0.so.0";

// The SDL functions used for sound.
struct SdlAudio {
  decltype(&SDL_SetHint) set_hint = nullptr;
  decltype(&SDL_InitSubSystem) init = nullptr;
  decltype(&SDL_QuitSubSystem) quit = nullptr;
  decltype(&SDL_GetError) error = nullptr;
  decltype(&SDL_GetCurrentAudioDriver) driver = nullptr;
  decltype(&SDL_OpenAudioDevice) open = nullptr;
  decltype(&SDL_CloseAudioDevice) close = nullptr;
  decltype(&SDL_PauseAudioDevice) pause = nullptr;
  decltype(&SDL_GetAudioDeviceStatus) status = nullptr;
};

template <class Function>
bool bind(void* library, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(::dlsym(library, name));
  return function != nullptr;
}

core::Error no_sound(const std::string& why) {
  return {core::ErrorCategory::DeviceMissing,
          fmt::format("no sound: {}; connect a sound card and start again, captions go on", why)};
}

void say_nothing(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/, const char* /*format*/,
                 ...) {}

// Keeps ALSA, which SDL loads, from writing lines about a missing sound card to stderr in addition to our line.
void quieten_alsa() {
  using Handler = void (*)(const char* file, int line, const char* function, int error, const char* format, ...);
  int (*set_handler)(Handler) = nullptr;
  void* const alsa = ::dlopen("libasound.so.2", RTLD_NOW | RTLD_LOCAL);
  if (alsa != nullptr && bind(alsa, "snd_lib_error_set_handler", set_handler)) {
    set_handler(&say_nothing);
  }
}

// Loads the library once, and never unloads it, because SDL's threads may outlast a call.
core::Result<SdlAudio> load_audio() {
  void* const library = ::dlopen(kSdl, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return tl::unexpected(no_sound(fmt::format("{} cannot be loaded", kSdl)));
  quieten_alsa();
  SdlAudio sdl;
  const bool whole =
      bind(library, "SDL_SetHint", sdl.set_hint) && bind(library, "SDL_InitSubSystem", sdl.init) &&
      bind(library, "SDL_QuitSubSystem", sdl.quit) && bind(library, "SDL_GetError", sdl.error) &&
      bind(library, "SDL_GetCurrentAudioDriver", sdl.driver) && bind(library, "SDL_OpenAudioDevice", sdl.open) &&
      bind(library, "SDL_CloseAudioDevice", sdl.close) && bind(library, "SDL_PauseAudioDevice", sdl.pause) &&
      bind(library, "SDL_GetAudioDeviceStatus", sdl.status);
  if (!whole) return tl::unexpected(no_sound(fmt::format("{} lacks its functions for sound", kSdl)));
  return sdl;
}

class SdlOutput final : public SoundOutput {
 public:
  SdlOutput(const SdlAudio& sdl, SoundMixer& mixer, const core::Clock& clock)
      : sdl_(sdl), mixer_(mixer), clock_(clock) {}
  SdlOutput(const SdlOutput&) = delete;
  SdlOutput& operator=(const SdlOutput&) = delete;
  ~SdlOutput() override {
    if (device_ != 0) sdl_.close(device_);
    if (begun_) sdl_.quit(SDL_INIT_AUDIO);
  }

  // Returns SDL's error, or an empty text.
  std::string begin() {
    sdl_.set_hint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    sdl_.set_hint(SDL_HINT_AUDIO_DEVICE_APP_NAME, "TouchAFM");
    if (sdl_.init(SDL_INIT_AUDIO) != 0) return sdl_.error();
    begun_ = true;
    SDL_AudioSpec wanted{};
    wanted.freq = kSoundRateHz;
    wanted.format = AUDIO_F32SYS;
    wanted.channels = 2;
    wanted.samples = kFramesOfBuffer;
    wanted.callback = &SdlOutput::pull;
    wanted.userdata = this;
    // SDL converts to the card's format
    device_ = sdl_.open(nullptr, 0, &wanted, nullptr, 0);
    if (device_ == 0) return sdl_.error();
    if (const char* name = sdl_.driver()) driver_ = name;
    sdl_.pause(device_, 0);
    return {};
  }

  const std::string& driver() const override { return driver_; }
  bool plays() override { return sdl_.status(device_) != SDL_AUDIO_STOPPED; }

 private:
  // Called in SDL's audio thread.
  static void SDLCALL pull(void* self, Uint8* bytes, int size) noexcept {
    auto& output = *static_cast<SdlOutput*>(self);
    const auto count = static_cast<std::size_t>(size) / sizeof(float);
    output.mixer_.fill({reinterpret_cast<float*>(bytes), count}, output.clock_.now_ns());
  }

  SdlAudio sdl_;
  SoundMixer& mixer_;
  const core::Clock& clock_;
  std::string driver_;
  SDL_AudioDeviceID device_ = 0;
  bool begun_ = false;
};

}  // namespace

core::Result<std::unique_ptr<SoundOutput>> SoundOutput::open(SoundMixer& mixer, const core::Clock& clock) {
  const auto sdl = load_audio();
  if (!sdl) return tl::unexpected(sdl.error());
  auto output = std::make_unique<SdlOutput>(*sdl, mixer, clock);
  if (const std::string error = output->begin(); !error.empty()) return tl::unexpected(no_sound("SDL says: " + error));
  return output;
}

}  // namespace afm::exhibit
