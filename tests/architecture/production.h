// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <sstream>
#include <string>

#include "core/whole_file.h"
#include "support/places.h"

namespace afm::support {

// Top folders of production code: those with a row in tests/architecture/include_rules.cmake, which demands one of
// each.
inline std::set<std::string> production_folders() {
  const std::string row = "set(arrows_";
  std::set<std::string> folders;
  std::istringstream lines(core::read_file(source("tests/architecture/include_rules.cmake")).value());
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(row)) folders.insert(line.substr(row.size(), line.find_first_of(" /") - row.size()));
  }
  return folders;
}

}  // namespace afm::support
