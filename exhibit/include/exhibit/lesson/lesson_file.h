// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "exhibit/lesson/lesson.h"

namespace afm::exhibit {

// Reads a lesson file (TOML, assets/lessons; docs/manual.md has its keys). An unreadable file, an unknown or missing
// key, a wrong type and a value out of its range are errors that name file, line and key. Blind identification and
// thresholds on another scale than "common" are refused: on "fit" every material lets go at the same force.
core::Result<Lesson> load_lesson(const std::string& path);

}  // namespace afm::exhibit
