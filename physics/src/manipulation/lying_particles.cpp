// SPDX-License-Identifier: Apache-2.0
#include "lying_particles.h"

namespace afm::physics {
namespace {

std::vector<double> all_of(const std::vector<PlacedParticle>& particles, Length Sideways<Length>::* part) {
  std::vector<double> all;
  all.reserve(particles.size());
  for (const PlacedParticle& particle : particles) all.push_back((particle.position.*part).si);
  return all;
}

}  // namespace

LyingParticles::LyingParticles(const PushSetup& setup, const std::vector<PlacedParticle>& particles, double search_m)
    : x_(all_of(particles, &Sideways<Length>::x)),
      y_(all_of(particles, &Sideways<Length>::y)),
      grid_(x_, y_, search_m) {
  for (const ParticleSpecies& a : setup.species) {
    half_m_.push_back(0.5 * a.length.si);
    for (const ParticleSpecies& b : setup.species) {
      touching_m_.push_back(touching_distance(a.contact.tip_radius, b.contact.tip_radius).si);
    }
  }
  for (const PlacedParticle& particle : particles) {
    turns_.push_back(half_turn(particle.angle_rad));
    species_.push_back(particle.species);
    pinned_.push_back(particle.pinned);
  }
}

Outline LyingParticles::outline(std::size_t i) const noexcept {
  const double half = half_m(i);
  return {{x_[i], y_[i]}, half > 0.0 ? axis_of(turns_[i]) : Flat{1.0, 0.0}, half};
}

void LyingParticles::move(std::size_t i, const Flat& at, const HalfTurn& turn) noexcept {
  x_[i] = at.x;
  y_[i] = at.y;
  turns_[i] = turn;
  grid_.move(i, at.x, at.y);
}

bool LyingParticles::is_beyond(std::size_t i, std::size_t j, double most_m) const noexcept {
  if (half_m(i) > 0.0 || half_m(j) > 0.0) return apart_m(i, j) > most_m;
  const double x = x_[i] - x_[j], y = y_[i] - y_[j];
  return x * x + y * y > most_m * most_m;
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
