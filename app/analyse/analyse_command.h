// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.h"
#include "curves/curve_file.h"
#include "curves/fitting/curve_fit.h"
#include "physics/imaging/levelling.h"

namespace afm::app {

// Options of `touchafm analyse`; empty text: not given.
struct AnalyseOptions {
  std::string file;
  curves::CurveReading reading;                          // overrides the file's own settings
  std::optional<physics::ContactMethod> contact_method;  // method of finding the contact; empty: chosen from the curve
  physics::BaselineChoice baseline;
  std::string beside;  // second curve for comparison, measured or computed
  bool json = false;
  std::string out;  // SVG file of the curve, in addition to the text
  curves::FitOptions fit;
  int threads = 0;      // number of threads for a table of fits; 0: one per core
  std::string channel;  // name of an image's channel
  physics::Levelling levelling = physics::Levelling::Plane;
};

// Reads, analyses and compares a curve; prints the figures to stdout. For an image, recognised by its first bytes,
// prints size, channels and statistics.
core::Result<void> analyse_curve_file(const AnalyseOptions& options);

}  // namespace afm::app
