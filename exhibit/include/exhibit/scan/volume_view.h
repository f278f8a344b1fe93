// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "curves/force_volume.h"
#include "exhibit/state/wall_state.h"
#include "render/frame.h"
#include "scene/graph/scene.h"
#include "scene/shared/shared_blocks.h"

namespace afm::curves {
struct SampleModel;
}

namespace afm::exhibit {

class WallScene;

// The curves of a whole felt force map, drawn over its sample. Every curve begins on the drawn surface, which
// is the deepest point that it reached; above it, heights have the scale of the ruler, or another one if the curves
// would be higher than kVolumeHeight or lower than kLeastVolumeHeight. Reuses its drawing until something changes.
// One thread.
class VolumeView {
 public:
  // `wall_scene` must outlive the object, and have been loaded with UserModels::force_volume.
  explicit VolumeView(const WallScene& wall_scene);

  // Adds an upright slice along the scan line through the tip, in the colours of forces, with their scale at its right
  // end. No effect without a visible sample. Call after WallScene::update(), with the same state.
  void add_slice(const curves::SampleModel& model, const WallState& state, curves::ForceVolume::Way way,
                 render::FrameState& frame);

  // Adds the surface on which the curves have this force, translucent, with the force at its left end: a push on the
  // approach, a pull, which is negative, on the retract. It has gaps where no curve reaches the force.
  void add_surface(const curves::SampleModel& model, const WallState& state, double force_n, render::FrameState& frame);

 private:
  // Scales of a sample and its volume on the wall; lengths in units of the layout.
  struct Scales {
    double release_z_m = -1;                                // size of the sample, as in WallState
    double per_m = 0;                                       // units of the drawing per metre of the sample's frame
    double per_height_m = 0;                                // units of the drawing per metre along the curves
    double lateral = 1;                                     // metres of the sample's frame per metre as measured
    double top = 0;                                         // height of the highest curve above its start
    glm::dvec2 size_m{0.0};                                 // distances of the outermost pixels' middles, as measured
    glm::dvec2 map_m{0.0};                                  // width and height of the whole map
    std::function<double(double x_m, double y_m)> drawn_m;  // height of the surface, in metres as drawn
    scene::TopographyScale shown{};                         // metres of the sample's frame per metre as drawn
    double floor = 0, lid = 0;                              // drawn heights of the surface and of the highest curve
  };
  // The newest drawing.
  struct Slice {
    std::size_t row = 0;
    curves::ForceVolume::Way way{};
    std::vector<scene::Vertex> vertices;
    double left = 0, right = 0;  // heights of the surface at both ends
  };
  struct Surface {
    double force_n = 0;
    std::vector<scene::Vertex> vertices;
    double left = 0;  // height at the left end of the front edge
  };

  const Scales& scales_of(const curves::SampleModel& model, const WallState& state);
  double surface(const Scales& scales, double x_m, double y_m) const;
  Slice cut(const curves::ForceVolume& volume, const Scales& scales, double y_m, curves::ForceVolume::Way way) const;
  Surface raise(const curves::ForceVolume& volume, const Scales& scales, double force_n) const;
  void add_bar(const curves::ForceVolume& volume, const Scales& scales, const glm::dvec3& foot,
               render::FrameState& frame) const;
  void write(const std::string& text, const glm::dvec3& place, render::FrameState& frame) const;

  const WallScene& wall_scene_;
  scene::NodeIndex slice_, bar_, equal_force_;
  std::optional<Scales> scales_;
  std::optional<Slice> cut_;
  std::optional<Surface> raised_;
};

}  // namespace afm::exhibit
