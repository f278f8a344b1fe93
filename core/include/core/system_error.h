// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::core {

// What an errno value means, in English: "No such file or directory". Never null; lives as long as the program. Any
// thread.
const char* system_error(int error) noexcept;

}  // namespace afm::core
