// SPDX-License-Identifier: Apache-2.0
#include "scan/image_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "exhibit/scenery/wall_marks.h"

namespace afm::exhibit {

namespace {

constexpr double kOutliers = 0.003;  // share of all values at each end, so that spikes do not narrow the colour range

// Largest unit in which the side is at least 1.
struct SideUnit {
  double m;
  const char* name;
};
SideUnit side_unit(double side_m) { return side_m < 1e-6 ? SideUnit{1e-9, "nm"} : SideUnit{1e-6, "\u00b5m"}; }

}  // namespace

Range range_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> values;
  values.reserve(a.size() + b.size());
  for (const auto* map : {&a, &b}) {
    std::copy_if(map->begin(), map->end(), std::back_inserter(values), [](double v) { return std::isfinite(v); });
  }
  if (values.empty()) return {};
  const auto cut = static_cast<std::ptrdiff_t>(kOutliers * static_cast<double>(values.size()));
  const auto low = values.begin() + cut, high = values.end() - 1 - cut;
  std::nth_element(values.begin(), low, values.end());
  const double lowest = *low;
  std::nth_element(values.begin(), high, values.end());
  return {lowest, *high, false};
}

Range at_least(Range range, double width) {
  if (range.high - range.low >= width) return range;
  return {range.middle() - 0.5 * width, range.middle() + 0.5 * width, range.empty};
}

Srgb grey(double zero_to_one) {
  const auto level = static_cast<std::uint8_t>(std::lround(28.0 + 210.0 * std::clamp(zero_to_one, 0.0, 1.0)));
  return {level, level, level};
}

std::string nanonewtons(const Range& range) { return fmt::format("{:.2g}", 0.5e9 * (range.high - range.low)); }

std::string side_text(double side_m) {
  const SideUnit unit = side_unit(side_m);
  return fmt::format("{:.3g} {}", side_m / unit.m, unit.name);
}

void show_side(double side_m, render::ImagePanel& panel) {
  const SideUnit unit = side_unit(side_m);
  panel.side_unit = unit.name;
  panel.side = side_m / unit.m;
  panel.scale_bar = scale_bar(panel.side, 0.30).length_m;
}

void show_heights(double high_nm, render::ImagePanel& panel) {
  panel.bar_low_nm = 0.0;
  panel.bar_high_nm = high_nm;
  for (const Srgb& c : kHeightColours) panel.bar.push_back(glm::vec3(c[0], c[1], c[2]) / 255.0F);
}

}  // namespace afm::exhibit
