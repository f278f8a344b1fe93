// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace afm::servo {

// Runs `program` with `arguments` and restarts it after each failure or crash, until it exits with success or with a
// permanent error (exit codes 2 to 4), or until SIGINT or SIGTERM ends both. Failed: more than kMostRestarts failures
// within a minute. Main thread only.
core::Result<void> keep_running(const std::string& program, const std::vector<std::string>& arguments);

inline constexpr int kMostRestarts = 5;

}  // namespace afm::servo
