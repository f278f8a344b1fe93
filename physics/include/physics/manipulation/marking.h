// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/manipulation/tip_contact.h"
#include "physics/units.h"

// Depth of the marks of a sphere-cone tip in a soft surface: closed forms (docs/manipulation.md, "Scratches"; equation
// numbers (M50) on). Depths are positive downwards, from the surface before the first mark. Any thread.
namespace afm::physics {

// A surface that flows where a tip presses it with its hardness, at any speed.
struct SoftSurface {
  Pressure hardness;               // H, hardness of the surface
  Pressure reduced_modulus;        // E* of tip and surface, their reduced modulus
  SurfaceEnergy work_of_adhesion;  // W of tip and surface, work of adhesion
  double pile_up_share = 0.0;      // share of the volume of a groove that is piled up beside it; the rest is densified
};

// Throws UnphysicalValue with the field hardness, sample_modulus, work_of_adhesion or pile_up_share. A surface with
// less than five times its hardness as E* springs back as a whole, and is refused.
void validate(const SoftSurface& surface);

// Throws UnphysicalValue with the field tip_radius or half_angle if the flank is too steep or too flat.
void validate_marking_tip(const SphereCone& tip);

// The outline of a tip of validate_marking_tip(): heights above its apex.
class TipOutline {
 public:
  explicit TipOutline(const SphereCone& tip) noexcept;

  Length radius_at(Length height) const noexcept;
  Length height_at(Length radius) const noexcept;
  Length rim_height() const noexcept { return Length(rim_height_m_); }  // height of the border between cap and cone

 private:
  double cap_m_, rim_radius_m_, rim_height_m_, slope_;
};

// A(d) = pi (2 R d - d^2) on the cap, pi r(d)^2 on the cone (M50).
Area tip_area(const SphereCone& tip, Length depth) noexcept;

// A_v(d): area of the tip below the surface, seen along its way (M51).
Area groove_section(const SphereCone& tip, Length depth) noexcept;

// Depth under load: of a tip at rest, H A(d) = F, and of one that is dragged over a fresh surface, where the front
// half alone bears, H A(d)/2 = F (M52).
Length imprint_depth(const SphereCone& tip, const SoftSurface& surface, Force load) noexcept;
Length groove_depth(const SphereCone& tip, const SoftSurface& surface, Force load) noexcept;

// Radius of the contact of a tip at rest and of a dragged one: sqrt(F/(pi H)) and sqrt(2 F/(pi H)).
Length imprint_radius(const SoftSurface& surface, Force load) noexcept;
Length groove_radius(const SoftSurface& surface, Force load) noexcept;

// 0.75 F/(2 E* a), by which the middle of a mark rises when the tip has left (M53; Oliver & Pharr 1992, exponent 1.5).
Length spring_back(const SoftSurface& surface, Force load, Length contact_radius) noexcept;

// Load of a standing tip below which all of the imprint springs back. On the cap for every valid surface and tip.
Force least_marking_load(const SphereCone& tip, const SoftSurface& surface) noexcept;

// Load at which a dragged tip begins to touch with its cone.
Force cap_load(const SphereCone& tip, const SoftSurface& surface) noexcept;

// Height of two parabolic ridges, each half as wide as the groove, that hold the share of its section (M56).
Length ridge_height(Area section, double share, Length width) noexcept;

// Hertz' part of JKR's pressure in the middle of a touch without load, 3 K a_0/(2 pi R) (M57).
Pressure touching_pressure(const SphereCone& tip, const SoftSurface& surface);

// 1.6 Y, with Y = H/3: a larger pressure makes the surface flow.
Pressure yield_pressure(const SoftSurface& surface) noexcept;

}  // namespace afm::physics
