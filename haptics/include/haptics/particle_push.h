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
    double force_before_n = 0;  // lateral force on the lever; exceptions as in physics::EventKind
    double force_after_n = 0;
  };

  bool near = false;     // true: a particle is within reach
  bool touches = false;  // true: a particle is touched; false: the forces are zero
  glm::dvec3 push_n{0.0};
  double bears_n = 0;  // upward part of the strongest contact's force, which the sample need not bear
  double given_j = 0;  // energy on the hand from the drift of the sample below a tip at rest
  std::array<Event, 6> events{};
  std::size_t event_count = 0;

  void add(const Event& event) noexcept { events[event_count++] = event; }
  std::span<const Event> happened() const noexcept { return std::span(events).first(event_count); }
};

// Pull of the groove along a planned push (haptics/felt_groove.h) in one tick, along the sample's x and y, and the
// related input of PassivityObserver. On the hand.
struct GroovePull {
  bool acts = false;  // false: there is no groove, and the other fields are zero
  glm::dvec2 force_n{0.0};
  double stored_j = 0;
  double given_j = 0;  // part of stored_j added in this tick by a change of the gain
  double stiffness_n_per_m = 0;
};

}  // namespace afm::haptics
