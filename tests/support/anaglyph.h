// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>

#include "scene/display/stereo_layout.h"

// Expected colour of a pixel behind glasses of two colours, from the research's rule, independent of the shader.
namespace afm::test {

inline double linear_from_srgb(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
inline double srgb_from_linear(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055; }

inline glm::dvec3 linear_light(const std::array<int, 3>& c) {
  return {linear_from_srgb(c[0] / 255.0), linear_from_srgb(c[1] / 255.0), linear_from_srgb(c[2] / 255.0)};
}

inline glm::dvec3 anaglyph_linear(const scene::AnaglyphMatrices& matrices, const std::array<int, 3>& left,
                                  const std::array<int, 3>& right) {
  const glm::dvec3 mixed = matrices.left * linear_light(left) + matrices.right * linear_light(right);
  return {std::clamp(mixed.x, 0.0, 1.0), std::clamp(mixed.y, 0.0, 1.0), std::clamp(mixed.z, 0.0, 1.0)};
}

inline int srgb8(double linear) { return static_cast<int>(std::lround(255.0 * srgb_from_linear(linear))); }

}  // namespace afm::test
