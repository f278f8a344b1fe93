// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::core {

// Reads a whole file, bytes unchanged, at most 1 GiB. BadInputFile names the path and the reason. Folders, devices and
// pipes are errors and never block.
core::Result<std::string> read_file(const std::string& path);

// Like read_file(), but returns only the first `most` bytes of a file of any size.
Result<std::string> read_beginning(const std::string& path, std::size_t most);

// Replaces a regular file as a whole: the new contents stay in a temporary file in the same folder until they are on
// the disk. The file keeps its permissions, and links to it stay links. Devices and pipes are written directly; a
// pipe's reader has 5 s to open it. Failed names the path and the reason; no partial file is left.
core::Result<void> write_file(const std::string& path, std::string_view bytes);

// Checks before long work that write_file() would find a folder and write permission. Changes nothing.
Result<void> check_writable(const std::string& path);

// Kind of a path that is no regular file: "a folder", "a pipe", "a socket" or "a device"; otherwise empty.
std::string kind_of_no_file(const std::string& path);

}  // namespace afm::core
