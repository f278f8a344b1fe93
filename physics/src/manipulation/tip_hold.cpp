// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/tip_hold.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/manipulation/pushed_particles.h"

namespace afm::physics {
namespace {

constexpr double kScatter = 0.2;
constexpr double kStrongFactor = 2.0;  // factor of a strong contact, 3.6 standard deviations above the median

// splitmix64 (Steele, Lea & Flood 2014).
std::uint64_t spread(std::uint64_t word) {
  word += 0x9E3779B97F4A7C15ULL;
  word = (word ^ (word >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  word = (word ^ (word >> 27U)) * 0x94D049BB133111EBULL;
  return word ^ (word >> 31U);
}

// Quantile of the normal distribution: Abramowitz & Stegun 26.2.23, then steps of Halley.
double normal_quantile_of(double u) {
  const double p = std::min(u, 1.0 - u), t = std::sqrt(-2.0 * std::log(p));
  double z = (2.515517 + t * (0.802853 + t * 0.010328)) / (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308))) - t;
  for (int i = 0; i < 3; ++i) {
    const double above = 0.5 * std::erfc(-z / std::numbers::sqrt2) - p;
    const double step = above * std::sqrt(2.0 * std::numbers::pi) * std::exp(0.5 * z * z);
    z -= step / (1.0 + 0.5 * z * step);
  }
  return u < 0.5 ? z : -z;
}

}  // namespace

Force tip_pull_off(const SphereCone& tip, const ParticleSpecies& species, bool on_flank) noexcept {
  return 1.5 * std::numbers::pi * species.tip_adhesion * effective_radius(tip, species.contact.tip_radius, on_flank);
}

TipGrip flank_grip(const SphereCone& tip, const ParticleSpecies& species, double tip_friction) noexcept {
  return {tip_friction, tip_pull_off(tip, species, true)};
}

Force strongest_pull(const SphereCone& tip, const ParticleSpecies& species) noexcept {
  if (!species.sticks) return Force(0.0);
  const Force pull = std::max(tip_pull_off(tip, species, true), tip_pull_off(tip, species, false));
  return species.scatter_seed != 0 ? kStrongFactor * pull : pull;
}

bool follows_tip(const SphereCone& tip, const ParticleSpecies& species) {
  const Force holds = tip_pull_off(tip, species, true);
  return holds * std::cos(tip.half_angle_rad) > threshold_under_pull(species, holds * std::sin(tip.half_angle_rad));
}

SurfaceEnergy lifting_adhesion(const SphereCone& tip, const ParticleSpecies& species) noexcept {
  return species.contact.work_of_adhesion * ((tip.radius + species.contact.tip_radius) / tip.radius);
}

bool lifts(const SphereCone& tip, const ParticleSpecies& species) noexcept {
  const Force upwards =
      std::max(tip_pull_off(tip, species, false), tip_pull_off(tip, species, true) * std::sin(tip.half_angle_rad));
  return upwards > pull_off_force(species);
}

bool lifts_anywhere(const PushSetup& setup, const ParticleSpecies& species) noexcept {
  return lifts(setup.tip, species) || std::any_of(setup.pads.begin(), setup.pads.end(), [&](const StickyPad& pad) {
           return lifts(setup.tip, on_pad(pad, species));
         });
}

Energy tear_energy(Force pull_off, Stiffness along_normal) noexcept {
  return 0.5 * (pull_off * pull_off) / along_normal;
}

double scatter_number(std::uint64_t seed, std::uint64_t particle, std::uint64_t count) noexcept {
  const std::uint64_t bits = spread(spread(spread(seed) ^ particle) ^ count) >> 11U;
  return (static_cast<double>(bits) + 0.5) * 0x1p-53;
}

double pull_off_factor(std::uint64_t seed, std::uint64_t particle, std::uint64_t count) noexcept {
  const double z = normal_quantile_of(scatter_number(seed, particle, count));
  return std::exp(kScatter * z - 0.5 * kScatter * kScatter);
}

}  // namespace afm::physics
