// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/tip_meeting.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace afm::physics {
namespace {

// A tip whose axis is within this share of a particle's radius of its axis has climbed onto it.
constexpr double kOnTopShare = 0.5;
// A base that leaves a particle by more than this against the direction to it goes back; otherwise it goes past.
constexpr double kBackwards = -0.5;

double length_m(const Sideways<Length>& way) { return std::sqrt(way.x.si * way.x.si + way.y.si * way.y.si); }

}  // namespace

TipMeeting::TipMeeting(const PushSetup& setup) {
  for (const ParticleSpecies& species : setup.species) {
    radius_.push_back(species.contact.tip_radius);
    crest_.push_back(crest_height(setup.tip, radius_.back()));
  }
}

void TipMeeting::begin(const LeverBase& over) noexcept {
  contact_ = {};
  last_ = over.position;
}

TipMeeting::Events TipMeeting::follow(const PushedParticles& particles, bool felt) noexcept {
  const PushTick& tick = particles.last();
  Events events;
  if (contact_.particle != kNoParticle && tick.particle != contact_.particle) leave(tick, particles, events);
  if (tick.particle != kNoParticle) {
    if (contact_.particle == kNoParticle) enter(tick, particles);
    stay(tick, particles, felt, events);
  }
  last_ = tick.base.position;
  return events;
}

void TipMeeting::enter(const PushTick& tick, const PushedParticles& particles) noexcept {
  contact_ = {.particle = tick.particle, .from_side = tick.apex.z <= crest_[particles.species(tick.particle)]};
}

void TipMeeting::stay(const PushTick& tick, const PushedParticles& particles, bool felt, Events& events) noexcept {
  // a particle that hangs is below the tip
  if (tick.state == PushState::Carried) contact_.from_side = false;
  const std::size_t species = particles.species(tick.particle);
  const Force lateral = magnitude(tick.lateral);
  if (!contact_.felt && felt) {
    contact_.felt = true;
    events.add({EventKind::ParticleTouched, Force(0.0), lateral});
  }
  const Sideways<Length> under = particles.nearest(tick.particle, tick.apex.position);
  const bool on_top = length_m(tick.apex.position - under) < kOnTopShare * radius_[species].si;
  if (contact_.felt && contact_.from_side && !contact_.ridden && on_top && tick.base.z < crest_[species]) {
    contact_.ridden = true;
    events.add({EventKind::ParticleRiddenOver, contact_.largest, lateral});
  }
  contact_.lateral = lateral;
  contact_.largest = std::max(contact_.largest, lateral);
  const Sideways<Length> towards = particles.nearest(tick.particle, tick.base.position) - tick.base.position;
  const double away_m = length_m(towards);
  contact_.towards_x = away_m > 0.0 ? towards.x.si / away_m : 0.0;
  contact_.towards_y = away_m > 0.0 ? towards.y.si / away_m : 0.0;
  const auto moved = particles.moved();
  contact_.pushed = contact_.pushed || std::find(moved.begin(), moved.end(), tick.particle) != moved.end();
}

// The tip has left its particle: a hand that lifts it or goes back means to; one that goes on has lost it.
void TipMeeting::leave(const PushTick& tick, const PushedParticles& particles, Events& events) noexcept {
  const Contact left = std::exchange(contact_, {});
  const Sideways<Length> moved = tick.base.position - last_;
  const bool low = tick.base.z < crest_[particles.species(left.particle)];
  const bool alone = tick.particle == kNoParticle;
  const bool forward = moved.x.si * left.towards_x + moved.y.si * left.towards_y > kBackwards * length_m(moved);
  if (!left.felt || !left.pushed || left.ridden || !low || !alone || !forward) return;
  events.add({EventKind::ParticleLost, left.lateral, Force(0.0)});
}

}  // namespace afm::physics
