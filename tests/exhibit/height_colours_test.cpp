// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/height_colours.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace afm::exhibit {
namespace height_colours_test {

using Linear = std::array<double, 3>;

Linear linear(const Srgb& colour) {
  Linear light{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double s = colour[i] / 255.0;
    light[i] = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
  }
  return light;
}

// L* of CIELAB under D65.
double lightness(const Linear& light) {
  const double y = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
  return 116.0 * std::cbrt(y) - 16.0;
}

// Colours as seen without one kind of cone (Machado, Oliveira and Fernandes, IEEE TVCG 15, 1291 (2009), severity 1).
using Simulation = std::array<Linear, 3>;
constexpr Simulation kProtanopia{
    {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
constexpr Simulation kDeuteranopia{
    {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
constexpr Simulation kTritanopia{
    {{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}};

Linear seen(const Simulation& eye, const Linear& light) {
  Linear out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) out[i] += eye[i][k] * light[k];
  }
  return out;
}

TEST(HeightColours, GrowEvenlyLighterWithHeight) {
  for (int i = 0; i <= 64; ++i) {
    const double height = i / 64.0;
    EXPECT_NEAR(lightness(linear(height_colour(height))), 16.0 + 79.0 * height, 0.7) << height;
  }
}

TEST(HeightColours, StayInOrderWithoutOneKindOfCone) {
  for (const Simulation& eye : {kProtanopia, kDeuteranopia, kTritanopia}) {
    double before = -1.0;
    for (int i = 0; i <= 32; ++i) {
      const double now = lightness(seen(eye, linear(height_colour(i / 32.0))));
      EXPECT_GT(now, before + 0.8) << i;
      before = now;
    }
  }
}

TEST(HeightColours, EndWhereTheScaleEnds) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(height_colour(-kInfinity), kHeightColours.front());
  EXPECT_EQ(height_colour(0.0), kHeightColours.front());
  EXPECT_EQ(height_colour(1.0), kHeightColours.back());
  EXPECT_EQ(height_colour(kInfinity), kHeightColours.back());
  EXPECT_EQ(height_colour(std::numeric_limits<double>::quiet_NaN()), kNoHeightColour);
}

}  // namespace height_colours_test
}  // namespace afm::exhibit
