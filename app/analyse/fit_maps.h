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

  // For a file with so many curves.
  explicit FitMaps(std::size_t curves) : curves_(curves) {}

  // A curve without a pixel is left out. The first one's grid is that of the maps; of two curves at one pixel the later
  // counts. write() logs how many are not on the maps.
  void add(const curves::FittedCurve& curve);

  // Writes FOLDER/NAME.gwy with those that have a value, and a picture of each, NAME-modulus.png and so on, NAME being
  // the file's without its ending. Colours go from the 1st to the 99th percentile; in maps of the fit, pixels that are
  // not trusted are striped. Nothing without a pixel, of a
  // single curve, or, with a line of the log, of a grid far larger than the number of curves. A name that exists gets a
  // number. Returns the PNG bytes of the modulus; empty if none is drawn. Failed names the path and the reason.
  core::Result<std::string> write(const std::string& folder, const std::string& file, const Texts& fitted_with) const;

 private:
  bool is_drawn() const;

  std::size_t curves_;
  std::size_t elsewhere_ = 0;  // curves on another grid
  std::size_t outside_ = 0;    // curves whose position is outside the grid
  std::size_t replaced_ = 0;   // curves whose pixel a later one has
  std::optional<curves::MapGrid> grid_;
  std::vector<Cell> cells_;   // row by row from the top
  std::vector<bool> filled_;  // cells with a curve
};

}  // namespace afm::app
