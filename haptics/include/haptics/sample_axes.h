// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace afm::haptics {

// How the sample is turned against the device, whose axes are parallel to the room's. Only its orientation counts:
// where the picture shows it, and how large, does not move the contact point in a hand's workspace.
class SampleAxes {
 public:
  // Takes the orientation of a node's transform, column-major; its scale is left out. False, and nothing changes, if
  // its z or x axis has no direction of its own.
  bool set_orientation(const std::array<double, 16>& room_from_sample) noexcept;

  bool operator==(const SampleAxes&) const = default;

  const glm::dvec3& x() const noexcept { return device_from_sample_[0]; }
  const glm::dvec3& normal() const noexcept { return device_from_sample_[2]; }  // +z of the sample: outwards

  glm::dvec3 in_device(const glm::dvec3& in_sample) const noexcept { return device_from_sample_ * in_sample; }
  glm::dvec3 in_sample(const glm::dvec3& in_device) const noexcept { return in_device * device_from_sample_; }

 private:
  // orthonormal; a sample that lies on a table, its x to the right
  glm::dmat3 device_from_sample_{1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0};
};

}  // namespace afm::haptics
