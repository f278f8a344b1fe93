// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "core/result.h"

namespace afm::app {

// Writes a result to stdout, all of it; the error says why it could not, as when the reader of a pipe has gone.
core::Result<void> write_stdout(std::string_view text);

}  // namespace afm::app
