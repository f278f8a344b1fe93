// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/models/height_colours.h"
#include "exhibit/words/phrases.h"
#include "physics/imaging/scanner.h"
#include "render/frame.h"

namespace afm::exhibit {

// An image of any size whose lines come from an instrument, for the wall's panel. SI. One thread.
class ServedImage {
 public:
  struct Size {
    std::size_t columns = 0, rows = 0;
    double width_m = 0, height_m = 0;
    double line_rate_hz = 0;
  };

  explicit ServedImage(const Size& size);

  // Ignores a line of another size.
  void add(const physics::ScanLine& line);

  // Height, error and lateral force, trace and retrace, with the newest line. Centres an image that is not square in a
  // square.
  render::ImagePanel panel(const std::string& sample, const Phrases& phrases) const;

 private:
  using Maps = std::array<std::vector<double>, 2>;  // trace, retrace; row by row from the top; NaN: not measured yet

  render::ColorGrid colored(const std::vector<double>& map, double low, double high, Srgb (*color)(double)) const;

  Size size_;
  Maps height_m_, error_n_, lateral_n_;
  std::optional<std::size_t> newest_row_;
};

}  // namespace afm::exhibit
