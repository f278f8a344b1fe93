// SPDX-License-Identifier: Apache-2.0
#include "haptics/felt_marks.h"

#include <vector>

#include "haptics/contact/felt_ink.h"
#include "haptics/contact/felt_scratch.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {

std::unique_ptr<FeltMarks> felt_marks_of(scene::SharedSegment& segment, const scene::SharedParticles& particles,
                                         const ParticleScale& scale, std::int64_t period_ns) {
  if (!scene::has_marks(particles)) return nullptr;
  std::unique_ptr<FeltMarks> felt;
  if (particles.soft.hardness_pa > 0.0) {
    felt = std::make_unique<FeltScratch>(particles, scale, 1e-9 * static_cast<double>(period_ns));
  } else {
    felt = std::make_unique<FeltInk>(particles, scale);
  }
  const scene::ServoSide side = segment.servo_side();
  std::vector<scene::MarkTile> tiles;
  tiles.reserve(scene::kMarkTiles);
  while (tiles.size() < scene::kMarkTiles) {
    const auto tile = side.last_mark_tile(static_cast<std::uint32_t>(tiles.size()));
    if (!tile) return felt;
    tiles.push_back(*tile);
  }
  felt->resume(tiles);
  return felt;
}

}  // namespace afm::haptics
