// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "exhibit/models/model_builder.h"
#include "render/frame.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

// A round length, 1, 2 or 5 times a power of ten, drawn no longer than a limit.
struct ScaleBar {
  double length_m = 0;  // length in the nanoworld
  double drawn = 0;     // size in the picture
  std::string text;     // "10 nm"
};

// `m_per_unit` > 0: metres of the nanoworld per unit of the picture. The bar is drawn more than 0.4 and at most 1.0
// times `longest`.
ScaleBar scale_bar(double m_per_unit, double longest);

// Marks that explain the instrument: a ruler on the sample in the wall's plane, the place of the unbent lever, and the
// scan line.
class WallMarks {
 public:
  WallMarks() = default;
  // Adds the nodes of the ruler below `layout` and all others below `sample`.
  WallMarks(ModelBuilder& build, scene::Scene& scene, scene::NodeIndex layout, scene::NodeIndex sample);

  // Places the ruler, in layout units.
  void place_ruler(const ScaleBar& bar, std::vector<glm::dmat4>& local) const;

  // Places a line where the unbent lever would be, or hides it.
  void place_unbent(const glm::dvec3& clamp, const glm::dvec3& end, std::vector<glm::dmat4>& local) const;
  void hide_unbent(std::vector<glm::dmat4>& local) const;

  // Places the arrow of the force, from the unbent lever's end to the real one's: as long as the bend, which is
  // proportional to the force, and one colour for a pull, another for a push.
  void place_force(const glm::dvec3& unbent_end, const glm::dvec3& end, std::vector<glm::dmat4>& local) const;

  // Places the scan line over the sample, in layout units of the sample's frame.
  void place_scan_line(const glm::dvec3& from, const glm::dvec3& to, std::vector<glm::dmat4>& local) const;

  // Places a line with a stroke across each end over the gap below the journey's last atom, in layout units.
  void place_gap(const glm::dvec3& low, const glm::dvec3& high, std::vector<glm::dmat4>& local) const;

  // Nodes to hide together: with the instrument, without a scan, without a scale, and far from the atoms.
  std::vector<scene::NodeIndex> lever_nodes() const;
  scene::NodeIndex scan_line_node() const { return scan_line_; }
  std::vector<scene::NodeIndex> ruler_nodes() const { return {ruler_.line, ruler_.low, ruler_.high}; }
  std::vector<scene::NodeIndex> gap_nodes() const { return {gap_.line, gap_.low, gap_.high}; }

 private:
  struct Arrow {
    scene::NodeIndex line = 0, head = 0;
  };
  // A line between two strokes.
  struct Bar {
    scene::NodeIndex line = 0, low = 0, high = 0;
    void place(const glm::dvec3& from, const glm::dvec3& to, std::vector<glm::dmat4>& local) const;
  };
  Bar ruler_, gap_;
  scene::NodeIndex unbent_ = 0, scan_line_ = 0;
  Arrow push_, pull_;
};

}  // namespace afm::exhibit
