// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::app {

// Writes the whole text to stdout. The error contains the reason, such as a closed pipe.
core::Result<void> write_stdout(std::string_view text);

// Same for a report in words, safe for a terminal whatever names it repeats; its last line names the program.
core::Result<void> write_report(std::string text);

// Fails if anything printed before could not be written. Every command ends with this call.
core::Result<void> flush_stdout();

}  // namespace afm::app
