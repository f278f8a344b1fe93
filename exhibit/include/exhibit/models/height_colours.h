// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace afm::exhibit {

using Srgb = std::array<std::uint8_t, 3>;

// False colours of heights, from the lowest to the highest: plum, copper, gold, cream. Evenly spaced in CIELAB
// lightness L*, 16 to 95, so that equal steps of height look equal, and viewers with colour blindness see the order.
inline constexpr std::array<Srgb, 17> kHeightColours{{{44, 35, 65},
                                                      {71, 38, 74},
                                                      {98, 41, 76},
                                                      {124, 44, 73},
                                                      {147, 50, 69},
                                                      {167, 59, 64},
                                                      {184, 71, 55},
                                                      {195, 89, 46},
                                                      {204, 106, 44},
                                                      {213, 123, 42},
                                                      {220, 141, 42},
                                                      {224, 160, 56},
                                                      {228, 177, 80},
                                                      {234, 194, 105},
                                                      {239, 210, 134},
                                                      {244, 226, 170},
                                                      {250, 241, 206}}};

// Colour of a place without a measurement; not on the scale.
inline constexpr Srgb kNoHeightColour{96, 104, 112};

// Colour of a height from 0 (lowest) to 1 (highest). Clamps other values. NaN: kNoHeightColour.
inline Srgb height_colour(double zero_to_one) {
  if (std::isnan(zero_to_one)) return kNoHeightColour;
  constexpr std::size_t kSteps = kHeightColours.size() - 1;
  const double place = std::fmin(std::fmax(zero_to_one, 0.0), 1.0) * static_cast<double>(kSteps);
  const auto below = static_cast<std::size_t>(std::fmin(std::floor(place), static_cast<double>(kSteps - 1)));
  const double share = place - static_cast<double>(below);
  Srgb colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const double low = kHeightColours[below][i], high = kHeightColours[below + 1][i];
    colour[i] = static_cast<std::uint8_t>(std::lround(low + share * (high - low)));
  }
  return colour;
}

}  // namespace afm::exhibit
