// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::core {

extern const char* const kVersion;  // project version in CMakeLists.txt

}  // namespace afm::core
