// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/soft_blocks.h"

#include "physics/law.h"
#include "physics/manipulation/ink.h"
#include "physics/meniscus.h"

namespace afm::scene {
namespace {

constexpr double kDotsAcross = 10.0;  // number of one-second dots along the inked square
constexpr double kSpareSquare = 1.5;  // squares left free, so that rounding adds none

static_assert(physics::InkedSurface::kTileSide == kTileSide && physics::InkedSurface::kMostSide >= kSoftSide);

}  // namespace

physics::Ink ink_of(const SharedInk& ink) noexcept {
  return {.molecules_per_s = ink.molecules_per_s, .footprint = physics::Area(ink.footprint_m2)};
}

double ink_dot_m(const physics::Ink& ink) noexcept { return 2.0 * physics::ink_dot_radius(ink, physics::Time(1.0)).si; }

double ink_side_m(const physics::Ink& ink) noexcept { return kDotsAcross * ink_dot_m(ink); }

double ink_reach_m(const physics::Ink& ink) noexcept {
  return 0.5 * (kSoftSide - kSpareSquare) / kSoftSide * ink_side_m(ink);
}

double meniscus_pull_n(double tip_radius_m, double surface_tension_n_per_m) noexcept {
  const physics::Meniscus wetting{.surface_tension = physics::SurfaceEnergy(surface_tension_n_per_m),
                                  .contact_angle_rad = 0.0};
  return physics::capillary_force(wetting, physics::Length(tip_radius_m)).si;
}

}  // namespace afm::scene
