// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/pushed_particles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "outline.h"
#include "physics/manipulation/particle_limits.h"
#include "physics/manipulation/tip_hold.h"
#include "physics/quantity_text.h"
#include "push_ticker.h"
#include "require_range.h"

namespace afm::physics {
namespace {

constexpr double kClearShare = 1.02;      // clear height as a multiple of the largest diameter
constexpr double kOverlapAllowed = 1e-6;  // allowed overlap at the start, as a share of the touching distance
constexpr double kUnitTurn = 1e-9;        // allowed deviation of a turn's square from 1
constexpr Length kFarthestPad{1e-3}, kSmallestPad{1e-9};
constexpr double kMostStretch = 0.125;  // longest stretch of a pulling contact, as a share of the radius

void validate_hold(const PushSetup& setup, const ParticleSpecies& species) {
  const Length stretch = strongest_pull(setup.tip, species) / setup.springs.contact;
  if (stretch > kMostStretch * species.contact.tip_radius) {
    throw UnphysicalValue("contact_stiffness",
                          "contact stiffness " + format_quantity(setup.springs.contact, kStiffnessUnits) +
                              " is too soft for spheres that stick to the tip: their contact would stretch by " +
                              format_quantity(stretch, kLengthUnits, 3) + " before it tears");
  }
}

void validate_pads(const PushSetup& setup) {
  if (setup.pads.size() > kMostStickyPads) {
    throw UnphysicalValue("pads",
                          std::to_string(setup.pads.size()) + " pads are more than " + std::to_string(kMostStickyPads));
  }
  for (const StickyPad& pad : setup.pads) {
    require_range("pad_x", pad.middle.x, -kFarthestPad, kFarthestPad, kLengthUnits);
    require_range("pad_y", pad.middle.y, -kFarthestPad, kFarthestPad, kLengthUnits);
    require_range("pad_width", 2.0 * pad.half_size.x, kSmallestPad, kFarthestPad, kLengthUnits);
    require_range("pad_height", 2.0 * pad.half_size.y, kSmallestPad, kFarthestPad, kLengthUnits);
    require_range("pad_work_of_adhesion", pad.work_of_adhesion, SurfaceEnergy(1e-6), SurfaceEnergy(10.0),
                  kSurfaceEnergyUnits);
  }
}

Outline outline_of(const PushSetup& setup, const PlacedParticle& particle) {
  return {{particle.position.x.si, particle.position.y.si},
          axis_of(half_turn(particle.angle_rad)),
          0.5 * setup.species[particle.species].length.si,
          core_radius(setup.species[particle.species]).si};
}

}  // namespace

Length clear_height(const PushSetup& setup) noexcept {
  Length radius, stretch;
  for (const ParticleSpecies& species : setup.species) {
    radius = std::max(radius, species.contact.tip_radius);
    const Force pull = strongest_pull(setup.tip, species);
    stretch = std::max(stretch, pull / setup.springs.normal + pull / setup.springs.contact);
  }
  return kClearShare * (2.0 * radius + stretch);
}

Length touching_distance(Length radius_a, Length radius_b) noexcept { return 2.0 * sqrt(radius_a * radius_b); }

void validate(const PushSetup& setup) {
  require_range("tip_radius", setup.tip.radius, Length(1e-10), Length(1e-5), kLengthUnits);
  require_angle("half_angle", setup.tip.half_angle_rad, 0.0, 1.3);
  for (const auto& [field, spring] :
       {std::pair{"lateral_spring", setup.springs.lateral}, std::pair{"normal_spring", setup.springs.normal},
        std::pair{"contact_stiffness", setup.springs.contact}}) {
    require_range(field, spring, Stiffness(1e-4), Stiffness(1e6), kStiffnessUnits);
  }
  require_range("tip_friction", setup.tip_friction, 0.0, 10.0, kPlainNumber);
  if (setup.species.empty()) throw UnphysicalValue("species", "there is no species of particles");
  Length smallest{HUGE_VAL}, largest{}, narrowest{HUGE_VAL}, widest{};
  for (const ParticleSpecies& species : setup.species) {
    validate(species);
    if (species.sticks) validate_hold(setup, species);
    smallest = std::min(smallest, species.contact.tip_radius);
    largest = std::max(largest, species.contact.tip_radius);
    narrowest = std::min(narrowest, outer_radius(species));
    widest = std::max(widest, outer_radius(species));
  }
  validate_pads(setup);
  const auto islands = static_cast<std::size_t>(std::count_if(setup.species.begin(), setup.species.end(), is_island));
  if (islands > 0 && (islands < setup.species.size() || !setup.pads.empty())) {
    throw UnphysicalValue("island_radius", "flat islands lie on a bare sample, without spheres, rods and pads");
  }
  if (islands > 0) require_range("island_radius", narrowest, widest / 2.0, Length(1e-5), kLengthUnits);
  require_range("radius", smallest, std::max(setup.tip.radius, largest) / 2.0, Length(1e-5), kLengthUnits);
}

void validate(const PushSetup& setup, const std::vector<PlacedParticle>& particles) {
  validate(setup);
  if (particles.size() > kMostParticles) {
    throw std::invalid_argument(std::to_string(particles.size()) + " particles are more than " +
                                std::to_string(kMostParticles));
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const PlacedParticle& a = particles[i];
    if (a.species >= setup.species.size()) {
      throw UnplaceableParticle(i, "particle " + std::to_string(i + 1) + " is of an unknown species");
    }
    if (!std::isfinite(a.angle_rad)) {
      throw UnplaceableParticle(i, "the angle of particle " + std::to_string(i + 1) + " is not finite");
    }
    for (std::size_t j = 0; j < i; ++j) {
      const PlacedParticle& b = particles[j];
      const double touching_m =
          touching_distance(setup.species[a.species].contact.tip_radius, setup.species[b.species].contact.tip_radius)
              .si;
      const Outline of_a = outline_of(setup, a), of_b = outline_of(setup, b);
      const double apart_m = cross(of_a, of_b) ? 0.0 : distance_between(of_a, of_b);
      if (!(apart_m >= touching_m * (1.0 - kOverlapAllowed))) {
        const std::string what = of_a.half_m > 0.0 || of_b.half_m > 0.0 ? "axes" : "centres";
        throw UnplaceableParticle(i, "particles " + std::to_string(j + 1) + " and " + std::to_string(i + 1) +
                                         " overlap: their " + what + " are " +
                                         format_quantity(Length(apart_m), kLengthUnits) + " apart and touch at " +
                                         format_quantity(Length(touching_m), kLengthUnits));
      }
    }
  }
}

PushedParticles::PushedParticles(const PushSetup& setup, const std::vector<PlacedParticle>& particles,
                                 const LeverBase& start)
    : ticker_(std::make_unique<Ticker>(setup, particles, start)) {}

PushedParticles::PushedParticles(PushedParticles&& other) noexcept = default;
PushedParticles::~PushedParticles() = default;

const PushTick& PushedParticles::move_to(const LeverBase& base, Time elapsed) noexcept {
  return ticker_->tick(base, elapsed.si);
}

void PushedParticles::hold_over(const LeverBase& base) noexcept { ticker_->hold_over(base); }

void PushedParticles::put(const std::vector<ParticlePlace>& places, const LeverBase& base) {
  if (places.size() != size()) {
    throw std::invalid_argument(std::to_string(places.size()) + " places are given for " + std::to_string(size()) +
                                " particles");
  }
  for (const auto& [position, turn] : places) {
    if (!std::isfinite(position.x.si) || !std::isfinite(position.y.si)) {
      throw std::invalid_argument("the place of a particle is not finite");
    }
    if (!(std::abs(turn.w * turn.w + turn.z * turn.z - 1.0) <= kUnitTurn)) {
      throw std::invalid_argument("the turn of a particle is not of unit length");
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) put(i, places[i]);
  ticker_->hold_over(base);
}

void PushedParticles::put(std::size_t particle, const ParticlePlace& place) noexcept {
  ticker_->put(particle, {place.position.x.si, place.position.y.si}, place.turn);
}

Sideways<Length> PushedParticles::free_place(std::size_t particle) const noexcept {
  const Flat at = ticker_->lying().free_place(particle);
  return {Length(at.x), Length(at.y)};
}

std::span<const std::uint32_t> PushedParticles::moved() const noexcept { return ticker_->moved(); }

const PushTick& PushedParticles::last() const noexcept { return ticker_->last(); }
std::size_t PushedParticles::size() const noexcept { return ticker_->lying().size(); }

Sideways<Length> PushedParticles::position(std::size_t particle) const noexcept {
  const Flat at = ticker_->lying().position(particle);
  return {Length(at.x), Length(at.y)};
}

HalfTurn PushedParticles::turn(std::size_t particle) const noexcept { return ticker_->lying().turn(particle); }

Sideways<Length> PushedParticles::nearest(std::size_t particle, const Sideways<Length>& to) const noexcept {
  const Flat at = nearest_on(ticker_->lying().outline(particle), {to.x.si, to.y.si});
  return {Length(at.x), Length(at.y)};
}

std::size_t PushedParticles::species(std::size_t particle) const noexcept { return ticker_->lying().species(particle); }

}  // namespace afm::physics
