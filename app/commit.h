// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::app {

// Name of the commit that was built: cmake/WriteCommit.cmake writes the definition, which only touchafm links.
extern const char* const kCommit;

}  // namespace afm::app
