// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/lateral_contact.h"

namespace afm::physics {

LateralContact::LateralContact(const FrictionParameters& friction, Law law, const ContactParameters& contact,
                               Force adhesion)
    : stiffness_(friction.lateral_stiffness), tip_(friction_tip({friction, law, contact, adhesion})) {}

LateralContact::Step LateralContact::touch_down(const Sideways<Length>& support, Force load) noexcept {
  touching_ = true;
  return std::visit([&](auto& tip) { return tip.touch_down(support, load); }, tip_);
}

LateralContact::Step LateralContact::slide_to(const Sideways<Length>& support, Force load) noexcept {
  return std::visit([&](auto& tip) { return tip.slide_to(support, load); }, tip_);
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
  if (!touching_) return {};
  return std::visit([](const auto& tip) { return tip.lift_per_load(); }, tip_);
}

}  // namespace afm::physics
