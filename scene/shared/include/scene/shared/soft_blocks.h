// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/shared/field_visitor.h"
#include "scene/shared/name.h"

// Blocks of a soft sample that a tip scratches (docs/manipulation.md, "Scratches").
namespace afm::physics {
struct SoftSurface;
}

namespace afm::scene {

// ---- constant after the segment is created (written by touchafm, part of SharedParticles) ----

// physics::SoftSurface in plain numbers, SI. Tip and lever are those of SharedPusher. The field of the tip is a square
// around the origin of the sample.
struct SharedSoft {
  Name name{};
  double hardness_pa = 0;  // 0: the sample is not soft, and all else is ignored
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

// Squares of a soft sample along x and along y; a tip stays some squares away from its edge.
inline constexpr std::uint32_t kSoftSide = 256;

// Half the side of the square in which a tip of this radius may be.
double soft_reach_m(double tip_radius_m) noexcept;

// ---- written by touchafm-servo ----

inline constexpr std::uint32_t kTileSide = 16;  // squares
inline constexpr std::uint32_t kMarkTiles = (kSoftSide / kTileSide) * (kSoftSide / kTileSide);

// Squares of a soft sample, as physics::MarkedSurface has them, or of ink (SharedInk). The servo stores all of them
// when it starts, and one that has changed in each tick.
struct MarkTile {
  std::array<double, std::size_t{kTileSide} * kTileSide> pressed_m{};  // heights under the tip that pressed last
  std::array<double, std::size_t{kTileSide} * kTileSide> back_m{};     // by which they rise when it has left

  bool operator==(const MarkTile&) const = default;
};

// Mark of a tile, 0 if nothing has ever touched it; the digest of a soft sample, or of ink, is the sum of kSoftDigest
// and the marks of all tiles, modulo 2^64. Bit for bit.
inline constexpr std::uint64_t kSoftDigest = 1;
std::uint64_t tile_mark(std::size_t number, const MarkTile& tile) noexcept;
std::uint64_t digest_of(std::span<const MarkTile> tiles) noexcept;

// True if the heights are finite, and no more than a micrometre.
bool is_valid(const MarkTile& tile);

}  // namespace afm::scene
