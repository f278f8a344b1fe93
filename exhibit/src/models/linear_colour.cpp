// SPDX-License-Identifier: Apache-2.0
#include "models/linear_colour.h"

#include <cmath>
#include <cstdint>

namespace afm::exhibit {

glm::vec4 linear_colour(const Srgb& colour) {
  const auto linear = [](std::uint8_t srgb) {
    const float s = static_cast<float>(srgb) / 255.0F;
    return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
  };
  return {linear(colour[0]), linear(colour[1]), linear(colour[2]), 1.0F};
}

}  // namespace afm::exhibit
