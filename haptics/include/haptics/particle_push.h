// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "physics/contact_phase.h"

namespace afm::haptics {

// Contact of the tip with particles in one tick of FeltParticles. Forces on the lever, in the sample's frame.
struct ParticlePush {
  struct Event {
    physics::EventKind kind = physics::EventKind::ParticleTouched;
    double force_before_n = 0;  // lateral, on the lever; as physics::EventKind has it
    double force_after_n = 0;
  };

  bool near = false;     // a particle is within reach
  bool touches = false;  // a particle is touched; otherwise the forces are zero
  glm::dvec3 push_n{0.0};
  double bears_n = 0;  // upward part of the force of its strongest contact, which the sample need not bear
  double given_j = 0;  // energy from the drift of the sample, which pushes a tip that rests; on the hand
  std::array<Event, 6> events{};
  std::size_t event_count = 0;

  void add(const Event& event) noexcept { events[event_count++] = event; }
  std::span<const Event> happened() const noexcept { return std::span(events).first(event_count); }
};

// Pull of the groove along a planned push (haptics/felt_groove.h) in one tick, along the sample's x and y, and the
// related input of PassivityObserver. On the hand.
struct GroovePull {
  bool acts = false;  // false: there is no groove, and all else is zero
  glm::dvec2 force_n{0.0};
  double stored_j = 0;
  double given_j = 0;  // part of stored_j that a change of the gain added in this tick
  double stiffness_n_per_m = 0;
};

}  // namespace afm::haptics
