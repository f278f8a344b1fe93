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
// The laws of a family form a grid over two coordinates, such as a share that grows with the modulus and adhesion. At
// a place with the coordinates c(x, y) the potential of a branch is that of the nine laws around c, weighted by uniform
// quadratic B-splines: U(x, y, h) = sum w_k(c) U_k(h). The force is its exact gradient, and continuous: along the
// height sum w_k F_k, sideways -dU/dc grad c. Half a step beyond the outermost laws, and from there on, these alone
// continue, without a sideways force.
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
    double energy_j = 0;         // potential energy U
    double force_n = 0;          // force along the height
    glm::dvec2 sideways_n{0.0};  // force sideways at a constant height above the surface
  };
  // Felt values on the free or the attached branch; zero while the tip waits for a lift.
  Felt at(physics::Phase phase, const Place& place, double height_m) const noexcept;

  // Heights of the jumps at a place.
  double jump_in_m(const Place& place) const noexcept { return jumps_at(mixture_of(place)).in_m; }
  double jump_off_m(const Place& place) const noexcept { return jumps_at(mixture_of(place)).off_m; }

  // Energy that the hand loses at a place in one slow cycle down and up, and the largest of all laws. Not negative.
  double loss_j(const Place& place) const noexcept;
  double most_loss_j() const noexcept { return most_loss_j_; }

  // The phase after a move to this place and height. A wait ends above the jump off contact.
  physics::Phase next_phase(physics::Phase phase, const Place& place, double height_m) const noexcept;

  static constexpr std::size_t kMixed = 9;

  // The laws around a place by their numbers, their weights, which add up to 1, and the slopes of the weights by the
  // two coordinates.
  struct Mixture {
    std::array<std::size_t, kMixed> law{};
    std::array<double, kMixed> weight{};
    std::array<glm::dvec2, kMixed> slope{};
  };
  Mixture mixture_of(const Place& place) const noexcept;

  // Upper limits over all laws where the hand can be, at heights in a range, on either branch within its jump: how
  // steeply the force rises on the way down; and how much energy and force change from one law to the next along each
  // coordinate, and that change of the energy in turn.
  struct Change {
    double energy_j = 0;
    double second_energy_j = 0;
    double force_n = 0;
  };
  struct Steepness {
    double stiffness_n_per_m = 0;
    Change by_column, by_row;
  };
  Steepness steepness(PotentialEnergy::Range heights) const;

  // The least energy of any law in a range of heights.
  double least_j(PotentialEnergy::Range heights) const;

 private:
  struct Branches {
    HeightPotential free;
    HeightPotential attached;
    double jump_in_m;
    double jump_off_m;
    double shift_j;  // energy added to the attached branch, so that both branches agree at the jump into contact
    double loss_j;   // energy lost by the jump off contact
  };

  struct Jumps {
    double in_m = 0;
    double off_m = 0;
    glm::dvec2 in_slope{0.0};  // slopes of in_m by the two coordinates
  };
  // Energy and force of a branch, with the energy's slopes by the two coordinates.
  struct Branch {
    double energy_j = 0;
    double force_n = 0;
    glm::dvec2 slope_j{0.0};
  };

  Jumps jumps_at(const Mixture& mixture) const noexcept;
  Branch branch_of(const Mixture& mixture, const HeightPotential Branches::* which, double height_m) const noexcept;
  Branch attached_of(const Mixture& mixture, double height_m) const noexcept;
  HeightPotential::Value value_of(const Branches& law, physics::Phase phase, double height_m) const noexcept;

  std::size_t columns_;
  std::size_t rows_;
  std::vector<Branches> laws_;
  double most_loss_j_ = 0;
};

}  // namespace afm::haptics
