// SPDX-License-Identifier: Apache-2.0
#include "physics/elasticity.h"

#include <string>

#include "physics/interaction.h"
#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

using namespace literals;

// (1 - nu^2)/E, per pascal. Written so that NaN is refused.
double compliance(const Elasticity& body, const std::string& name) {
  const Pressure smallest = 1_Pa, largest = 10000_GPa;
  if (!(body.modulus >= smallest && body.modulus <= largest)) {
    throw UnphysicalValue(name + "_modulus", "modulus of the " + name + " " +
                                                 format_quantity(body.modulus, kPressureUnits) + " is not within " +
                                                 format_quantity(smallest, kPressureUnits) + " to " +
                                                 format_quantity(largest, kPressureUnits));
  }
  if (!(body.poisson_ratio >= -1.0 && body.poisson_ratio <= 0.5)) {
    throw UnphysicalValue(name + "_poisson_ratio", "Poisson's ratio of the " + name + " " +
                                                       std::to_string(body.poisson_ratio) + " is not within -1 to 0.5");
  }
  return (1.0 - body.poisson_ratio * body.poisson_ratio) / body.modulus.si;
}

}  // namespace

Pressure reduced_modulus(const Elasticity& tip, const Elasticity& sample) {
  return Pressure(1.0 / (compliance(tip, "tip") + compliance(sample, "sample")));
}

}  // namespace afm::physics
