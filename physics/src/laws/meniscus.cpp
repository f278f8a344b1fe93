// SPDX-License-Identifier: Apache-2.0
#include "physics/meniscus.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/branch_parametrisation.h"

namespace afm::physics {
namespace {

using std::numbers::pi;

// Ends a branch at a height, if the branch passes it.
void cut_at(LawBranch& branch, Length height) {
  double near = branch.first;
  double beyond = branch.last;
  const bool falls = branch.at(near).h > branch.at(beyond).h;
  const auto passed = [&](double s) { return (branch.at(s).h < height) == falls; };
  if (!passed(beyond) || passed(near)) return;
  for (;;) {
    const double middle = 0.5 * (near + beyond);
    if (middle == near || middle == beyond) break;
    (passed(middle) ? beyond : near) = middle;
  }
  branch.last = near;
  std::erase_if(branch.kinks, [near](double kink) { return kink >= near; });
}

}  // namespace

Force capillary_force(const Meniscus& meniscus, Length tip_radius) noexcept {
  return 4.0 * pi * std::cos(meniscus.contact_angle_rad) * tip_radius * meniscus.surface_tension;
}

Length film_height(const Meniscus& meniscus) noexcept {
  constexpr double kHamaker = 1e-20;            // Hamaker constant of the water film, J
  constexpr double kGasConstant = 8.314462618;  // molar gas constant, J/(mol K)
  constexpr double kTemperature = 293.15;       // room temperature, K
  constexpr double kMolarVolume = 18.05e-6;     // molar volume of water, m^3/mol
  const double pressure = kGasConstant * kTemperature / kMolarVolume * std::log(1.0 / meniscus.relative_humidity);
  return Length(std::cbrt(kHamaker / (6.0 * pi * pressure)));
}

Length bridge_formation_gap(const Meniscus& meniscus) noexcept { return 2.0 * film_height(meniscus); }

Length bridge_rupture_gap(const Meniscus& meniscus, Length tip_radius) noexcept {
  const Length film = film_height(meniscus);
  return std::max(cbrt(4.0 * pi * tip_radius * film * film), bridge_formation_gap(meniscus));
}

ForceLaw with_meniscus(const ForceLaw& law, const Meniscus& meniscus, Length tip_radius) {
  ForceLaw wet = law;
  const Length contact = law.free.at(law.free.last).h;
  cut_at(wet.attached, contact + bridge_rupture_gap(meniscus, tip_radius));
  const Length attached_end = wet.attached.at(wet.attached.last).h;
  cut_at(wet.free, std::min(contact + bridge_formation_gap(meniscus), attached_end));
  if (law.attached_end_potential && wet.attached.last < law.attached.last) {
    // F = -dU/dh, from where the dry law's potential is known
    wet.attached_end_potential =
        *law.attached_end_potential + work_along(law.attached, wet.attached.last, law.attached.last);
  }

  const Force pull = capillary_force(meniscus, tip_radius);
  wet.attached.at = [dry = law.attached.at, pull](double s) {
    LawPoint point = dry(s);
    point.force = point.force - pull;
    return point;
  };
  return wet;
}

}  // namespace afm::physics
