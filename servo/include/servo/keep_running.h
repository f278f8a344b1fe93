// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.h"

namespace afm::servo {

// Starts `program` with `arguments`, and again each time it fails or crashes, until it ends well, is refused for good
// (exit codes 2 to 4), or SIGINT or SIGTERM ends both. Failed: it has failed more than kMostRestarts times within a
// minute. Main thread only.
core::Result<void> keep_running(const std::string& program, const std::vector<std::string>& arguments);

inline constexpr int kMostRestarts = 5;

}  // namespace afm::servo
