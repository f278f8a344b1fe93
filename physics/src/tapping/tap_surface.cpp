// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tap_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "physics/dynamic_law.h"
#include "physics/force_laws.h"
#include "physics/quantity_text.h"
#include "require_range.h"
#include "tapping/swing_quadrature.h"

namespace afm::physics {
namespace {

// The law as functions of the height, with what the quadrature needs.
template <class FreeForce, class AttachedForce>
struct SwungLaw {
  FreeForce free;
  AttachedForce attached;
  double contact, release, zero_of_indentation, viscous;
};

// Distance of the force's pole below contact, for a law whose contact is at a height of zero.
constexpr double kPoleBelowContact = 0.3e-9;

template <class SwungLaw>
SwingAverages averages_over(const TapSwing& swing, const SwungLaw& law, SwingShape* shape) {
  constexpr double kPi = std::numbers::pi;
  const double amplitude = swing.amplitude.si, bottom = swing.centre.si - amplitude;
  const HarmonicResponse response = shape != nullptr ? shape->response() : HarmonicResponse(1.0, swing.ratio);
  const double friction = law.viscous * amplitude * swing.angular_rate;
  const SwingGeometry geometry{amplitude, bottom, law.zero_of_indentation, response,
                               shape,     1.0,    law.viscous > 0.0,       friction};
  SwingGeometry one_way = geometry;
  one_way.ways = 0.5;
  one_way.friction = 0.0;  // in contact it is on its way up
  if (shape != nullptr) shape->begin();
  const double pole = law.contact - (law.zero_of_indentation > 0.0 ? law.zero_of_indentation : kPoleBelowContact);

  const bool touches = bottom <= law.contact;
  const bool stuck = touches && swing.centre.si + amplitude <= law.release;
  double in = touches ? geometry.angle(law.contact) : 0.0;         // contact on the way down
  const double off = touches ? geometry.angle(law.release) : 0.0;  // release on the way up
  if (stuck) in = off;
  const SwingSums pressed = geometry.in_contact(0.0, in, law.attached);
  const SwingSums drawn = one_way.in_contact(in, off, law.attached);
  const SwingSums falling = one_way.above_contact(in, off, pole, law.free);
  const SwingSums away = geometry.above_contact(off, kPi, pole, law.free);
  const SwingSums all = pressed + pressed + drawn + falling + away + away;

  SwingAverages result;
  result.mean = Force(all.force / (2.0 * kPi));
  result.shift_at_lowest = Force(all.shift / (2.0 * kPi));
  result.virial = Energy(-amplitude * all.cosine / (2.0 * kPi));
  result.lost = Energy(amplitude * (falling.work - drawn.work) +
                       law.viscous * amplitude * amplitude * swing.angular_rate * all.viscous);
  result.peak = Force(std::max(touches ? law.attached(bottom) : law.free(bottom), all.highest));
  result.lowest = Length(bottom);
  result.contact_share = (in + off) / (2.0 * kPi);
  return result;
}

// The point at a height of a branch along which the height is monotone in the parameter.
LawPoint point_at(const LawBranch& branch, double height) {
  double low = branch.first, high = branch.last;
  const bool rises = branch.at(high).h > branch.at(low).h;
  double s = 0.5 * (low + high);
  for (int i = 0; i < 200; ++i) {
    const LawPoint point = branch.at(s);
    const double missing = height - point.h.si;
    if (missing == 0.0 || high - low < 1e-15 * std::max(1.0, std::abs(s))) return point;
    ((missing > 0.0) == rises ? low : high) = s;
    const double newton = s + missing / point.dh_ds;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - s) < 1e-14 * std::max(1.0, std::abs(s))) return branch.at(next);
    s = next;
  }
  return branch.at(s);
}

}  // namespace

TapSurface::TapSurface(Law law, const ContactParameters& contact, const LawOptions& options, Viscosity viscosity)
    : contact_(contact),
      grips_(fixed_grips_tables(law, contact, options)),
      law_(force_law(law, contact, options)),
      viscous_si_(viscosity.si * std::sqrt(contact.tip_radius.si)) {
  if (!has_averaged_swings(law)) {
    std::string others;
    for (const Law other : laws_with(&LawTraits::dynamic)) {
      if (has_averaged_swings(other)) others += (others.empty() ? "" : ", ") + std::string(name_of(other));
    }
    throw std::invalid_argument("the law " + std::string(name_of(law)) +
                                " is that of rigid bodies, on which no swing can be averaged: take one of " + others);
  }
  if (!(viscosity.si >= 0.0 && viscosity.si <= 1e6)) {
    throw UnphysicalValue("viscosity", "the viscosity is not within 0 to 1e6 Pa*s");
  }
}

SwingAverages TapSurface::averages(const TapSwing& swing, SwingShape* shape) const noexcept {
  const auto free = [this](double height) { return grips_->free.force(Length(height)).si; };
  const auto attached = [this](double height) { return grips_->attached.force(Length(height)).si; };
  return averages_over(
      swing, SwungLaw{free, attached, contact_height().si, release_height().si, zero_of_indentation().si, viscous_si_},
      shape);
}

SwingAverages TapSurface::exact_averages(const TapSwing& swing) const {
  const auto free = [this](double height) { return point_at(law_.free, height).force.si; };
  const auto attached = [this](double height) { return point_at(law_.attached, height).force.si; };
  return averages_over(
      swing, SwungLaw{free, attached, contact_height().si, release_height().si, zero_of_indentation().si, viscous_si_},
      nullptr);
}

Stiffness TapSurface::exact_gradient(Length height) const {
  const LawPoint point = point_at(height > contact_height() ? law_.free : law_.attached, height.si);
  return Stiffness(point.dforce_ds / point.dh_ds);
}

std::shared_ptr<const TipForce> TapSurface::tip_force(Length amplitude) const {
  const Force pull_off = abs(grips_->figures.force_before_joc);
  return std::make_shared<const TipForce>(*grips_, std::max(10.0 * pull_off, contact_.spring_constant * amplitude));
}

double TapSurface::friction_si(Length height) const noexcept {
  const double indentation = zero_of_indentation().si - height.si;
  return indentation > 0.0 ? viscous_si_ * std::sqrt(indentation) : 0.0;
}

}  // namespace afm::physics
