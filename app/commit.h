// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::app {

// Hash of the commit that was built, defined by cmake/WriteCommit.cmake. Only touchafm links the definition.
extern const char* const kCommit;

}  // namespace afm::app
