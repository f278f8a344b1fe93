// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scan_truth.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "physics/imaging/morphology.h"

namespace afm::physics {
namespace {

constexpr double kNoiseThresholds = 4.0;     // multiple of the rms that bounds the noise
constexpr double kRoundingOfHeight = 1e-15;  // rounding error of a height, m

HeightGrid height_of(const ScanImage& image) {
  HeightGrid grid;
  grid.columns = image.columns;
  grid.rows = image.rows;
  grid.column_step_m = image.width_m / static_cast<double>(image.columns);
  grid.row_step_m = -image.height_m / static_cast<double>(image.rows);
  grid.height_m = image.channels.front().values;
  return grid;
}

// The tip upside down, seen from above: the apex is 0, its flanks are below.
std::vector<double> drawn_tip(const TipGrid& tip, const ScanImage& image) {
  const double lowest = -*std::max_element(tip.above_apex_m.begin(), tip.above_apex_m.end());
  std::vector<double> values(image.columns * image.rows, lowest);
  const std::size_t left = image.columns / 2 - tip.reach_columns, top = image.rows / 2 - tip.reach_rows;
  for (std::size_t row = 0; row < tip.rows(); ++row) {
    for (std::size_t column = 0; column < tip.columns(); ++column) {
      values[(top + row) * image.columns + left + column] = 0.0 - tip.above_apex_m[row * tip.columns() + column];
    }
  }
  return values;
}

}  // namespace

void add_truth(const TipShape& tip, Length noise, ScanImage& image) {
  const HeightGrid height = height_of(image);
  const HeightGrid reconstruction = reconstruction_of(height, tip);
  const std::vector<std::uint8_t> certain =
      certainty_map(height, reconstruction, sample_tip(tip, height, height.range_m()), kRoundingOfHeight);
  // a place is used only if the image extends twice as far
  const auto reach = [](std::size_t count) { return std::min(kBlindReach, (count - 1) / 4); };
  const TipGrid blind = tip_of_image(height, reach(image.columns), reach(image.rows), kNoiseThresholds * noise.si);
  image.channels.push_back({"Reconstruction", "m", reconstruction.height_m});
  image.channels.push_back({"Certainty", "", {certain.begin(), certain.end()}});
  image.channels.push_back({"Tip from the image", "m", drawn_tip(blind, image)});
}

}  // namespace afm::physics
