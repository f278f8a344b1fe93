// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "core/whole_file.h"

namespace afm::support {

// Milliseconds between frames, from a file written by `touchafm view --frame-log`.
inline std::vector<double> intervals_ms(const std::string& frame_log) {
  std::vector<double> all;
  std::istringstream lines(core::read_file(frame_log).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    double interval_ms = 0;
    if (std::sscanf(line.c_str(), "%*d,%*f,%*f,%lf", &interval_ms) == 1) all.push_back(interval_ms);
  }
  return all;
}

}  // namespace afm::support
