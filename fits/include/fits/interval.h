// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::fits {

// 95 % interval, from the statistics only. A missing limit is 0 or infinite.
struct Interval {
  double low = 0, high = 0;
};

}  // namespace afm::fits
