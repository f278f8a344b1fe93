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

// Percentiles of a histogram with 1 us bins, in microseconds: the upper edge of the percentile's bin, or the maximum if
// that is less.
Percentiles percentiles(std::span<const std::uint32_t> bins, std::uint32_t max_us);

}  // namespace afm::core
