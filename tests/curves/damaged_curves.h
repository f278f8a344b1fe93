// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>

#include "curves/curve_file.h"

namespace afm::test {

// Changes up to four bytes of the first `header` bytes of a file 6000 times, to digits, blanks or anything else, and
// reads curve 0 and curve `last` of it: all accepted values must be finite. Returns the number of accepted files.
inline int read_after_damage(const std::string& file, std::size_t header, std::size_t last) {
  std::mt19937 random(19);
  int read = 0;
  for (int run = 0; run < 6000; ++run) {
    std::string bytes = file;
    for (auto changes = 1 + random() % 4; changes > 0; --changes) {
      const char digit = "0123456789-.e"[random() % 13];
      bytes[random() % header] = random() % 4 != 0 ? digit : static_cast<char>(random());
    }
    for (const std::size_t index : {std::size_t{0}, last}) {
      curves::CurveReading here;
      here.index = index;
      here.confined = false;
      const auto curve = curves::parse_curve(bytes, "damaged.x", here);
      if (!curve) continue;
      ++read;
      for (const auto& point : curve->points) EXPECT_TRUE(isfinite(point.z) && isfinite(point.force));
      const auto& pixel = curve->metadata.pixel;
      EXPECT_TRUE(!pixel || (pixel->column < pixel->grid.columns && pixel->row < pixel->grid.rows));
    }
  }
  return read;
}

}  // namespace afm::test
