// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "core/exit_code.h"

namespace afm::core {

// Logs "error: <message>" and gives the exit code that says so.
int fail(ExitCode code, const std::string& message);

// The value of `run`; an exception is one line and RunFailed: no memory, no threads, Vulkan's own failures.
int report_exceptions(const std::function<int()>& run) noexcept;

// Body of main(): handles interruptions, runs `run`, whose value is the exit code, and reports exceptions.
int run_main(const std::function<int()>& run) noexcept;

}  // namespace afm::core
