// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/lateral_contact.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "physics/adhesive_contact.h"
#include "physics/hertz.h"

namespace afm::physics {

namespace {

// Against the root of the load the area of JKR begins straight and that of DMT as the 4/3-th power: 1e-4 of it from
// some thousandth of the range on. Beyond, it grows as a sphere's.
constexpr std::size_t kAreas = 1024;
constexpr double kDeepestShareOfRadius = 0.04;

}  // namespace

LateralContact::Tip LateralContact::tip_of(const FrictionParameters& friction) {
  validate(friction);
  if (friction.law == FrictionLaw::None) throw std::invalid_argument("no friction has no tip that is held");
  if (friction.law != FrictionLaw::Lattice) return AnchoredTip(friction.lateral_stiffness);
  return LatticeTip(friction.lattice, friction.period, friction.lateral_stiffness);
}

LateralContact::LateralContact(const FrictionParameters& friction, Law law, const ContactParameters& contact,
                               Force adhesion)
    : parameters_(friction), tip_(tip_of(friction)) {
  if (friction.law != FrictionLaw::ContactArea) return;
  const AdhesiveContact adhesive = adhesive_contact(contact);
  const Force largest = adhesion + hertz_load(adhesive, kDeepestShareOfRadius * contact.tip_radius);
  root_step_ = std::sqrt(largest.si) / static_cast<double>(kAreas - 1);
  for (std::size_t i = 0; i < kAreas; ++i) {
    const double root = root_step_ * static_cast<double>(i);
    areas_m2_.push_back(contact_area(law, contact, Force(root * root) - adhesion).si);
  }
}

Force LateralContact::yield(Force load) const noexcept {
  if (parameters_.law == FrictionLaw::Amontons) return parameters_.coefficient * load;
  if (parameters_.law == FrictionLaw::Lattice) {
    const Energy row = scale(load) / (LatticeLandscape::scale_of_row(parameters_.lattice, Energy(1.0)).si);
    return std::numbers::pi * row / parameters_.period;
  }
  const double place = std::sqrt(load.si) / root_step_, last = static_cast<double>(kAreas - 1);
  if (!(place < last)) return parameters_.shear_strength * Area(areas_m2_.back() * std::pow(place / last, 4.0 / 3.0));
  const auto i = static_cast<std::size_t>(place);
  const double area_m2 = areas_m2_[i] + (place - static_cast<double>(i)) * (areas_m2_[i + 1] - areas_m2_[i]);
  return parameters_.shear_strength * Area(area_m2);
}

LateralContact::Step LateralContact::touch_down(const Sideways<Length>& support, Force load) noexcept {
  touching_ = true;
  if (auto* lattice = std::get_if<LatticeTip>(&tip_)) return lattice->land(support, scale(load));
  std::get_if<AnchoredTip>(&tip_)->land(support);
  return {};
}

LateralContact::Step LateralContact::slide_to(const Sideways<Length>& support, Force load) noexcept {
  if (auto* lattice = std::get_if<LatticeTip>(&tip_)) return lattice->move_to(support, scale(load));
  Step step;
  step.lost = std::get_if<AnchoredTip>(&tip_)->move_to(support, yield(load));
  return step;
}

Sideways<Force> LateralContact::force() const noexcept {
  if (!touching_) return {};
  return std::visit([](const auto& tip) { return tip.force(); }, tip_);
}

Energy LateralContact::stored() const noexcept {
  if (!touching_) return {};
  return std::visit([](const auto& tip) { return tip.stored(); }, tip_);
}

Length LateralContact::lift_per_load() const noexcept {
  const auto* lattice = std::get_if<LatticeTip>(&tip_);
  return touching_ && lattice != nullptr ? lattice->relief() * parameters_.corrugation : Length();
}

}  // namespace afm::physics
