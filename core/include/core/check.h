// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::core {

// Prints the failed expression and its place to stderr and aborts.
[[noreturn]] void check_failed(const char* expression, const char* file, int line);

}  // namespace afm::core

// Checks for our own bugs, active in every build type; never for bad input, and never inside a servo tick. The file
// name is printed without its folder, so that an installed program contains no path of the build machine.
#define AFM_CHECK(expression) \
  (static_cast<bool>(expression) ? void(0) : ::afm::core::check_failed(#expression, __FILE_NAME__, __LINE__))
