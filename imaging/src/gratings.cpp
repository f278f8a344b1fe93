// SPDX-License-Identifier: Apache-2.0
#include "gratings.h"

#include <cmath>
#include <cstddef>
#include <filesystem>

#include "imaging/scan_surface.h"

namespace afm::imaging {

bool is_gratings(const std::string& sample) {
  std::error_code ignored;
  return sample == kGratings && !std::filesystem::exists(sample, ignored);
}

physics::HeightGrid gratings() {
  constexpr std::size_t kPoints = 481;  // number of points along a side, 2.5 nm apart
  constexpr double kStepM = 2.5e-9, kBarM = 10e-9, kLeftPitchM = 200e-9, kRightPitchM = 100e-9;
  physics::HeightGrid grid;
  grid.columns = grid.rows = kPoints;
  grid.column_step_m = grid.row_step_m = kStepM;
  grid.x_first_m = grid.y_first_m = -0.5 * kStepM * static_cast<double>(kPoints - 1);
  for (std::size_t row = 0; row < kPoints; ++row) {
    for (std::size_t column = 0; column < kPoints; ++column) {
      const double x_m = grid.x_first_m + static_cast<double>(column) * kStepM;
      const double periods = x_m / (x_m < 0.0 ? kLeftPitchM : kRightPitchM);
      const double from_trench = std::abs(periods - std::round(periods));  // 0 in the middle of a trench, 0.5 of a bar
      grid.height_m.push_back(from_trench > 0.25 ? 0.5 * kBarM : -0.5 * kBarM);
    }
  }
  return grid;
}

}  // namespace afm::imaging
