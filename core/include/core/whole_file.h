// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::core {

// The whole file, bytes unchanged, at most 1 GiB. BadInputFile names the path and the reason; a folder, a device or a
// pipe is none, and is not waited for.
core::Result<std::string> read_file(const std::string& path);

// Replaces a regular file as a whole: the new contents stay in a temporary file in the same folder until they are on
// the disk. It keeps its permissions, and links to it stay links. Devices and pipes are written into; a pipe's reader
// is waited for 5 s. Failed names the path and the reason; nothing partial is left.
core::Result<void> write_file(const std::string& path, std::string_view bytes);

}  // namespace afm::core
