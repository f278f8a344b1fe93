// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace afm::haptics {

// Velocity of the hand: differences of its positions after a first-order low-pass of 30 Hz, without which the encoder's
// steps of 0.055 mm would be noise. For damping and the velocity trip only, never for a force law. Servo's thread.
class HandMotion {
 public:
  static constexpr double kCutoffHz = 30.0;
  static constexpr std::int64_t kTripNs = 5'000'000;  // shortest excess of the trip speed, longer than one bad sample

  // `trip_speed_m_per_s` is the limit of the velocity trip.
  explicit HandMotion(double trip_speed_m_per_s);

  // Records the position of the hand, `elapsed_ns` after the previous call; the first call sets the initial position.
  // Must be finite and within reach.
  void move(const glm::dvec3& position_m, std::int64_t elapsed_ns) noexcept;
  void forget() noexcept;

  const glm::dvec3& velocity_m_per_s() const noexcept { return velocity_m_per_s_; }
  const glm::dvec3& moved_m() const noexcept { return moved_m_; }  // displacement in the last call
  bool too_fast() const noexcept { return fast_ns_ >= kTripNs; }

 private:
  double trip_speed_m_per_s_;
  bool started_ = false;
  glm::dvec3 position_m_{0.0};
  glm::dvec3 moved_m_{0.0};
  glm::dvec3 velocity_m_per_s_{0.0};
  std::int64_t fast_ns_ = 0;  // time since the tick that first exceeded the trip speed
  bool fast_ = false;
};

}  // namespace afm::haptics
