// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::core {

// The whole file, bytes unchanged. BadInputFile names the path and the reason.
core::Result<std::string> read_file(const std::string& path);

// Writes a temporary file beside `path` and renames it, so that a file of that name is always whole. The error names
// the path and the reason.
core::Result<void> write_file(const std::string& path, std::string_view bytes);

}  // namespace afm::core
