// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/result.h"

namespace afm::scene {

// A fault in a TOML file, thrown by whoever reads a key and turned into an Error by read_toml; never leaves the folder
// that reads.
struct Fault {
  toml::source_region where;
  std::string key;
  std::string what;
};

// Parses the file and hands its root to `read`, which throws Faults. The error names `kind` ("wall file"), path, line
// and key.
template <class Read>
auto read_toml(const char* kind, const std::string& path, const Read& read)
    -> core::Result<decltype(read(toml::table()))> {
  const auto bad = [&](const std::string& what) {
    return core::failure(core::ErrorCategory::BadInputFile, fmt::format("{} {}: {}", kind, path, what));
  };
  try {
    return read(toml::parse_file(path));
  } catch (const Fault& fault) {
    return bad(
        fmt::format("line {}: {}: {}", std::max<std::uint32_t>(1, fault.where.begin.line), fault.key, fault.what));
  } catch (const toml::parse_error& error) {
    if (error.source().begin.line == 0) return bad("cannot be read; check the path and its rights");
    return bad(fmt::format("line {}: {}", error.source().begin.line, error.description()));
  }
}

}  // namespace afm::scene
