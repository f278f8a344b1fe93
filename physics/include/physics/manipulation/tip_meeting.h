// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/contact_phase.h"
#include "physics/friction/sideways.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/units.h"

namespace afm::physics {

// History of the contact with the particle that a tip presses hardest: touched, ridden over, lost. The constructor
// allocates, nothing else does. One thread.
class TipMeeting {
 public:
  struct Event {
    EventKind kind = EventKind::ParticleTouched;
    Force before;  // lateral force on the lever before the event
    Force after;
  };

  // Events of one tick, at most two.
  class Events {
   public:
    void add(const Event& event) noexcept { events_[count_++] = event; }
    std::span<const Event> all() const& noexcept { return std::span(events_).first(count_); }
    std::span<const Event> all() const&& = delete;  // deleted: the span would outlive its events

   private:
    std::array<Event, 2> events_{};
    std::size_t count_ = 0;
  };

  explicit TipMeeting(const PushSetup& setup);

  // The tip comes down from this place over the particles.
  void begin(const LeverBase& over) noexcept;

  // Call after each tick of these particles. `felt`: the normal force is strong enough for the hand; a contact counts
  // once it has been felt.
  Events follow(const PushedParticles& particles, bool felt) noexcept;

 private:
  struct Contact {
    std::size_t particle = kNoParticle;
    bool felt = false;
    bool from_side = false;  // true: the contact began on the flank
    bool pushed = false;     // true: the particle has moved
    bool ridden = false;
    Force lateral{};         // lateral force in the newest tick
    Force largest{};         // largest lateral force so far
    double towards_x = 0.0;  // direction from the lever's base to the particle
    double towards_y = 0.0;
  };

  void enter(const PushTick& tick, const PushedParticles& particles) noexcept;
  void stay(const PushTick& tick, const PushedParticles& particles, bool felt, Events& events) noexcept;
  void leave(const PushTick& tick, const PushedParticles& particles, Events& events) noexcept;

  std::vector<Length> radius_;  // radius of each species
  std::vector<Length> crest_;   // highest point of each species
  Contact contact_;
  Sideways<Length> last_;  // newest place of the lever's base
};

}  // namespace afm::physics
