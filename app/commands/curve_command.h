// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/options/contact_options.h"
#include "app/tapping/tapping_command.h"
#include "core/result.h"
#include "curves/curve_run.h"

namespace afm::app {

// Options of `touchafm curve`; empty text: not given.
struct CurveOptions {
  curves::ContactOptions contact;
  curves::PathOptions path;
  curves::TappingChoice tapping;
  std::vector<std::string> sweeps;  // text such as "key=from:to:count"
  bool json = false;
  // csv, json, svg or a word of curves::writable_formats(); empty: by the file extension of `out`, else csv
  std::string format;
  std::string out;      // output file; empty: stdout
  std::string overlay;  // measured curve, drawn over the model in an SVG
};

// Computes the curve or the sweep and writes it; nothing is written if anything fails.
core::Result<void> write_curve_command(const CurveOptions& options);

}  // namespace afm::app
