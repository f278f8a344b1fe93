// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "haptics/height_potential.h"
#include "physics/contact_phase.h"

namespace afm::haptics {

// A force law that changes from place to place over a sample, on the hand: potentials are interpolated, not forces, so
// that the sideways force follows and no closed path gains energy.
//
// The laws of a family stand on a grid over two coordinates, such as the logarithms of modulus and adhesion. At a place
// with the coordinates c(x, y) the potential of a branch is that of the four laws around c, weighted bilinearly:
// U(x, y, h) = sum w_k(c) U_k(h). The force is its exact gradient: along the height sum w_k F_k, sideways -dU/dc grad
// c. Beyond the grid the outermost laws continue, without a sideways force.
//
// Where the tip jumps in, and where it lets go, is weighted in the same way. At the jump into contact both branches
// have one energy, at every place: the attached branch is shifted by a constant that depends on the place, whose slope
// is part of the sideways force. The tip lets go only where the attached branch has no less energy than the free one.
// Thus the energy of the branch under the tip is a stored one that jumps down alone, whatever the order of attaching,
// sliding and letting go.
//
// Built once; everything else may be called in a tick of the servo, by any thread.
class MapLaw {
 public:
  // One law of the family: the force on the hand along the normal on either branch by the hand's height, and the
  // heights of its jumps. Beyond its jump a branch keeps its force. `jump_off_m` is not below `jump_in_m`.
  struct Law {
    PotentialEnergy::ForceOverHeight free_n;
    PotentialEnergy::ForceOverHeight attached_n;
    double jump_in_m = 0;
    double jump_off_m = 0;
  };

  // `laws` row by row, `columns` to a row, at least one. Allocates, and takes about 0.2 ms for a law.
  MapLaw(const std::vector<Law>& laws, std::size_t columns, PotentialEnergy::Range heights);

  // The coordinates at a place, in columns and rows of the family, and their slopes along x and y, per metre.
  struct Place {
    glm::dvec2 at{0.0};
    glm::dvec2 column_slope{0.0};
    glm::dvec2 row_slope{0.0};
  };

  struct Felt {
    double energy_j = 0;         // U
    double force_n = 0;          // along the height
    glm::dvec2 sideways_n{0.0};  // at a constant height above the surface
  };
  // On the free or the attached branch; nothing while the tip waits for a lift.
  Felt at(physics::Phase phase, const Place& place, double height_m) const noexcept;

  // Heights of the jumps at a place.
  double jump_in_m(const Place& place) const noexcept { return jumps_at(mixture_of(place)).in_m; }
  double jump_off_m(const Place& place) const noexcept { return jumps_at(mixture_of(place)).off_m; }

  // The phase after a move to this place and height. A wait ends above the jump off contact.
  physics::Phase next_phase(physics::Phase phase, const Place& place, double height_m) const noexcept;

 private:
  struct Branches {
    HeightPotential free;
    HeightPotential attached;
    double jump_in_m;
    double jump_off_m;
  };

  // Weights of four laws, and their slopes by the two coordinates.
  struct Mixture {
    std::array<const Branches*, 4> laws;
    std::array<double, 4> weight;
    std::array<glm::dvec2, 4> slope;
  };
  struct Jumps {
    double in_m = 0;
    double off_m = 0;
    glm::dvec2 in_slope{0.0};  // by the two coordinates
  };
  // Energy and force of a branch, with the energy's slopes by the two coordinates.
  struct Branch {
    double energy_j = 0;
    double force_n = 0;
    glm::dvec2 slope_j{0.0};
  };

  Mixture mixture_of(const Place& place) const noexcept;
  static Jumps jumps_at(const Mixture& mixture) noexcept;
  static Branch branch_of(const Mixture& mixture, const HeightPotential Branches::* which, double height_m) noexcept;
  static Branch attached_of(const Mixture& mixture, double height_m) noexcept;

  std::size_t columns_;
  std::size_t rows_;
  std::vector<Branches> laws_;
};

}  // namespace afm::haptics
