// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::core {

// Prints the failed expression and its place to stderr and aborts.
[[noreturn]] void check_failed(const char* expression, const char* file, int line);

}  // namespace afm::core

// Our own bugs, in every build type. Never for bad input, and never inside a servo tick. The name of the file goes
// without its folder: an installed program holds no path of the machine that built it.
#define AFM_CHECK(expression) \
  (static_cast<bool>(expression) ? void(0) : ::afm::core::check_failed(#expression, __FILE_NAME__, __LINE__))
