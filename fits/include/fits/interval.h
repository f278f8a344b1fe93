// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::fits {

// Interval of 95 %, of the statistics alone. A limit that was not found is 0 or infinite.
struct Interval {
  double low = 0, high = 0;
};

}  // namespace afm::fits
