// SPDX-License-Identifier: Apache-2.0
#include "lying_particles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace afm::physics {
namespace {

constexpr double kRingShare = 0.125;  // width of a ring as a share of the diameter
constexpr int kPlacesPerRing = 6;

std::vector<double> all_of(const std::vector<PlacedParticle>& particles, Length Sideways<Length>::* part) {
  std::vector<double> all;
  all.reserve(particles.size());
  for (const PlacedParticle& particle : particles) all.push_back((particle.position.*part).si);
  return all;
}

}  // namespace

LyingParticles::LyingParticles(const PushSetup& setup, const std::vector<PlacedParticle>& particles, double search_m)
    : pads_(setup.pads),
      x_(all_of(particles, &Sideways<Length>::x)),
      y_(all_of(particles, &Sideways<Length>::y)),
      grid_(x_, y_, search_m) {
  for (const ParticleSpecies& a : setup.species) {
    half_m_.push_back(0.5 * a.length.si);
    core_m_.push_back(core_radius(a).si);
    for (const ParticleSpecies& b : setup.species) {
      touching_m_.push_back(touching_distance(a.contact.tip_radius, b.contact.tip_radius).si);
    }
  }
  for (const PlacedParticle& particle : particles) {
    turns_.push_back(half_turn(particle.angle_rad));
    species_.push_back(particle.species);
    pinned_.push_back(particle.pinned);
    ground_.push_back(ground_at({particle.position.x.si, particle.position.y.si}));
  }
}

std::size_t LyingParticles::ground_at(const Flat& at) const noexcept {
  const auto pad = std::find_if(pads_.begin(), pads_.end(),
                                [&](const StickyPad& p) { return lies_on(p, {Length(at.x), Length(at.y)}); });
  return pad == pads_.end() ? 0 : static_cast<std::size_t>(pad - pads_.begin()) + 1;
}

Outline LyingParticles::outline(std::size_t i) const noexcept {
  const double half = half_m(i);
  return {{x_[i], y_[i]}, half > 0.0 ? axis_of(turns_[i]) : Flat{1.0, 0.0}, half, core_m(i)};
}

void LyingParticles::move(std::size_t i, const Flat& at, const HalfTurn& turn) noexcept {
  x_[i] = at.x;
  y_[i] = at.y;
  turns_[i] = turn;
  ground_[i] = ground_at(at);
  grid_.move(i, at.x, at.y);
}

Flat LyingParticles::free_place(std::size_t i) const noexcept {
  const auto is_free = [&](const Flat& at) {
    bool free = true;
    near(at, [&](std::size_t j) {
      if (j != i && distance_between(nearest_on(outline(j), at), at) < touching_m(i, j)) free = false;
    });
    return free;
  };
  // rings around it, which leave every crowd
  const Flat from = position(i);
  const double ring_m = kRingShare * touching_m(i, i);
  for (int ring = 0;; ++ring) {
    const int places = std::max(1, kPlacesPerRing * ring);
    for (int k = 0; k < places; ++k) {
      const double angle_rad = 2.0 * std::numbers::pi * k / places, away_m = ring * ring_m;
      const Flat at{from.x + away_m * std::cos(angle_rad), from.y + away_m * std::sin(angle_rad)};
      if (is_free(at)) return at;
    }
  }
}

double LyingParticles::pair_j(std::size_t i, std::size_t j, const Stiffness& contact) const noexcept {
  const auto energy_j = [&](double distance_m) {
    const double depth_m = touching_m(i, j) - distance_m;
    return depth_m > 0.0 ? 0.5 * contact.si * depth_m * depth_m : 0.0;
  };
  const Outline a = outline(i), b = outline(j);
  if (!(a.half_m > 0.0 && b.half_m > 0.0)) return energy_j(distance_between(a, b));
  double sum_j = 0.0;
  for (const double end : {-1.0, 1.0}) {
    const Flat of_a = along(a, end * a.half_m), of_b = along(b, end * b.half_m);
    sum_j += energy_j(distance_between(of_a, nearest_on(b, of_a)));
    sum_j += energy_j(distance_between(of_b, nearest_on(a, of_b)));
  }
  return sum_j;
}

}  // namespace afm::physics
