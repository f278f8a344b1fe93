// SPDX-License-Identifier: Apache-2.0
#include "physics/cantilever.h"

#include <cmath>
#include <numbers>

#include "physics/flexural_modes.h"
#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {
namespace {

using namespace literals;

void require_dimension(const char* field, Length value) { require_range(field, value, 10_nm, 10_mm, kLengthUnits); }

void require_modulus(Pressure value) { require_range("young_modulus", value, 1e6_Pa, 1e4_GPa, kPressureUnits); }

}  // namespace

void validate(const RectangularLever& lever) {
  require_dimension("length", lever.length);
  require_dimension("width", lever.width);
  require_dimension("thickness", lever.thickness);
  require_modulus(lever.young_modulus);
  require_range("density", lever.density, Density(1.0), Density(30e3), kDensityUnits);
}

void validate(const VShapedLever& lever) {
  require_dimension("length", lever.length);
  require_dimension("base_width", lever.base_width);
  require_range("arm_width", lever.arm_width, 10_nm, 0.5 * lever.base_width, kLengthUnits);
  require_dimension("thickness", lever.thickness);
  require_modulus(lever.young_modulus);
}

Stiffness spring_constant(const RectangularLever& lever) {
  const double slenderness = lever.thickness / lever.length;
  return 0.25 * slenderness * slenderness * slenderness * (lever.young_modulus * lever.width);
}

Stiffness spring_constant(const VShapedLever& lever) {
  const double slenderness = lever.thickness / lever.length;
  const double cosine = std::cos(std::atan(0.5 * (lever.base_width / lever.length)));
  const double arm_share = lever.arm_width / lever.base_width;
  const double joint = 1.0 + 4.0 * arm_share * arm_share * arm_share * (3.0 * cosine - 2.0);
  return 0.5 * slenderness * slenderness * slenderness * cosine / joint * (lever.young_modulus * lever.arm_width);
}

Frequency vacuum_resonance(const RectangularLever& lever, int mode) {
  // the second moment I = w t^3/12 over the cross-section w t
  const double root = flexural_root(mode);
  const Velocity sound = sqrt(lever.young_modulus / lever.density);
  return root * root / (2.0 * std::numbers::pi * std::sqrt(12.0)) * (lever.thickness / lever.length) *
         (sound / lever.length);
}

Stiffness tilted_spring_constant(Stiffness spring_constant, double tilt_rad) {
  const double cosine = std::cos(tilt_rad);
  return spring_constant / (cosine * cosine);
}

Stiffness lateral_stiffness(const RectangularLever& lever, double poisson_ratio, Length tip_height) {
  return lateral_stiffness(spring_constant(lever), poisson_ratio, lever.length, tip_height);
}

Stiffness lateral_stiffness(Stiffness spring_constant, double poisson_ratio, Length length, Length tip_height) {
  const double slenderness = length / tip_height;
  return 2.0 / (3.0 * (1.0 + poisson_ratio)) * slenderness * slenderness * spring_constant;
}

}  // namespace afm::physics
