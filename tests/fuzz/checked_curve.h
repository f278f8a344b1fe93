// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "curves/curve_file.h"
#include "fuzz/accepted.h"
#include "physics/curve_analysis.h"

namespace afm::fuzz {

// Aborts unless the accepted curve has finite points, can be analysed or is refused as too small, and can be read back.
inline void check_curve(const curves::RecordedCurve& curve) {
  ++accepted_inputs;
  for (const auto& point : curve.points) {
    if (!isfinite(point.z) || !isfinite(point.force)) std::abort();
  }
  try {
    physics::analyse(curve.points);
  } catch (const std::invalid_argument&) {
    // too few points, or all at one height
  }
  const auto written = curves::curve_bytes(curves::CurveFormat::Tab, curve);
  if (!written || !curves::parse_curve(*written, "again")) std::abort();
}

}  // namespace afm::fuzz
