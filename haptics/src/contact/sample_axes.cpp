// SPDX-License-Identifier: Apache-2.0
#include "haptics/sample_axes.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace afm::haptics {

namespace {
constexpr double kParallel = 1e-6;  // smallest angle between x and z of a usable transform, rad
}  // namespace

bool SampleAxes::set_orientation(const std::array<double, 16>& room_from_sample) noexcept {
  const glm::dvec3 x_axis(room_from_sample[0], room_from_sample[1], room_from_sample[2]);
  const glm::dvec3 z_axis(room_from_sample[8], room_from_sample[9], room_from_sample[10]);
  const double x_length = glm::length(x_axis), z_length = glm::length(z_axis);
  if (!std::isnormal(x_length) || !std::isnormal(z_length)) return false;
  const glm::dvec3 z = z_axis / z_length;
  const glm::dvec3 across = x_axis / x_length - glm::dot(x_axis / x_length, z) * z;
  if (!(glm::length(across) > kParallel)) return false;
  const glm::dvec3 x = glm::normalize(across);
  device_from_sample_ = glm::dmat3(x, glm::cross(z, x), z);
  return true;
}

}  // namespace afm::haptics
