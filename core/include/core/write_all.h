// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace afm::core {

// All of `bytes`, however many calls that takes. 0, or errno. Any thread; allocates nothing.
int write_all(int descriptor, std::string_view bytes) noexcept;

}  // namespace afm::core
