// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/marking.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/adhesive_contact.h"
#include "physics/contact_parameters.h"
#include "physics/jkr.h"
#include "physics/quantity_text.h"
#include "require_range.h"

namespace afm::physics {
namespace {

using std::numbers::pi;

constexpr double kSteepest = 0.08, kWidestCone = 1.05;  // limits of the half angle in radians, 4.6 and 60 degrees
constexpr double kStiffest = 5.0;                       // smallest ratio of E* to H
constexpr double kSpringBack = 0.75;
constexpr double kConstraint = 3.0;  // Tabor's constraint factor H/Y
constexpr double kYields = 1.6;      // mean pressure over Y at which a ball begins to leave a mark

Length depth_of(const SphereCone& tip, Area area) { return TipOutline(tip).height_at(Length(std::sqrt(area.si / pi))); }

}  // namespace

void validate(const SoftSurface& surface) {
  require_range("hardness", surface.hardness, Pressure(1e6), Pressure(1e11), kPressureUnits);
  require_range("work_of_adhesion", surface.work_of_adhesion, SurfaceEnergy(0.0), SurfaceEnergy(10.0),
                kSurfaceEnergyUnits);
  require_range("pile_up_share", surface.pile_up_share, 0.0, 1.0, kPlainNumber);
  if (!(surface.reduced_modulus >= kStiffest * surface.hardness)) {
    throw UnphysicalValue("sample_modulus",
                          "with tip and sample together at " +
                              format_quantity(surface.reduced_modulus, kPressureUnits) +
                              ", less than five times the hardness, the sample springs back as a whole");
  }
}

void validate_marking_tip(const SphereCone& tip) {
  require_range("tip_radius", tip.radius, Length(1e-9), Length(1e-6), kLengthUnits);
  require_angle("half_angle", tip.half_angle_rad, kSteepest, kWidestCone);
}

TipOutline::TipOutline(const SphereCone& tip) noexcept
    : cap_m_(tip.radius.si),
      rim_radius_m_(tip.radius.si * std::cos(tip.half_angle_rad)),
      rim_height_m_(tip.radius.si * (1.0 - std::sin(tip.half_angle_rad))),
      slope_(1.0 / std::tan(tip.half_angle_rad)) {}

Length TipOutline::radius_at(Length height) const noexcept {
  const double h = std::max(0.0, height.si);
  if (h <= rim_height_m_) return Length(std::sqrt(std::max(0.0, h * (2.0 * cap_m_ - h))));
  return Length(rim_radius_m_ + (h - rim_height_m_) / slope_);
}

Length TipOutline::height_at(Length radius) const noexcept {
  const double r = radius.si;
  // r^2/(R + sqrt(R^2 - r^2)) keeps its digits where r is small
  if (r <= rim_radius_m_) return Length(r * r / (cap_m_ + std::sqrt(std::max(0.0, cap_m_ * cap_m_ - r * r))));
  return Length(rim_height_m_ + (r - rim_radius_m_) * slope_);
}

Area tip_area(const SphereCone& tip, Length depth) noexcept {
  const Length radius = TipOutline(tip).radius_at(depth);
  return pi * (radius * radius);
}

Area groove_section(const SphereCone& tip, Length depth) noexcept {
  const TipOutline outline(tip);
  const double big = tip.radius.si, d = std::max(0.0, depth.si), cap = std::min(d, outline.rim_height().si);
  const double half = outline.radius_at(Length(cap)).si;
  const double of_cap = big * big * std::acos(std::clamp(1.0 - cap / big, -1.0, 1.0)) - (big - cap) * half;
  // of the cone, a trapezium
  return Area(of_cap + (d - cap) * (half + outline.radius_at(Length(d)).si));
}

Length imprint_depth(const SphereCone& tip, const SoftSurface& surface, Force load) noexcept {
  return depth_of(tip, load / surface.hardness);
}

Length groove_depth(const SphereCone& tip, const SoftSurface& surface, Force load) noexcept {
  return depth_of(tip, 2.0 * (load / surface.hardness));
}

Length imprint_radius(const SoftSurface& surface, Force load) noexcept {
  return Length(std::sqrt(load.si / (pi * surface.hardness.si)));
}

Length groove_radius(const SoftSurface& surface, Force load) noexcept { return imprint_radius(surface, 2.0 * load); }

Length spring_back(const SoftSurface& surface, Force load, Length contact_radius) noexcept {
  return kSpringBack * (load / (2.0 * (surface.reduced_modulus * contact_radius)));
}

Force least_marking_load(const SphereCone& tip, const SoftSurface& surface) noexcept {
  // R - sqrt(R^2 - a^2) = b a, with b a the spring-back at F = pi a^2 H
  const double b = kSpringBack * pi * surface.hardness.si / (2.0 * surface.reduced_modulus.si);
  const double radius_m = 2.0 * b * tip.radius.si / (1.0 + b * b);
  return Force(pi * radius_m * radius_m * surface.hardness.si);
}

Force cap_load(const SphereCone& tip, const SoftSurface& surface) noexcept {
  return 0.5 * (surface.hardness * tip_area(tip, TipOutline(tip).rim_height()));
}

Length ridge_height(Area section, double share, Length width) noexcept {
  // both together have two thirds of width times height
  return 1.5 * share * (section / width);
}

Pressure touching_pressure(const SphereCone& tip, const SoftSurface& surface) {
  const AdhesiveContact contact{tip.radius, surface.reduced_modulus, surface.work_of_adhesion};
  const Length radius = jkr_contact_radius(contact, Force(0.0));
  return (2.0 / pi) * surface.reduced_modulus * (radius / tip.radius);
}

Pressure yield_pressure(const SoftSurface& surface) noexcept { return kYields / kConstraint * surface.hardness; }

}  // namespace afm::physics
