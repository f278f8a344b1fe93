// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "curves/image_file.h"

namespace afm::test {

// Changes up to four bytes of each file 3000 times, sometimes cutting it, and reads it: every accepted file must be a
// whole image. Returns the number of accepted files.
inline int read_after_damage(const std::vector<std::string>& files) {
  std::mt19937 random(19);
  int read = 0;
  for (const std::string& file : files) {
    for (int run = 0; run < 3000; ++run) {
      std::string bytes = file;
      for (auto changes = 1 + random() % 4; changes > 0; --changes) {
        bytes[random() % bytes.size()] = static_cast<char>(random() % 3 == 0 ? 0xff : random());
      }
      if (random() % 8 == 0) bytes.resize(random() % bytes.size());
      const auto image = curves::parse_image(bytes, "scan.x", {.channel = {}, .confined = false});
      if (!image) continue;
      ++read;
      const auto& channels = image->image.channels;
      EXPECT_LT(image->chosen, channels.size());
      for (const auto& channel : channels) {
        EXPECT_EQ(channel.values.size(), image->image.columns * image->image.rows);
        for (const double value : channel.values) EXPECT_FALSE(std::isinf(value));
      }
    }
  }
  return read;
}

}  // namespace afm::test
