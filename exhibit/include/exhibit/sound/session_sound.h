// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"
#include "exhibit/sound/synthesizer.h"
#include "servo/session_file.h"

namespace afm::exhibit {

// Sound of a session from its first tick on: left and right samples alternating at kSoundRateHz, always identical. Each
// event begins at the sample nearest to its interpolated time. `gain`: 1 is unchanged. BadInputFile if the session's
// material has no force law, or if the session is longer than an hour.
core::Result<std::vector<float>> sound_of(const servo::RecordedSession& session, Channels channels, double gain);

// Same as the contents of a WAV file.
core::Result<std::string> wav_of(const servo::RecordedSession& session, Channels channels, double gain);

}  // namespace afm::exhibit
