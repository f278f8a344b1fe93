// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "support/archives/jpk_map.h"
#include "support/samples/recorded_cycles.h"

namespace afm::test {

// Curve number `index` of a hard sample that snaps in and tears off; from curve to curve the sample is 10 nm higher
// and all forces are a tenth stronger.
inline curves::RecordedCurve sticky_curve(std::size_t index) {
  constexpr double kRiseM = 10e-9, kStronger = 0.1;
  curves::RecordedCurve curve;
  curve.points = hard_sample();
  for (auto& point : curve.points) {
    point.z = point.z + physics::Length(static_cast<double>(index) * kRiseM);
    point.force = (1.0 + kStronger * static_cast<double>(index)) * point.force;
  }
  curve.metadata.spring_constant = physics::Stiffness(0.55);
  return curve;
}

// A map of these curves in which curve 2, at the right end of the lower row, is cut short.
inline std::map<std::string, std::string> holed_map() {
  auto entries = jpk_map(sticky_curve);
  entries["index/2/segments/1/channels/vDeflection.dat"].pop_back();
  return entries;
}

}  // namespace afm::test
