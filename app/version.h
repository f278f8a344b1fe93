// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::app {

inline constexpr const char* kVersion = AFM_VERSION;  // of the project() in CMakeLists.txt

}  // namespace afm::app
