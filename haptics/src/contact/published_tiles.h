// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/shared/particle_blocks.h"
#include "scene/shared/soft_blocks.h"

namespace afm::haptics {

// Tiles of a sample as published, with their marks and the digest of these. The constructor allocates; nothing else
// does. One thread. A `Surface` has changed(tile), which is true until a tile is published.
class PublishedTiles {
 public:
  PublishedTiles() : tiles_(scene::kMarkTiles), marks_(scene::kMarkTiles) {}

  std::span<const scene::MarkTile> all() const noexcept { return tiles_; }
  const scene::MarkTile& at(std::uint32_t tile) const noexcept { return tiles_[tile]; }
  bool is_bare(std::uint32_t tile) const noexcept { return marks_[tile] == 0; }

  // Tile to be written; publish() follows.
  scene::MarkTile& next(std::uint32_t tile) noexcept { return tiles_[tile]; }
  void publish(std::uint32_t tile) noexcept {
    const std::uint64_t mark = scene::tile_mark(tile, tiles_[tile]);
    digest_ += mark - marks_[tile];
    marks_[tile] = mark;
  }

  // Digest with 1 added for each waiting tile, so that no session begins before it is published.
  template <class Surface>
  std::uint64_t digest(const Surface& surface) const noexcept {
    std::uint64_t digest = digest_;
    for (std::size_t i = 0; i < tiles_.size(); ++i) digest += surface.changed(i) ? 1U : 0U;
    return digest;
  }

  // The next changed tile, in turn.
  template <class Surface>
  std::optional<std::uint32_t> changed(const Surface& surface) noexcept {
    for (std::uint32_t i = 0; i < tiles_.size(); ++i) {
      const auto tile = static_cast<std::uint32_t>((next_ + i) % tiles_.size());
      if (!surface.changed(tile)) continue;
      next_ = tile + 1;
      return tile;
    }
    next_ = 0;  // restart, so that a session can begin here
    return std::nullopt;
  }

  template <class Surface>
  bool wait(const Surface& surface) const noexcept {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (surface.changed(i)) return true;
    }
    return false;
  }

 private:
  std::vector<scene::MarkTile> tiles_;
  std::vector<std::uint64_t> marks_;  // mark of each tile, its part of the digest
  std::uint64_t digest_ = scene::kSoftDigest;
  std::uint32_t next_ = 0;  // first tile of the next search for a changed one
};

// Push on marks, complete except for the tip.
inline scene::TipPush push_on(const ParticleScale& scale) noexcept {
  return {.hand_m_per_m = scale.hand_m_per_m,
          .hand_n_per_n = scale.hand_n_per_n,
          .softened_sideways = scale.softened_sideways,
          .softened_upwards = scale.softened_upwards};
}

}  // namespace afm::haptics
