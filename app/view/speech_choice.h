// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "exhibit/sound/speech_program.h"

namespace afm::app {

// Chooses the speech program from PATH: spd-say if this user runs a screen reader (Orca) and speech-dispatcher is
// installed, so that the screen reader's voice speaks; otherwise espeak-ng. DeviceMissing, with one line of text, if
// neither is installed. `language` is that of the phrases, "en".
core::Result<exhibit::SpeechProgram> choose_speech_program(const std::string& language);

}  // namespace afm::app
