// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"

namespace afm::core {

// The whole file, bytes unchanged, at most 1 GiB. BadInputFile names the path and the reason; a folder, a device or a
// pipe is none, and is not waited for.
core::Result<std::string> read_file(const std::string& path);

// As read_file(), but no more than the first `most` bytes of a file of any size.
Result<std::string> read_beginning(const std::string& path, std::size_t most);

// Replaces a regular file as a whole: the new contents stay in a temporary file in the same folder until they are on
// the disk. It keeps its permissions, and links to it stay links. Devices and pipes are written into; a pipe's reader
// is waited for 5 s. Failed names the path and the reason; nothing partial is left.
core::Result<void> write_file(const std::string& path, std::string_view bytes);

// Before long work: whether write_file() would find a folder and the rights to write there. Changes nothing.
Result<void> check_writable(const std::string& path);

// "a folder", "a pipe", "a socket" or "a device"; empty for a regular file and for nothing.
std::string kind_of_no_file(const std::string& path);

}  // namespace afm::core
