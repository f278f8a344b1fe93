// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "physics/friction/sideways.h"
#include "physics/manipulation/half_turn.h"
#include "physics/manipulation/particle_friction.h"
#include "physics/manipulation/particle_terms.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/units.h"

// Spheres, rods and flat islands on a flat sample, pushed by the tip of a lever: quasi-static, without mass or velocity
// (docs/manipulation.md; docs/decisions/0019, 0022).
namespace afm::physics {

// A flat rectangle of the sample along x and y that holds spheres by another work of adhesion than the rest of it. A
// sphere lies on it if its centre does. Rods do not feel it.
struct StickyPad {
  Sideways<Length> middle;
  Sideways<Length> half_size;
  SurfaceEnergy work_of_adhesion;
};

constexpr bool lies_on(const StickyPad& pad, const Sideways<Length>& place) noexcept {
  const double x_m = (place.x - pad.middle.x).si, y_m = (place.y - pad.middle.y).si;
  return x_m <= pad.half_size.x.si && -x_m <= pad.half_size.x.si && y_m <= pad.half_size.y.si &&
         -y_m <= pad.half_size.y.si;
}

// The species as it is on the pad.
inline ParticleSpecies on_pad(const StickyPad& pad, ParticleSpecies species) noexcept {
  if (!is_rod(species)) species.contact.work_of_adhesion = pad.work_of_adhesion;
  return species;
}

// Usual budget of a tick: number of contacts evaluated in heaps, which depends only on places and path.
inline constexpr double kHeapLooks = 4000.0;

struct PushSetup {
  SphereCone tip;
  PushSprings springs;
  double tip_friction = 0.0;  // mu_t, coefficient of friction of tip and particle
  std::vector<ParticleSpecies> species;
  std::vector<StickyPad> pads{};  // sticky pads; where several overlap, the first counts
  double heap_looks = kHeapLooks;
};

struct PlacedParticle {
  std::size_t species = 0;
  Sideways<Length> position;  // position of the centre
  bool pinned = false;        // true: never moves
  double angle_rad = 0.0;     // angle of a rod's axis, or of an island's mark, from x
};

// Place of a particle. A sphere ignores the turn.
struct ParticlePlace {
  Sideways<Length> position;
  HalfTurn turn;

