// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>

#include "physics/contact_parameters.h"

namespace afm::physics {

// Tips, levers, samples and media that a force microscope may meet, each value spread evenly over its orders of
// magnitude. The sequence is the same in every run.
class RandomInteraction {
 public:
  explicit RandomInteraction(std::mt19937_64::result_type seed) : random_(seed) {}

  // Random number from `smallest` to `largest`, uniform in the logarithm.
  double between(double smallest, double largest) {
    // computed here, since standard libraries differ in their distributions from the same engine
    const double unit = static_cast<double>(random_() >> 11) * 0x1.0p-53;
    return smallest * std::pow(largest / smallest, unit);
  }

  ContactParameters operator()() {
    ContactParameters contact;
    contact.tip_radius = Length(between(2e-9, 5e-6));
    contact.spring_constant = Stiffness(between(0.005, 100.0));
    contact.sample_stiffness = Stiffness(HUGE_VAL);
    contact.hamaker = Energy(between(1e-21, 5e-19));
    contact.mean_surface_energy = SurfaceEnergy(between(2e-4, 0.5));
    contact.reduced_modulus = Pressure(between(1e5, 5e11));
    contact.atomic_distance = Length(between(0.15e-9, 0.5e-9));
    return contact;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace afm::physics
