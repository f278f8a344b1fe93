// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/clock.h"
#include "core/result.h"
#include "exhibit/sound/sound_mixer.h"

namespace afm::exhibit {

// The sound card, through SDL2, which is loaded when it is opened: the program needs neither where there is no sound.
// Its thread pulls from the mixer, 256 frames at a time: two such buffers are 10.7 ms. The environment variable
// SDL_AUDIODRIVER chooses SDL's driver.
class SoundOutput {
 public:
  static constexpr int kFramesOfBuffer = 256;

  // Mixer and clock must outlive it. DeviceMissing, with one line, if there is no SDL2, no card, or none that plays.
  static core::Result<std::unique_ptr<SoundOutput>> open(SoundMixer& mixer, const core::Clock& clock);

  SoundOutput(const SoundOutput&) = delete;
  SoundOutput& operator=(const SoundOutput&) = delete;
  virtual ~SoundOutput() = default;

  virtual const std::string& driver() const = 0;  // "pulseaudio"

  // False once the card is gone, which is for good.
  virtual bool plays() = 0;

 protected:
  SoundOutput() = default;
};

}  // namespace afm::exhibit
