// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "outline.h"
#include "particle_grid.h"
#include "physics/manipulation/pushed_particles.h"

namespace afm::physics {

// Particles where they lie on the sample, and which of them are near each other. The constructor allocates, nothing
// else does.
class LyingParticles {
 public:
  // `search_m`: no search may have a larger radius. Setup and particles are valid.
  LyingParticles(const PushSetup& setup, const std::vector<PlacedParticle>& particles, double search_m);

  std::size_t size() const noexcept { return x_.size(); }
  Flat position(std::size_t i) const { return {x_.at(i), y_.at(i)}; }
  HalfTurn turn(std::size_t i) const { return turns_.at(i); }
  std::size_t species(std::size_t i) const { return species_.at(i); }
  std::size_t ground(std::size_t i) const noexcept { return ground_[i]; }  // index of the pad, from 1; 0: bare sample
  bool is_pinned(std::size_t i) const { return pinned_[i]; }
  double half_m(std::size_t i) const noexcept { return half_m_[species_[i]]; }  // half length of a rod; 0: a sphere
  double core_m(std::size_t i) const noexcept { return core_m_[species_[i]]; }  // flat radius of an island; 0: none
  Outline outline(std::size_t i) const noexcept;

  void move(std::size_t i, const Flat& at, const HalfTurn& turn) noexcept;

  // Place of a sphere where it overlaps no other particle: its own, or one near it.
  Flat free_place(std::size_t i) const noexcept;

  // Calls visit(particle) for every particle within `search_m` of the point, and for some beyond.
  template <class Visit>
  void near(const Flat& at, const Visit& visit) const noexcept {
    grid_.near(at.x, at.y, visit);
  }

  // Distance of the two axes, or centres, in contact.
  double touching_m(std::size_t i, std::size_t j) const noexcept {
    return touching_m_[species_[i] * half_m_.size() + species_[j]];
  }
  double apart_m(std::size_t i, std::size_t j) const noexcept { return distance_between(outline(i), outline(j)); }

  // Calls visit(particle) for every other particle that is at most `gap_m` farther away than if it touched particle i.
  template <class Visit>
  void neighbours(std::size_t i, double gap_m, const Visit& visit) const noexcept {
    const double* const touching_m = touching_m_.data() + species_[i] * half_m_.size();
    const double x_m = x_[i], y_m = y_[i], half_of_i_m = half_m(i), core_of_i_m = core_m(i);
    grid_.near(x_m, y_m, [&](std::size_t j) {
      if (j == i) return;
      const std::size_t species = species_[j];
      const double most_m = touching_m[species] + gap_m;
      if (half_of_i_m > 0.0 || half_m_[species] > 0.0 || core_of_i_m > 0.0) {
        if (apart_m(i, j) > most_m) return;
      } else {
        const double x = x_m - x_[j], y = y_m - y_[j];
        if (x * x + y * y > most_m * most_m) return;
      }
      visit(j);
    });
  }

  // Energy of two particles that press each other.
  double pair_j(std::size_t i, std::size_t j, const Stiffness& contact) const noexcept;

 private:
  std::size_t ground_at(const Flat& at) const noexcept;

  std::vector<StickyPad> pads_;
  std::vector<double> touching_m_;  // touching distance of two species, by rows
  std::vector<double> half_m_;      // half length of each species
  std::vector<double> core_m_;      // flat radius of each species
  std::vector<double> x_, y_;
  std::vector<HalfTurn> turns_;  // direction of each rod or island
  std::vector<std::size_t> species_;
  std::vector<std::size_t> ground_;
  std::vector<bool> pinned_;
  ParticleGrid grid_;
};

}  // namespace afm::physics
