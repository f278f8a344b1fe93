// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "drawing/distance_order.h"
#include "drawing/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

// Stage that computes the colours of a plain material.
enum class Shading : std::uint8_t {
  ByFragment,
  ByVertex,      // triangles about as small as the pixels of an eye
  LightByVertex  // rough surfaces with small turns from vertex to vertex; shadows per fragment
};

// Draws of a frame: indices into SceneGeometry::draws().
struct DrawList {
  std::vector<std::uint32_t> shadow;   // all visible opaque casters, in view or not
  std::vector<std::uint32_t> opaque;   // in view, from near to far, so that hidden surfaces are not shaded
  std::vector<std::uint32_t> blended;  // in view, from far to near
  std::vector<std::uint8_t> mirrored;  // indexed by draw; 1 if the node mirrors its mesh
  std::vector<Shading> shading;        // indexed by draw; ByFragment for draws out of view
  std::vector<std::uint32_t> copies;   // indexed by draw; 1 for a draw without room for copies
  bool hazy = false;                   // true: visible fog
  bool clipped = false;                // true: draw cut by an eye's near plane or guard band

  bool operator==(const DrawList&) const = default;
};

// Builds draw lists; keeps its memory for the next one.
class DrawListBuilder {
 public:
  // Sorts by the boxes of the draws, bent as in the frame: distances are measured from the point between the eyes to
  // their centres. `guard_band` as in EyeTargets; `pixels_high` is the drawn height of an eye.
  void list(const FrameState& frame, const SceneGeometry& geometry, float guard_band, double pixels_high,
            DrawList& list);

 private:
  DistanceOrder opaque_, blended_;
};

}  // namespace afm::render
