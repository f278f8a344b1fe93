// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/options/sound_options.h"
#include "exhibit/sound/speech_program.h"

namespace afm::app {

struct LiveSoundSettings {
  SoundOptions options;
  bool sound = false;                            // true: tones and signals on
  std::optional<exhibit::SpeechProgram> speech;  // program that speaks the texts; empty: captions only
};

}  // namespace afm::app
