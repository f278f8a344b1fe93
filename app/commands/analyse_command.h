// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.h"
#include "curves/curve_file.h"
#include "physics/imaging/levelling.h"

namespace afm::app {

// Options of `touchafm analyse`; empty text: not given.
struct AnalyseOptions {
  std::string file;
  curves::CurveReading reading;                          // in place of what the file says
  std::optional<physics::ContactMethod> contact_method;  // none: by the curve
  std::string beside;                                    // another curve to compare with, measured or computed
  bool json = false;
  std::string out;      // an SVG of the curve, beside the text
  std::string channel;  // of an image
  physics::Levelling levelling = physics::Levelling::Plane;
};

// "70nm/V" in metres per volt. WrongUsage: another text, or not positive.
core::Result<double> parse_sensitivity(std::string_view text);

// Reads, analyses, compares; prints the figures to stdout. Of an image, by the file's first bytes: size, channels and
// statistics.
core::Result<void> analyse_curve_file(const AnalyseOptions& options);

}  // namespace afm::app
