// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_relief.h"

#include "scan/image_maps.h"

namespace afm::exhibit {

HeightRelief relief_of(const LiveScan& scan) {
  static_assert(LiveScan::kPixels == kReliefSide);
  const ScanMaps& maps = scan.maps();
  // a painting hand's second map is another quantity
  const Range heights = at_least(
      scan.is_painted() ? range_of(maps.height_m[0]) : range_of(maps.height_m[0], maps.height_m[1]), kLeastRangeM);
  const ScanSubject& subject = scan.subject();
  return relief_of(maps.height_m[0], subject.side_m,
                   {.low_m = heights.low,
                    .high_m = heights.high,
                    .lateral = subject.shown.lateral,
                    .vertical = subject.shown.vertical});
}

}  // namespace afm::exhibit
