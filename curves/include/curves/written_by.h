// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/version.h"

namespace afm::curves {

// The program and its version, which every file names.
inline std::string written_by() { return std::string("TouchAFM ") + core::kVersion; }

// Adds them to a report in JSON, for those who cite it.
template <class Json>
void name_software(Json& report) {
  report["software"] = "TouchAFM";
  report["software_version"] = core::kVersion;
}

}  // namespace afm::curves
