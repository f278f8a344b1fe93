// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace afm::core {

// One line to stderr, "touchafm: <text>", written by a single write() so that lines of the two processes never mix.
// What no terminal should get is replaced (core/printable.h). Any thread, never the servo tick.
void log_line(std::string_view text);

}  // namespace afm::core
