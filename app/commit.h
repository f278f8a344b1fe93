// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::app {

// The commit that was built, in words: cmake/WriteCommit.cmake writes the definition, which is linked to touchafm
// alone.
extern const char* const kCommit;

}  // namespace afm::app
