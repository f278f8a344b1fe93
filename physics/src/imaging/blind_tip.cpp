// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "physics/imaging/morphology.h"

namespace afm::physics {
namespace {

// Villarrubia's algorithm on P(d) = -T(-d); memory of the window's size.
class BlindTip {
 public:
  BlindTip(const HeightGrid& image, std::size_t reach_columns, std::size_t reach_rows, double threshold_m)
      : image_(image), reach_x_(reach_columns), reach_y_(reach_rows), threshold_m_(threshold_m) {
    bound_m_.assign((2 * reach_x_ + 1) * (2 * reach_y_ + 1), 0.0);
    for (std::size_t v = 0; v <= 2 * reach_y_; ++v) {
      for (std::size_t u = 0; u <= 2 * reach_x_; ++u) offset_.push_back(offset_of(u, v));
    }
    touching_.reserve(bound_m_.size());
  }

  // Peaks first, as they contain most information; then every point, until none changes the result.
  void refine() {
    refine_at([this](std::size_t pixel) { return is_peak(pixel); });
    refine_at([](std::size_t) { return true; });
  }

  TipGrid tip() const {
    TipGrid tip{reach_x_, reach_y_, std::vector<double>(bound_m_.size())};
    for (std::size_t i = 0; i < bound_m_.size(); ++i) tip.above_apex_m[i] = 0.0 - bound_m_[bound_m_.size() - 1 - i];
    return tip;
  }

 private:
  std::ptrdiff_t offset_of(std::size_t u, std::size_t v) const {
    return (static_cast<std::ptrdiff_t>(v) - static_cast<std::ptrdiff_t>(reach_y_)) *
               static_cast<std::ptrdiff_t>(image_.columns) +
           static_cast<std::ptrdiff_t>(u) - static_cast<std::ptrdiff_t>(reach_x_);
  }

  double image_m(std::size_t pixel, std::ptrdiff_t offset) const {
    return image_.height_m[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(pixel) + offset)];
  }

  // Returns whether no neighbouring pixel is higher.
  bool is_peak(std::size_t pixel) const {
    const auto columns = static_cast<std::ptrdiff_t>(reach_y_ > 0 ? image_.columns : 0);
    for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, columns, columns + 1, columns - 1}) {
      if (image_m(pixel, step) > image_.height_m[pixel] || image_m(pixel, -step) > image_.height_m[pixel]) return false;
    }
    return true;
  }

  // Finds positions of the tip that, as far as is known, may have touched the surface at the pixel.
  void find_touching(std::size_t pixel) {
    touching_.clear();
    const double here_m = image_.height_m[pixel];
    for (std::size_t d = 0; d < bound_m_.size(); ++d) {
      if (here_m - image_m(pixel, -offset_[d]) <= bound_m_[d]) touching_.push_back(d);
    }
  }

  bool refine_at(std::size_t pixel) {
    find_touching(pixel);
    bool changed = false;
    const double here_m = image_.height_m[pixel];
    for (std::size_t u = 0; u < bound_m_.size(); ++u) {
      const double enough_m = bound_m_[u] - threshold_m_;
      double highest_m = -std::numeric_limits<double>::infinity();
      for (const std::size_t d : touching_) {
        highest_m = std::max(highest_m, image_m(pixel, offset_[u] - offset_[d]) + bound_m_[d] - here_m);
        if (highest_m >= enough_m) break;
      }
      if (touching_.empty() || highest_m >= enough_m) continue;
      bound_m_[u] = highest_m + threshold_m_;
      changed = true;
    }
    return changed;
  }

  template <class Chosen>
  void refine_at(const Chosen& chosen) {
    // a peak needs neighbours in its line
    const std::size_t margin_x = std::max<std::size_t>(2 * reach_x_, 1), margin_y = 2 * reach_y_;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t row = margin_y; row + margin_y < image_.rows; ++row) {
        for (std::size_t column = margin_x; column + margin_x < image_.columns; ++column) {
          const std::size_t pixel = row * image_.columns + column;
          if (chosen(pixel) && refine_at(pixel)) changed = true;
        }
      }
    }
  }

  const HeightGrid& image_;
  std::size_t reach_x_, reach_y_;
  double threshold_m_;
  std::vector<double> bound_m_;         // upper bound of P, row by row
  std::vector<std::ptrdiff_t> offset_;  // offset of each tip position, in pixels of the image
  std::vector<std::size_t> touching_;
};

}  // namespace

TipGrid tip_of_image(const HeightGrid& image, std::size_t reach_columns, std::size_t reach_rows, double threshold_m) {
  BlindTip blind(image, reach_columns, reach_rows, threshold_m);
  blind.refine();
  return blind.tip();
}

}  // namespace afm::physics
