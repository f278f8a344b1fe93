// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shared/field_visitor.h"
#include "scene/shared/name.h"
#include "scene/shared/soft_blocks.h"

// Block of the ink with which a tip writes (docs/manipulation.md, "Ink").
namespace afm::physics {
struct Ink;
}

namespace afm::scene {

// ---- constant after the segment is created (written by touchafm, part of SharedParticles) ----

// physics::Ink in plain numbers, SI, and what a hand feels of it. Radius of the tip and normal spring of the lever are
// those of SharedPusher. The field of the tip is a square around the origin of the sample, published as MarkTiles:
// `pressed_m` is the thickness of the layer where ink covers a square, and 0 elsewhere.
struct SharedInk {
  Name name{};
  double molecules_per_s = 0;  // 0: there is no ink, and all else is ignored
  double footprint_m2 = 0;
  double thickness_m = 0;              // of the layer, kThickestLayerM at most
  double surface_tension_n_per_m = 0;  // of the liquid between tip and sample

  bool operator==(const SharedInk&) const = default;
};

template <class Visit, RecordOf<SharedInk>... Record>
constexpr void for_each_field(Visit&& visit, Record&... ink) {
  visit("name", ink.name...);
  visit("molecules_per_s", ink.molecules_per_s...);
  visit("footprint_m2", ink.footprint_m2...);
  visit("thickness_m", ink.thickness_m...);
  visit("surface_tension_N_per_m", ink.surface_tension_n_per_m...);
}
static_assert(all_fields_described<SharedInk>());

inline constexpr double kThickestLayerM = 1e-6;

physics::Ink ink_of(const SharedInk& ink) noexcept;

// Diameter of the dot of a second, which is to have the size of a hand.
double ink_dot_m(const physics::Ink& ink) noexcept;

// Side of the inked square, kSoftSide of its grid's squares, and half the side of the square in which the tip may be.
double ink_side_m(const physics::Ink& ink) noexcept;
double ink_reach_m(const physics::Ink& ink) noexcept;

// Force that tears the tip off the liquid: 4 pi R gamma.
double meniscus_pull_n(double tip_radius_m, double surface_tension_n_per_m) noexcept;

}  // namespace afm::scene
