// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "exhibit/models/height_colours.h"
#include "render/frame.h"

namespace afm::exhibit {

// Parts common to the panels of all images.

inline constexpr glm::vec3 kTraceColor{0.337F, 0.706F, 0.914F}, kRetraceColor{0.902F, 0.624F, 0.0F};
inline constexpr double kLeastRangeM = 0.2e-9;   // smallest range of the colours: a flat sample does not look rough
inline constexpr double kLeastForceN = 0.05e-9;  // smallest range of the forces' shades

struct Range {
  double low = 0, high = 0;
  bool empty = true;

  double middle() const { return 0.5 * (low + high); }
};

// Range of the measured values without outliers.
Range range_of(const std::vector<double>& a, const std::vector<double>& b = {});
Range at_least(Range range, double width);

Srgb grey(double zero_to_one);

// Half a range in nanonewtons, for a panel's title.
std::string nanonewtons(const Range& range);

// Length of a side as text: "500 nm".
std::string side_text(double side_m);

// Side and scale bar of the square; colour bar of the heights.
void show_side(double side_m, render::ImagePanel& panel);
void show_heights(double high_nm, render::ImagePanel& panel);

}  // namespace afm::exhibit
