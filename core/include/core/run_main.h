// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "core/exit_code.h"

namespace afm::core {

// Logs "error: <message>" and returns `code` as an int.
int fail(ExitCode code, const std::string& message);

// Returns the value of `run`, or logs an exception on one line and returns RunFailed: no memory, no threads, Vulkan's
// own failures.
int report_exceptions(const std::function<int()>& run) noexcept;

// Body of main(): handles interruptions, calls `run`, whose value is the exit code, and reports exceptions.
int run_main(const std::function<int()>& run) noexcept;

}  // namespace afm::core
