// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "physics/units.h"

namespace afm::physics {

// What one choice of tip, lever, sample and medium is to the force laws. The paper's law (Liu & Peng, Table 1) needs
// the first five alone.
struct ContactParameters {
  Length tip_radius;                  // R
  Stiffness spring_constant;          // k_c, of the cantilever
  Stiffness sample_stiffness;         // k_s of an elastic support beneath the contact, infinite for a rigid one
  Energy hamaker;                     // A_H, of tip and sample across the medium
  SurfaceEnergy mean_surface_energy;  // sqrt(gamma_s gamma_t), half of the work of adhesion (3.3)
  Pressure reduced_modulus{std::numeric_limits<double>::infinity()};  // E*, 1/E* = (1-nu_t^2)/E_t + (1-nu_s^2)/E_s
  Length atomic_distance{0.3e-9};                                     // z0, of the surface Lennard-Jones potential
};

// A value that no force microscope has; the message quotes it with its unit and the legal range.
class UnphysicalValue : public std::invalid_argument {
 public:
  UnphysicalValue(std::string field_name, const std::string& message)
      : std::invalid_argument(message), field_(std::move(field_name)) {}

  // The member of ContactParameters: "tip_radius".
  const std::string& field() const noexcept { return field_; }

 private:
  std::string field_;
};

// Throws UnphysicalValue unless every value is a number within: R 0.1 nm to 1 mm, k_c 1 uN/m to 1 MN/m, k_s 1 uN/m to
// infinity, A_H 1e-24 J to 1e-16 J, sqrt(gamma_s gamma_t) 1 nJ/m^2 to 100 J/m^2, E* 1 Pa to 10 TPa or infinite, z0
// 0.05 nm to 5 nm: what force microscopes are made of, with room to spare.
void validate(const ContactParameters& contact);

}  // namespace afm::physics
