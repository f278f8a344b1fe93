// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "exhibit/models/model_builder.h"
#include "render/frame.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

// A round length, 1, 2 or 5 times a power of ten, that is drawn no longer than a limit.
struct ScaleBar {
  double length_m = 0;  // of the nanoworld
  double drawn = 0;     // its size in the picture
  std::string text;     // "10 nm"
};

// `m_per_unit` > 0: metres of the nanoworld shown as one unit of the picture; the bar is drawn more than 0.4 and at
// most 1.0 times `longest`.
ScaleBar scale_bar(double m_per_unit, double longest);

// Marks beside the instrument that make it readable: a ruler on the sample in the wall's plane,
// and where the lever would be without its bend.
class WallMarks {
 public:
  WallMarks() = default;
  // Appends its nodes: the ruler's below `layout`, the lever's below `sample`.
  WallMarks(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex layout, scene::NodeIndex sample);

  // The ruler, in layout units.
  void place_ruler(const ScaleBar& bar, std::vector<glm::dmat4>& local) const;

  // A line along the lever as it would be without its bend; or none.
  void place_unbent(const glm::dvec3& clamp, const glm::dvec3& end, std::vector<glm::dmat4>& local) const;
  void hide_unbent(std::vector<glm::dmat4>& local) const;

  // The bend, from the unbent lever's end to the real one's.
  void place_bend(const glm::dvec3& unbent_end, const glm::dvec3& end, std::vector<glm::dmat4>& local) const;

  // A line over the sample, in layout units of the sample's frame.
  void place_scan_line(const glm::dvec3& from, const glm::dvec3& to, std::vector<glm::dmat4>& local) const;

  // Those that are hidden with the instrument, and the ruler's.
  std::vector<scene::NodeIndex> lever_nodes() const { return {unbent_, bend_}; }
  scene::NodeIndex scan_line_node() const { return scan_line_; }
  std::vector<scene::NodeIndex> ruler_nodes() const { return {ruler_, ruler_low_, ruler_high_}; }

 private:
  scene::NodeIndex ruler_ = 0, ruler_low_ = 0, ruler_high_ = 0, unbent_ = 0, bend_ = 0, scan_line_ = 0;
};

}  // namespace afm::exhibit
