// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/scan_truth.h"

#include <algorithm>
#include <cmath>

#include "physics/imaging/morphology.h"

namespace afm::exhibit {

namespace {

constexpr double kMarginShare = 0.125;  // width of the rim relative to the side
constexpr double kSeenGap = 0.02;       // smallest gap shown, relative to the sample's range
constexpr std::size_t kReach = 8;       // half width of the estimated tip in points of the coarser grid
constexpr double kSureOfNoise = 4.0;    // in units of the noise

}  // namespace

ReachOfTip reach_of_tip(const std::function<double(double x_m, double y_m)>& drawn_m, double side_m, std::size_t pixels,
                        double tip_radius_m) {
  const double step_m = side_m / static_cast<double>(pixels);
  const auto margin = static_cast<std::size_t>(kMarginShare * static_cast<double>(pixels));
  const std::size_t side = pixels + 2 * margin;
  const double first_m = 0.5 * step_m - 0.5 * side_m - static_cast<double>(margin) * step_m;
  physics::HeightGrid wide{.columns = side,
                           .rows = side,
                           .x_first_m = first_m,
                           .y_first_m = -first_m,
                           .column_step_m = step_m,
                           .row_step_m = -step_m,
                           .height_m = {}};
  wide.height_m.reserve(side * side);
  for (std::size_t row = 0; row < side; ++row) {
    for (std::size_t column = 0; column < side; ++column) {
      wide.height_m.push_back(
          drawn_m(first_m + static_cast<double>(column) * step_m, -first_m - static_cast<double>(row) * step_m));
    }
  }
  physics::HeightGrid closed = wide;
  physics::dilate_by_paraboloid(closed, physics::Length(tip_radius_m));
  physics::erode_by_paraboloid(closed, physics::Length(tip_radius_m));

  ReachOfTip reach;
  reach.sample = {.columns = pixels,
                  .rows = pixels,
                  .x_first_m = first_m + static_cast<double>(margin) * step_m,
                  .y_first_m = -first_m - static_cast<double>(margin) * step_m,
                  .column_step_m = step_m,
                  .row_step_m = -step_m,
                  .height_m = {}};
  const double gap_m = kSeenGap * wide.range_m();
  for (std::size_t row = margin; row < margin + pixels; ++row) {
    for (std::size_t column = margin; column < margin + pixels; ++column) {
      reach.sample.height_m.push_back(wide.at(column, row));
      reach.unreached.push_back(closed.at(column, row) - wide.at(column, row) > gap_m ? 1 : 0);
    }
  }
  const auto count = std::count(reach.unreached.begin(), reach.unreached.end(), 1);
  reach.unreached_share = static_cast<double>(count) / static_cast<double>(reach.unreached.size());
  return reach;
}

TipProfile tip_revealed_by(const physics::HeightGrid& image, double noise_m) {
  physics::HeightGrid coarse = image;
  coarse.columns = image.columns / 2;
  coarse.rows = image.rows / 2;
  coarse.column_step_m = 2.0 * image.column_step_m;
  coarse.row_step_m = 2.0 * image.row_step_m;
  coarse.height_m.clear();
  for (std::size_t row = 0; row < coarse.rows; ++row) {
    for (std::size_t column = 0; column < coarse.columns; ++column) {
      coarse.height_m.push_back(image.at(2 * column, 2 * row));
    }
  }
  const physics::TipGrid tip = physics::tip_of_image(coarse, kReach, kReach, kSureOfNoise * noise_m);
  TipProfile profile;
  for (std::size_t column = 0; column < tip.columns(); ++column) {
    const double above_m = tip.above_apex_m[tip.reach_rows * tip.columns() + column];
    if (!std::isfinite(above_m)) continue;
    const double beside = static_cast<double>(column) - static_cast<double>(tip.reach_columns);
    profile.points_m.emplace_back(beside * coarse.column_step_m, above_m);
  }
  return profile;
}

TipProfile round_tip(double radius_m, double reach_m) {
  constexpr int kPoints = 33;
  TipProfile profile;
  for (int i = 0; i < kPoints; ++i) {
    const double x_m = reach_m * (2.0 * i / (kPoints - 1) - 1.0);
    profile.points_m.emplace_back(x_m, x_m * x_m / (2.0 * radius_m));
  }
  return profile;
}

}  // namespace afm::exhibit
