// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/clock.h"
#include "core/result.h"
#include "exhibit/sound/sound_mixer.h"

namespace afm::exhibit {

// The sound card through SDL2, which is loaded at run time, so that the program runs without both. SDL's thread reads
// from the mixer, 256 frames at a time: two such buffers are 10.7 ms. The environment variable SDL_AUDIODRIVER selects
// SDL's driver.
class SoundOutput {
 public:
  static constexpr int kFramesOfBuffer = 256;

  // Mixer and clock must outlive the object. DeviceMissing, with one line of text, if SDL2 or a working card is
  // missing.
  static core::Result<std::unique_ptr<SoundOutput>> open(SoundMixer& mixer, const core::Clock& clock);

  SoundOutput(const SoundOutput&) = delete;
  SoundOutput& operator=(const SoundOutput&) = delete;
  virtual ~SoundOutput() = default;

  virtual const std::string& driver() const = 0;  // SDL's name of its driver: "pulseaudio"

  // False once the card is gone, which is permanent.
  virtual bool plays() = 0;

 protected:
  SoundOutput() = default;
};

}  // namespace afm::exhibit
