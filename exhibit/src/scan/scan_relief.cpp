// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_relief.h"

#include <vector>

#include "scan/image_maps.h"

namespace afm::exhibit {

namespace {

HeightRelief laid_on(const std::vector<double>& height_m, const Range& colours, const ScanSubject& subject) {
  const Range wide = at_least(colours, kLeastRangeM);
  return relief_of(
      height_m, subject.side_m,
      {.low_m = wide.low, .high_m = wide.high, .lateral = subject.shown.lateral, .vertical = subject.shown.vertical});
}

}  // namespace

HeightRelief relief_of(const LiveScan& scan) {
  static_assert(LiveScan::kPixels == kReliefSide);
  const ScanMaps& maps = scan.maps();
  // a painting hand's second map is another quantity
  const Range heights = scan.is_painted() ? range_of(maps.height_m[0]) : range_of(maps.height_m[0], maps.height_m[1]);
  return laid_on(maps.height_m[0], heights, scan.subject());
}

HeightRelief relief_of(const ScanSubject& subject) {
  std::vector<double> height_m;
  height_m.reserve(kReliefSide * kReliefSide);
  const auto middle_m = [&](std::size_t cell) {
    return ((static_cast<double>(cell) + 0.5) / kReliefSide - 0.5) * subject.side_m;
  };
  for (std::size_t row = 0; row < kReliefSide; ++row) {
    for (std::size_t column = 0; column < kReliefSide; ++column) {
      height_m.push_back(subject.drawn_m(middle_m(column), -middle_m(row)));
    }
  }
  return laid_on(height_m, range_of(height_m), subject);
}

}  // namespace afm::exhibit
