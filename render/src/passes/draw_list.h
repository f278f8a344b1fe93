// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "passes/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

// Where the colours of a plain material are worked out.
enum class Shading : std::uint8_t {
  ByFragment,
  ByVertex,      // the triangles are about as small as the pixels of an eye
  LightByVertex  // rough, and turning little from vertex to vertex: shadows by fragment
};

// Draws of a frame: indices into SceneGeometry::draws().
struct DrawList {
  std::vector<std::uint32_t> shadow;   // opaque ones that are shown, seen or not
  std::vector<std::uint32_t> opaque;   // seen by an eye, from near to far, so that what is hidden is not shaded
  std::vector<std::uint32_t> blended;  // seen by an eye, from far to near
  std::vector<std::uint8_t> mirrored;  // by draw, 1 where the node turns left into right
  std::vector<Shading> shading;        // by draw; of what is not seen: ByFragment
  bool hazy = false;                   // something dissolves into the background
  bool clipped = false;                // an eye's near plane, or its guard band, cuts through one of those

  bool operator==(const DrawList&) const = default;
};

// Makes draw lists; keeps memory for the next.
class DrawListBuilder {
 public:
  // By the boxes of the draws, bent as the frame says: distances are of their middles from between the eyes.
  // `guard_band` as in EyeTargets; `pixels_high` is what is drawn of an eye.
  void list(const FrameState& frame, const SceneGeometry& geometry, float guard_band, double pixels_high,
            DrawList& list);

 private:
  using Distances = std::vector<std::pair<double, std::uint32_t>>;
  Distances opaque_, blended_;
};

}  // namespace afm::render
