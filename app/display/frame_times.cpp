// SPDX-License-Identifier: Apache-2.0
#include "app/display/frame_times.h"
#include "core/percentiles.h"

#include <fmt/format.h>

#include <algorithm>

namespace afm::app {

void FrameTimes::shown(std::int64_t now_ns) {
  if (last_ns_ >= 0) {
    const std::int64_t time_ns = now_ns - last_ns_;
    ++bins_[std::min(static_cast<std::size_t>(time_ns / kBinNs), bins_.size() - 1)];
    longest_ns_ = std::max(longest_ns_, time_ns);
    total_ns_ += time_ns;
    ++times_;
  }
  last_ns_ = now_ns;
  ++frames_;
}

void FrameTimes::hidden() { last_ns_ = -1; }

std::string FrameTimes::text() const {
  if (times_ == 0) return {};
  // the upper edge of the bin
  const double longest_ms = static_cast<double>(longest_ns_) * 1e-6;
  const auto ms = [&](double bins) { return std::min(bins * static_cast<double>(kBinNs) * 1e-6, longest_ms); };
  const core::Percentiles bins = core::percentiles(bins_, static_cast<std::uint32_t>(longest_ns_ / kBinNs + 1));
  return fmt::format(
      "picture: {} frames, {:.1f} per second; interval p50 {:.1f}, p99 {:.1f}, p99.9 {:.1f}, max {:.1f} ms", frames_,
      1e9 * static_cast<double>(times_) / static_cast<double>(total_ns_), ms(bins.p50), ms(bins.p99), ms(bins.p999),
      longest_ms);
}

}  // namespace afm::app
