// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "core/result.h"

namespace afm::app {

// What `touchafm analyse` was asked for; an empty text is an option that was not given.
struct AnalyseOptions {
  std::string file;
  std::string spring_constant;  // in place of the file's
  std::string sensitivity;      // "70nm/V"
  std::size_t index = 0;        // of the curve in the file
  std::string beside;           // another curve to compare with, measured or computed
  bool json = false;
  std::string out;  // an SVG of the curve, beside the text
};

// Reads, analyses, compares; prints the figures to stdout.
core::Result<void> analyse_curve_file(const AnalyseOptions& options);

}  // namespace afm::app
