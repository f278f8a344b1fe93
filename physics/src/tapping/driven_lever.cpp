// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/driven_lever.h"

#include <cmath>
#include <numbers>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {

double DrivenLever::angular_resonance() const noexcept { return 2.0 * std::numbers::pi * resonance.si; }
double DrivenLever::angular_drive() const noexcept { return ratio * angular_resonance(); }
Time DrivenLever::relaxation() const noexcept { return Time(2.0 * quality_factor / angular_resonance()); }

DrivenLever driven_lever(Stiffness spring_constant, const LeverDynamics& lever, const Drive& drive) {
  using namespace literals;
  validate(lever);
  require_range("quality_factor", lever.quality_factor, 0.5, 1e5, kPlainNumber);
  require_range("free_amplitude", drive.free_amplitude, 10_pm, 10_um, kLengthUnits);
  require_range("drive", drive.frequency, 0.5 * lever.resonance, 1.5 * lever.resonance, kFrequencyUnits);
  DrivenLever driven;
  driven.spring_constant = spring_constant;
  driven.resonance = lever.resonance;
  driven.quality_factor = lever.quality_factor;
  driven.ratio = drive.frequency / lever.resonance;
  driven.free_amplitude = drive.free_amplitude;
  const double r = driven.ratio, damping = r / driven.quality_factor;
  driven.base_amplitude = drive.free_amplitude * std::hypot(1.0 - r * r, damping);
  driven.free_phase = std::atan2(damping, 1.0 - r * r);
  return driven;
}

Energy cleveland_energy(const DrivenLever& lever, Length amplitude, double phase_rad) noexcept {
  const double air = lever.ratio / lever.quality_factor;
  const Stiffness k = lever.spring_constant;
  return std::numbers::pi * k * amplitude * (lever.base_amplitude * std::sin(phase_rad) - air * amplitude);
}

}  // namespace afm::physics
