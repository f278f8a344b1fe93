// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::core {

// Moves a file without replacing one; a file system that cannot refuse by itself is checked before. Returns 0 or errno:
// EEXIST if there is one.
int move_to_new(const std::string& from, const std::string& to);

}  // namespace afm::core
