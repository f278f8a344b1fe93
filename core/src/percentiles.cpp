// SPDX-License-Identifier: Apache-2.0
#include "core/percentiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace afm::core {

namespace {

std::size_t rank(double fraction, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(count))) - 1);
}

}  // namespace

Percentiles percentiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) { return values[rank(fraction, values.size())]; };
  return {.p50 = at(0.5), .p99 = at(0.99), .p999 = at(0.999), .max = values.back()};
}

Percentiles percentiles(std::span<const std::uint32_t> bins, std::uint32_t max_us) {
  const std::uint64_t total = std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
  if (total == 0) return {};
  const auto at = [&](double fraction) {
    std::uint64_t seen = 0;
    const std::uint64_t wanted = rank(fraction, total) + 1;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      seen += bins[i];
      // the last bin holds all longer values, so only the maximum is known
      if (seen >= wanted) return i + 1 == bins.size() ? double(max_us) : std::min(double(max_us), double(i + 1));
    }
    return double(max_us);
  };
  return {.p50 = at(0.5), .p99 = at(0.99), .p999 = at(0.999), .max = double(max_us)};
}

}  // namespace afm::core
