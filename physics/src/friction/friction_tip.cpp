// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/friction_tip.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "physics/adhesive_contact.h"
#include "physics/contact_parameters.h"
#include "physics/hertz.h"
#include "require_range.h"

namespace afm::physics {

namespace {

// Over the root of the load, the area of JKR begins as a straight line and that of DMT as the 4/3-th power; the table
// is accurate to 1e-4 from some thousandth of the range on. Beyond the range it grows like a sphere's.
constexpr std::size_t kAreas = 1024;
constexpr double kDeepestShareOfRadius = 0.04;

template <class... Tips>
void check(const FrictionParameters& friction, const std::variant<Tips...>* tips) {
  if (!has_tip(friction.law, tips)) throw std::invalid_argument("the law of friction is unknown");
  ((Tips::kLaw == friction.law ? Tips::check(friction) : void()), ...);
}

template <class... Tips>
std::optional<FrictionTip> make_tip(const FrictionContact& at, const std::variant<Tips...>* /*of these*/) {
  std::optional<FrictionTip> tip;
  ((Tips::kLaw == at.friction.law ? void(tip.emplace(std::in_place_type<Tips>, at)) : void()), ...);
  return tip;
}

constexpr const FrictionTip* kTips = nullptr;  // null pointer that carries only its type

}  // namespace

void validate(const FrictionParameters& friction) {
  if (friction.law == FrictionLaw::None) return;
  require_range("lateral_stiffness", friction.lateral_stiffness, kSmallestLateralStiffness, kLargestLateralStiffness,
                kStiffnessUnits);
  check(friction, kTips);
}

FrictionTip friction_tip(const FrictionContact& at) {
  validate(at.friction);
  auto tip = make_tip(at, kTips);
  if (!tip) throw std::invalid_argument("FrictionLaw::None has no tip that is held");
  return *std::move(tip);
}

void AmontonsYield::check(const FrictionParameters& friction) {
  if (friction.coefficient > 0.0 && friction.coefficient <= kLargestFrictionCoefficient) return;
  throw UnphysicalValue("friction_coefficient", "friction coefficient " + std::to_string(friction.coefficient) +
                                                    " is not above 0 and at most 10");
}

void ContactAreaYield::check(const FrictionParameters& friction) {
  require_range("shear_strength", friction.shear_strength, Pressure(1.0), kLargestShearStrength, kPressureUnits);
}

ContactAreaYield::ContactAreaYield(const FrictionContact& at) : shear_strength_(at.friction.shear_strength) {
  const AdhesiveContact adhesive = adhesive_contact(at.contact);
  const Force largest = at.adhesion + hertz_load(adhesive, kDeepestShareOfRadius * at.contact.tip_radius);
  root_step_ = std::sqrt(largest.si) / static_cast<double>(kAreas - 1);
  for (std::size_t i = 0; i < kAreas; ++i) {
    const double root = root_step_ * static_cast<double>(i);
    areas_m2_.push_back(contact_area(at.law, at.contact, Force(root * root) - at.adhesion).si);
  }
}

Force ContactAreaYield::at(Force load) const noexcept {
  const double place = std::sqrt(load.si) / root_step_, last = static_cast<double>(kAreas - 1);
  if (!(place < last)) return shear_strength_ * Area(areas_m2_.back() * std::pow(place / last, 4.0 / 3.0));
  const auto i = static_cast<std::size_t>(place);
  const double area_m2 = areas_m2_[i] + (place - static_cast<double>(i)) * (areas_m2_[i + 1] - areas_m2_[i]);
  return shear_strength_ * Area(area_m2);
}

void WellTip::check(const FrictionParameters& friction) {
  require_range("lattice_period", friction.period, kSmallestPeriod, kLargestPeriod, kLengthUnits);
  require_range("lattice_corrugation", friction.corrugation, Length(1e-15), kLargestCorrugation, kLengthUnits);
}

WellTip::WellTip(const FrictionContact& at)
    : corrugation_(at.friction.corrugation),
      tip_(at.friction.lattice, at.friction.period, at.friction.lateral_stiffness) {}

}  // namespace afm::physics
