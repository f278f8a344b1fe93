// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace afm::app {

// Breaks the long lines of a help text between words for a terminal of so many columns, and indents the rest as the
// description in the line, or a little if that is far to the right. A line without blanks stays whole.
std::string wrapped_help(std::string_view text, std::size_t columns);

// Columns of the terminal to which stdout writes; 0 if it is none.
std::size_t terminal_columns();

}  // namespace afm::app
