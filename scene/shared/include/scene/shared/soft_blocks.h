// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/shared/field_visitor.h"
#include "scene/shared/name.h"

// Blocks of samples on which a tip leaves marks: a soft sample that it scratches, and one on which it writes with
// ink (docs/manipulation.md, "Scratches" and "Ink").
namespace afm::physics {
struct Ink;
struct SoftSurface;
}  // namespace afm::physics

namespace afm::scene {

// ---- constant after the segment is created (written by touchafm, part of SharedParticles) ----

// physics::SoftSurface in plain numbers, SI. Tip and lever are those of SharedPusher. The field of the tip is a square
// around the origin of the sample.
struct SharedSoft {
  Name name{};
  double hardness_pa = 0;  // 0: no soft sample, and all other fields are ignored
  double reduced_modulus_pa = 0;
  double work_of_adhesion_j_per_m2 = 0;
  double pile_up_share = 0;

  bool operator==(const SharedSoft&) const = default;
};

template <class Visit, RecordOf<SharedSoft>... Record>
constexpr void for_each_field(Visit&& visit, Record&... soft) {
  visit("name", soft.name...);
  visit("hardness_Pa", soft.hardness_pa...);
  visit("reduced_modulus_Pa", soft.reduced_modulus_pa...);
  visit("work_of_adhesion_J_per_m2", soft.work_of_adhesion_j_per_m2...);
  visit("pile_up_share", soft.pile_up_share...);
}
static_assert(all_fields_described<SharedSoft>());

physics::SoftSurface soft_surface(const SharedSoft& soft);

// Number of squares of a soft sample along each of x and y; a tip stays some squares away from its edge.
inline constexpr std::uint32_t kSoftSide = 256;

// Half the side of the square that a tip of this radius may reach.
double soft_reach_m(double tip_radius_m) noexcept;

// physics::Ink in plain numbers, SI, with the quantities felt by a hand. Radius of the tip and normal spring are
// those of SharedPusher. The field of the tip is a square around the origin of the sample, published as MarkTiles:
// `pressed_m` is the thickness of the layer where ink covers a square, and 0 elsewhere.
struct SharedInk {
  Name name{};
  double molecules_per_s = 0;  // 0: no ink, and all other fields are ignored
  double footprint_m2 = 0;
  double thickness_m = 0;              // height of the layer, at most kThickestLayerM
  double surface_tension_n_per_m = 0;  // surface tension of the liquid between tip and sample

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

// Diameter of the dot written in one second; the scale of the hand fits it.
double ink_dot_m(const physics::Ink& ink) noexcept;

// Side of the inked square, kSoftSide squares of its grid; and half the side of the square that the tip may reach.
double ink_side_m(const physics::Ink& ink) noexcept;
double ink_reach_m(const physics::Ink& ink) noexcept;

// Force that tears the tip off the liquid: 4 pi R gamma.
double meniscus_pull_n(double tip_radius_m, double surface_tension_n_per_m) noexcept;

// ---- written by touchafm-servo ----

// State of writing with ink; part of TipPush.
struct InkPush {
  double covered_m2 = 0;     // area of all strokes
  double flowed_s = 0;       // duration of the newest touch
  double speed_m_per_s = 0;  // speed along the sample, averaged over a tenth of a second

  bool operator==(const InkPush&) const = default;
};

template <class Visit, RecordOf<InkPush>... Record>
constexpr void for_each_field(Visit&& visit, Record&... ink) {
  visit("covered_m2", ink.covered_m2...);
  visit("flowed_s", ink.flowed_s...);
  visit("speed_m_per_s", ink.speed_m_per_s...);
}
static_assert(all_fields_described<InkPush>());

inline constexpr std::uint32_t kTileSide = 16;  // number of squares on a side
inline constexpr std::uint32_t kMarkTiles = (kSoftSide / kTileSide) * (kSoftSide / kTileSide);

// Squares of a soft sample, as in physics::MarkedSurface, or of ink (SharedInk). The servo stores all of them
// when it starts, and one that has changed in each tick.
struct MarkTile {
  std::array<double, std::size_t{kTileSide} * kTileSide> pressed_m{};  // heights under the tip that pressed last
  std::array<double, std::size_t{kTileSide} * kTileSide> back_m{};     // elastic rise of these heights without load

  bool operator==(const MarkTile&) const = default;
};

// Mark of a tile, 0 if nothing has ever touched it; the digest of a soft sample, or of ink, is the sum of kSoftDigest
// and the marks of all tiles, modulo 2^64. Bit for bit.
inline constexpr std::uint64_t kSoftDigest = 1;
std::uint64_t tile_mark(std::size_t number, const MarkTile& tile) noexcept;
std::uint64_t digest_of(std::span<const MarkTile> tiles) noexcept;

inline constexpr double kMostMarkM = 1e-6;

// True if the heights are finite and at most kMostMarkM.
bool is_valid(const MarkTile& tile);

}  // namespace afm::scene
