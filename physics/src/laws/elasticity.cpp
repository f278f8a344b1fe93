// SPDX-License-Identifier: Apache-2.0
#include "physics/elasticity.h"

#include <string>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {
namespace {

using namespace literals;

// (1 - nu^2)/E, per pascal.
double compliance(const Elasticity& body, const std::string& name) {
  require_range(name + "_modulus", body.modulus, 1_Pa, 10000_GPa, kPressureUnits);
  // written so that NaN is refused; a body of -1 would be rigid, whatever its modulus
  if (!(body.poisson_ratio > -1.0 && body.poisson_ratio <= 0.5)) {
    throw UnphysicalValue(name + "_poisson_ratio", name + " poisson ratio " + std::to_string(body.poisson_ratio) +
                                                       " is not above -1 and at most 0.5");
  }
  return (1.0 - body.poisson_ratio * body.poisson_ratio) / body.modulus.si;
}

}  // namespace

Pressure reduced_modulus(const Elasticity& tip, const Elasticity& sample) {
  return Pressure(1.0 / (compliance(tip, "tip") + compliance(sample, "sample")));
}

}  // namespace afm::physics
