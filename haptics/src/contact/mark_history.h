// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/shared/particle_blocks.h"
#include "scene/shared/soft_blocks.h"

namespace afm::haptics {

// Tiles of a soft sample as they were before the newest strokes of a tip: the last kMostCopies tiles, in whole strokes,
// at most scene::kMostStrokes of them. The constructor allocates; nothing else does. One thread.
class MarkHistory {
 public:
  static constexpr std::size_t kMostCopies = 512;  // capacity in tiles, 2 MB

  MarkHistory() : copies_(kMostCopies) { strokes_.reserve(scene::kMostStrokes); }

  // Begins a stroke.
  void begin() noexcept {
    kept_.fill(0);
    open_ = false;
    broken_ = false;
  }

  // True if this stroke has a copy of the tile, or has changed more tiles than are held, and cannot be taken back.
  bool keeps(std::uint32_t tile) const noexcept { return broken_ || kept_[tile] != 0; }

  // Keeps a tile that the stroke will change, unless it keeps() it.
  void keep(std::uint32_t tile, const scene::MarkTile& before) noexcept {
    if (!open_) open();
    if (strokes_.back().count == kMostCopies) {
      strokes_.clear();
      broken_ = true;
      return;
    }
    while (held() == kMostCopies) forget_oldest();
    Stroke& stroke = strokes_.back();
    copies_[(stroke.first + stroke.count++) % kMostCopies] = {tile, before};
    kept_[tile] = 1;
  }

  // Calls put(tile, before) for all tiles of the newest stroke, and forgets it; false if there is none.
  template <class Put>
  bool take_back(const Put& put) noexcept {
    if (strokes_.empty()) return false;
    const Stroke stroke = strokes_.back();
    strokes_.pop_back();
    for (std::size_t i = 0; i < stroke.count; ++i) {
      const Copy& copy = copies_[(stroke.first + i) % kMostCopies];
      put(copy.tile, copy.before);
    }
    begin();
    return true;
  }

  // Ends a stroke that has changed nothing, and forgets it.
  void forget_this() noexcept {
    if (open_ && !strokes_.empty()) strokes_.pop_back();
    begin();
  }

  std::size_t size() const noexcept { return strokes_.size(); }

 private:
  struct Copy {
    std::uint32_t tile = 0;
    scene::MarkTile before;
  };
  struct Stroke {
    std::size_t first = 0, count = 0;
  };

  void open() noexcept {
    if (strokes_.size() == scene::kMostStrokes) forget_oldest();
    strokes_.push_back({strokes_.empty() ? 0 : (strokes_.back().first + strokes_.back().count) % kMostCopies, 0});
    open_ = true;
  }

  std::size_t held() const noexcept {
    std::size_t count = 0;
    for (const Stroke& stroke : strokes_) count += stroke.count;
    return count;
  }

  void forget_oldest() noexcept { strokes_.erase(strokes_.begin()); }

  std::vector<Copy> copies_;  // ring of copies
  std::vector<Stroke> strokes_;
  std::array<std::uint8_t, scene::kMarkTiles> kept_{};  // 1: tile copied in the newest stroke
  bool open_ = false;                                   // true: the newest stroke has begun, and has a copy
  bool broken_ = false;
};

}  // namespace afm::haptics
