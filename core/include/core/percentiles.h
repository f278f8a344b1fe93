// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace afm::core {

struct Percentiles {
  double p50 = 0, p99 = 0, p999 = 0, max = 0;
};

Percentiles percentiles(std::vector<double> values);

// Of a histogram of 1 us bins, microseconds: the upper edge of the bin that the percentile falls into, or the maximum
// if that is less.
Percentiles percentiles(std::span<const std::uint32_t> bins, std::uint32_t max_us);

}  // namespace afm::core
