// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/soft_blocks.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "physics/manipulation/marked_surface.h"

namespace afm::scene {
namespace {

constexpr std::uint64_t kTilePrime = 0x100000001b3;  // prime of the 64-bit FNV-1a, here applied to words
constexpr std::uint64_t kTileBasis = 0xcbf29ce484222325;
constexpr double kSpareSquares = 0.5;  // fraction of a square left free, so that rounding adds none

static_assert(physics::MarkedSurface::kTileSide == kTileSide && physics::MarkedSurface::kMostSide >= int{kSoftSide});

}  // namespace

physics::SoftSurface soft_surface(const SharedSoft& soft) {
  return {.hardness = physics::Pressure(soft.hardness_pa),
          .reduced_modulus = physics::Pressure(soft.reduced_modulus_pa),
          .work_of_adhesion = physics::SurfaceEnergy(soft.work_of_adhesion_j_per_m2),
          .pile_up_share = soft.pile_up_share};
}

double soft_reach_m(double tip_radius_m) noexcept {
  // reach and one more square at each end, and the square of the start
  constexpr double kAway = 2.0 * (physics::MarkedSurface::kReach + 1) + 1.0;
  return 0.5 * (kSoftSide - kAway - kSpareSquares) * tip_radius_m / physics::MarkedSurface::kSquaresPerRadius;
}

std::uint64_t tile_mark(std::size_t number, const MarkTile& tile) noexcept {
  std::uint64_t any = 0, mark = kTileBasis ^ number;
  for (const auto* heights_m : {&tile.pressed_m, &tile.back_m}) {
    for (const double height_m : *heights_m) {
      const auto bits = std::bit_cast<std::uint64_t>(height_m);
      any |= bits;
      mark = (mark ^ bits ^ (mark >> 29U)) * kTilePrime;
    }
  }
  return any == 0 ? 0 : mark;
}

std::uint64_t digest_of(std::span<const MarkTile> tiles) noexcept {
  std::uint64_t digest = kSoftDigest;
  for (std::size_t i = 0; i < tiles.size(); ++i) digest += tile_mark(i, tiles[i]);
  return digest;
}

bool is_valid(const MarkTile& tile) {
  const auto near = [](double height_m) { return std::abs(height_m) <= kMostMarkM; };  // false for NaN
  return std::all_of(tile.pressed_m.begin(), tile.pressed_m.end(), near) &&
         std::all_of(tile.back_m.begin(), tile.back_m.end(), near);
}

}  // namespace afm::scene
