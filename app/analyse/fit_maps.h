// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/analyse/fit_pool.h"
#include "core/result.h"
#include "curves/recorded_curve.h"

namespace afm::app {

// Maps of the fits of one file's curves: modulus, height of contact, depth, adhesion and trust.
class FitMaps {
 public:
  // A curve without a pixel is left out. The first one's grid is that of the maps.
  void add(const FittedCurve& curve);

  // Writes FOLDER/NAME.gwy with all of them, and a picture of each that has a value, NAME-modulus.png and so on, NAME
  // being the file's without its ending. Colours go from the 1st to the 99th percentile; pixels whose fit is not
  // trusted are hatched. Nothing without a pixel.
  // A name that exists gets a number. Failed names the path and the reason.
  core::Result<void> write(const std::string& folder, const std::string& file) const;

 private:
  struct Cell {
    std::optional<double> modulus_pa, contact_m, depth_m, adhesion_n;
    std::optional<fits::Trust> trust;
  };

  std::optional<curves::MapGrid> grid_;
  std::vector<Cell> cells_;  // row by row from the top
};

}  // namespace afm::app
