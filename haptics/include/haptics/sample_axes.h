// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace afm::haptics {

// Orientation of the sample relative to the device, whose axes are parallel to the room's. Its position and size in the
// picture do not matter: they do not move the contact point in the hand's workspace.
class SampleAxes {
 public:
  // Sets the orientation from a node's transform, column-major, without its scale. Returns false and changes nothing if
  // the direction of its z or x axis is undefined.
  bool set_orientation(const std::array<double, 16>& room_from_sample) noexcept;

  bool operator==(const SampleAxes&) const = default;

  const glm::dvec3& x() const noexcept { return device_from_sample_[0]; }
  const glm::dvec3& normal() const noexcept { return device_from_sample_[2]; }  // outward normal of the sample, its +z

  glm::dvec3 in_device(const glm::dvec3& in_sample) const noexcept { return device_from_sample_ * in_sample; }
  glm::dvec3 in_sample(const glm::dvec3& in_device) const noexcept { return in_device * device_from_sample_; }

 private:
  // orthonormal; initially a sample on a table, its x to the right
  glm::dmat3 device_from_sample_{1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0};
};

}  // namespace afm::haptics
