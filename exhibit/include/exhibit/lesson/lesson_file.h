// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/lesson/lesson.h"

namespace afm::exhibit {

// Reads a lesson file (TOML, assets/lessons; docs/manual/teach.md lists its keys). Errors that name file, line and key:
// an unreadable file, an unknown or missing key, a wrong type, and a value out of range. Rejects blind identification
// and thresholds on any scale except "common": on "fit" every material releases at the same force. Loads the lesson's
// particles, too: `assets_dir` has the sets that are given by a name. `materials`: the user's material file from
// the command line, empty for none; it only enters the digest.
core::Result<Lesson> load_lesson(const std::string& path, const std::string& assets_dir,
                                 const std::string& materials = {});

}  // namespace afm::exhibit
