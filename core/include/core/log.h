// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace afm::core {

// Writes "touchafm: <text>" to stderr with a single write(), so that lines of two processes never mix. Never waits for
// a reader: while stderr is full or its terminal stopped, up to 256 lines wait for a thread of the log, later ones are
// dropped and counted. Replaces characters that are unsafe for a terminal (core/printable.h). Any thread, never the
// servo tick.
void log_line(std::string_view text);

}  // namespace afm::core
