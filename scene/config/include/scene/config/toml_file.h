// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <string>
#include <utility>

#include "core/result.h"

namespace afm::scene {

// A fault in a TOML file, thrown while reading a key and turned into an Error by read_toml; never leaves the folder
// that reads.
struct Fault {
  toml::source_region where;
  std::string key;
  std::string what;
};

// The root of the file, of at most 4 MiB and with keys of at most 16 parts. The error names `kind` ("wall file"), path
// and line.
core::Result<toml::table> parse_toml(const char* kind, const std::string& path);

// Same as above; also names the key at fault.
core::Error toml_error(const char* kind, const std::string& path, const Fault& fault);

// Parses the file and hands its root to `read`, which throws Faults.
template <class Read>
auto read_toml(const char* kind, const std::string& path, const Read& read)
    -> core::Result<decltype(read(toml::table()))> {
  auto root = parse_toml(kind, path);
  if (!root) return tl::unexpected(root.error());
  try {
    return read(std::move(*root));
  } catch (const Fault& fault) {
    return tl::unexpected(toml_error(kind, path, fault));
  }
}

}  // namespace afm::scene
