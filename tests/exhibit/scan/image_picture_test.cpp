// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/image_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>

#include "exhibit/models/height_colours.h"

namespace image_picture_test {

using namespace afm;
using Color = std::array<std::uint8_t, 3>;

Color pixel(const render::Image& picture, std::size_t x, std::size_t y) {
  const std::size_t i = 4 * (y * picture.width + x);
  return {picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]};
}

TEST(ImagePicture, ShowsRowsFromTheTopOverTheirWholeRange) {
  physics::ScanImage image;
  image.columns = image.rows = 2;
  image.width_m = image.height_m = 90e-9;
  image.channels = {{"Height", "m", {-1e-9, 3e-9, std::numeric_limits<double>::quiet_NaN(), 1e-9}}};
  const render::Image picture = exhibit::picture_of(image, 0);
  ASSERT_EQ(picture.rgba.size(), std::size_t{4} * picture.width * picture.height);
  EXPECT_EQ(pixel(picture, 20, 20), exhibit::height_colour(0.0));
  EXPECT_EQ(pixel(picture, 220, 20), exhibit::height_colour(1.0));
  EXPECT_EQ(pixel(picture, 220, 220), exhibit::height_colour(0.5));
  EXPECT_NE(pixel(picture, 20, 220), exhibit::height_colour(0.0)) << "what was not measured is not low";
  EXPECT_EQ(pixel(picture, 0, 0), (Color{24, 26, 30})) << "the image lies on dark paper";
  // a bar of 20 nm is 56 of 256 pixels long
  const std::size_t below = 12 + 256 + 8;
  EXPECT_EQ(pixel(picture, 12, below), pixel(picture, 12 + 55, below));
  EXPECT_NE(pixel(picture, 12, below), pixel(picture, 12 + 57, below));
}

}  // namespace image_picture_test
