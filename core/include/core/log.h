// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace afm::core {

// Writes "touchafm: <text>" to stderr with a single write(), so that lines of the two processes never mix. Replaces
// characters that are unsafe for a terminal (core/printable.h). Any thread, never the servo tick.
void log_line(std::string_view text);

}  // namespace afm::core
