// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::core {

// English text for an errno value: "No such file or directory". Never null; lives as long as the program. Any thread.
const char* system_error(int error) noexcept;

}  // namespace afm::core
