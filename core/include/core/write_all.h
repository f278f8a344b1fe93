// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace afm::core {

// Writes all of `bytes`, with as many calls as needed. Returns 0 or errno. Any thread; allocates nothing.
int write_all(int descriptor, std::string_view bytes) noexcept;

}  // namespace afm::core
