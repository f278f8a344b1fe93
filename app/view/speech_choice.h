// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "exhibit/sound/speech_program.h"

namespace afm::app {

// The program that speaks: spd-say where a screen reader (Orca) of the same user runs and speech-dispatcher is
// installed, so that its own voice speaks; otherwise espeak-ng. Looked up in PATH. DeviceMissing, with one line, if
// there is neither. `language`: of the phrases, "en".
core::Result<exhibit::SpeechProgram> choose_speech_program(const std::string& language);

}  // namespace afm::app
