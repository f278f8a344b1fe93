// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "curves/fitting/fitted_curve.h"
#include "curves/recorded_curve.h"

namespace afm::app {

// Maps of the fits of one file's curves: modulus, height of contact, depth, work of adhesion, adhesion and trust.
class FitMaps {
 public:
  // Values of one pixel.
  struct Cell {
    std::optional<double> modulus_pa, contact_m, depth_m, work_j_per_m2, adhesion_n;
    std::optional<fits::Trust> trust;
  };

  // Keys and values of the fit, which picture and image files keep.
  using Texts = std::vector<std::pair<std::string, std::string>>;

  // Maps for a file with `curves` curves.
  explicit FitMaps(std::size_t curves) : curves_(curves) {}

  // Adds a curve; ignores one without a pixel. The maps have the first curve's grid; of two curves at one pixel
  // the later one counts. write() logs how many are not on the maps.
  void add(const curves::FittedCurve& curve);

  // Writes FOLDER/NAME.gwy with all maps that have a value, and a picture of each, NAME-modulus.png and so on; NAME is
  // the file's name without its ending. Colours go from the 1st to the 99th percentile; in maps of the fit, untrusted
  // pixels are striped. No effect without pixels, for a
  // single curve, or, with a line in the log, for a grid far larger than the number of curves. An existing name gets a
  // number. Returns the PNG bytes of the modulus; empty if none is drawn. Failed names the path and the reason.
  core::Result<std::string> write(const std::string& folder, const std::string& file, const Texts& fitted_with) const;

 private:
  bool is_drawn() const;

  std::size_t curves_;
  std::size_t elsewhere_ = 0;  // curves on another grid
  std::size_t outside_ = 0;    // curves whose position is outside the grid
  std::size_t replaced_ = 0;   // curves replaced by a later one at the same pixel
  std::optional<curves::MapGrid> grid_;
  std::vector<Cell> cells_;   // cells row by row from the top
  std::vector<bool> filled_;  // true: cell with a curve
};

}  // namespace afm::app