  bool operator==(const ParticlePlace&) const = default;
};

// Throws UnphysicalValue with the field tip_radius, half_angle, lateral_spring, normal_spring, contact_stiffness,
// tip_friction, radius, or a member of ParticleSpecies. Radii must be at least half the tip's, and within a factor of
// two of one another: the tick counts on few neighbours. Islands lie among islands alone, without pads. The contact of
// a sphere that sticks to the tip may stretch by no more than an eighth of its radius. At most kMostStickyPads pads,
// finite and not empty.
void validate(const PushSetup& setup);

// Throws std::invalid_argument for more than kMostParticles, for an unknown species and for two that overlap, and as
// above.
void validate(const PushSetup& setup, const std::vector<PlacedParticle>& particles);

// Height of a base whose apex touches no particle, and holds none but one that it carries.
Length clear_height(const PushSetup& setup) noexcept;

// Distance of the centres of two spheres, or of the axes of two rods, on the sample that touch, 2 sqrt(R_a R_b).
Length touching_distance(Length radius_a, Length radius_b) noexcept;

// Position of the apex on an unbent lever. z = 0 is the sample; below it, the lever presses.
struct LeverBase {
  Sideways<Length> position;
  Length z;
};

inline constexpr std::size_t kNoParticle = static_cast<std::size_t>(-1);

// State after a tick. The certificate: given + stored at the start >= lost + stored, at every tick.
struct PushTick {
  LeverBase base;                      // reached place; behind the requested one while `lagging`
  LeverBase apex;                      // apex on the bent lever
  Sideways<Force> lateral;             // force on the lever
  Force lift;                          // force on the lever, upwards, by spheres and sample
  std::size_t particle = kNoParticle;  // particle with the largest normal force, pushed or pulled
  PushState state = PushState::Free;
  Force normal;      // normal force on that particle; negative: the tip pulls it
  Force threshold;   // lateral force at which it starts or keeps moving
  Force gave_at;     // force on the particle that yielded last, at that moment
  Force goes_on_at;  // force that has moved that particle since
  Energy given;      // energy from the hand since the start, or since hold_over(), at a frozen tip in each sub-step: an
                     // upper bound
  Energy work;       // work of the hand since the start, by the force at both ends of each sub-step
  Energy lost;       // loss by friction and by slips of lone spheres since the start
  Energy stored;     // energy stored in lever and contacts
  std::uint64_t yields = 0;     // number of times that a particle yielded, since the start
  std::uint64_t exhausted = 0;  // number of ticks at whose end a heap was not at rest, since the start
  std::uint64_t attached = 0;   // number of contacts formed by adhesion to the tip, since the start
  std::uint64_t dragged = 0;    // number of times that a sphere began to follow a pull, since the start
  std::uint64_t torn = 0;       // number of torn contacts, since the start
  Force dragged_at;             // lateral force at which a sphere last began to follow the tip
  Force torn_at;                // pull of the contact that tore last, at that moment
  std::uint64_t lifted = 0;     // number of spheres lifted off the sample, since the start
  Force lifted_at;              // upward pull-off force of the sphere lifted last
  std::uint64_t set_down = 0;   // number of spheres set down on the sample, since the start
  Energy torn_lost;             // loss by tears of lone contacts, since the start or since hold_over(); part of `lost`
  bool lagging = false;
  bool near = false;  // true: particles are within reach of the apex
};

// The constructor allocates; a tick neither allocates, locks, throws nor waits. One thread. The result depends on the
// path of the base and, by ageing, on the time between ticks; never on a clock.
//
// Each tick descends in E + R: E is the energy of lever and contacts, R the friction of the step. A step that raises
// the sum is never taken, so that no path of the base gains energy, however few steps the budget allows.
class PushedParticles {
 public:
  // Throws as validate() does.
  PushedParticles(const PushSetup& setup, const std::vector<PlacedParticle>& particles, const LeverBase& start);
  PushedParticles(const PushedParticles&) = delete;
  PushedParticles& operator=(const PushedParticles&) = delete;
  PushedParticles(PushedParticles&& other) noexcept;
  ~PushedParticles();

  // Moves the base on a straight line. A base that is not finite is ignored.
  const PushTick& move_to(const LeverBase& base, Time elapsed) noexcept;

  // Takes the tip off all particles, puts one that it carries where it was lifted, and holds it over the place, so high
  // that it touches none: base.z is at least clear_height(setup). Every particle then counts as fully rested, and
  // given, work, lost and stored start at zero. All else depends only on the places of the particles.
  void hold_over(const LeverBase& base) noexcept;

  // Puts every particle at a place, for a tip held over them; particles that touch may overlap a little. Then calls
  // hold_over(). Throws std::invalid_argument unless there is a finite place for each, with a unit turn.
  void put(const std::vector<ParticlePlace>& places, const LeverBase& base);

  // Puts one particle at a finite place, which is that of no other. Call hold_over() before the next tick.
  void put(std::size_t particle, const ParticlePlace& place) noexcept;

  // A place on the sample where a sphere overlaps no other particle: its own, or one near it.
  Sideways<Length> free_place(std::size_t particle) const noexcept;

  // Particles that the last tick moved, each once.
  std::span<const std::uint32_t> moved() const noexcept;

  const PushTick& last() const noexcept;
  std::size_t size() const noexcept;
  Sideways<Length> position(std::size_t particle) const noexcept;
  HalfTurn turn(std::size_t particle) const noexcept;  // direction of the axis or mark; constant for a sphere
  // Point of a rod's axis, or of the flat part of an island, that is nearest to a place; the centre of a sphere.
  Sideways<Length> nearest(std::size_t particle, const Sideways<Length>& to) const noexcept;
  std::size_t species(std::size_t particle) const noexcept;

 private:
  class Ticker;
  std::unique_ptr<Ticker> ticker_;
};

}  // namespace afm::physics
