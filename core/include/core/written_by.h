// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "core/version.h"

namespace afm::core {

// The program and its version. Every report, table and file names them through this header, so that it can be cited.
inline std::string written_by() { return std::string("TouchAFM ") + kVersion; }

// Adds the program and its version to a report in JSON, an object.
template <class Json>
void name_software(Json& report) {
  report["software"] = "TouchAFM";
  report["software_version"] = kVersion;
}

// Adds the program and its version to a report in words, as its last line.
inline std::string with_software_line(std::string report) {
  return std::move(report) + "computed by " + written_by() + "\n";
}

}  // namespace afm::core
