// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "exhibit/sound/synthesizer.h"
#include "servo/session_file.h"

namespace afm::exhibit {

// What a session sounds like, from its first tick on: left and right in turn at kSoundRateHz, the same samples every
// time. Each event begins with the sample that is nearest to its interpolated time. `gain`: 1 is as made. Fails with
// BadInputFile if the session's material has no law of force, or if it lasts longer than an hour.
core::Result<std::vector<float>> sound_of(const servo::RecordedSession& session, Channels channels, double gain);

// The same as the bytes of a WAV file.
core::Result<std::string> wav_of(const servo::RecordedSession& session, Channels channels, double gain);

}  // namespace afm::exhibit
