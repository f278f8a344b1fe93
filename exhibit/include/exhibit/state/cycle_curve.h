// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/frame.h"
#include "servo/session_file.h"

namespace afm::exhibit {

// The growing force-displacement curve of one cycle: all samples of the servo while its force was enabled and the tip
// had been lifted, and both ends of each jump, exactly where it happened. Split at the deepest push into approach and
// retract. In tapping mode it holds the amplitude in nm instead of the force.
class CycleCurve {
 public:
  void add(const scene::TipSample& sample);
  void add(const scene::TipEvent& event);

  // A curve from stored points: Z in nm, force in nN.
  static CycleCurve from(const std::vector<std::array<double, 2>>& points);
  std::vector<std::array<double, 2>> points() const;

  bool empty() const { return points_.empty(); }

  render::PlotCurve plot(std::string label, const glm::vec3& color) const;

  // All of the object's state, for storage by exhibit/cluster/wall_history.h.
  template <class Curve, class Visit>
  static void visit_state(Curve& curve, Visit&& visit) {
    visit(curve.points_);
    visit(curve.deepest_);
  }
  bool sound() const { return deepest_ == 0 || deepest_ < points_.size(); }

 private:
  void add_point(const render::PlotPoint& point);

  std::vector<render::PlotPoint> points_;
  std::size_t deepest_ = 0;
};

// The curve of a session up to `end_ns`, with samples and events in order of time.
CycleCurve curve_until(const servo::RecordedSession& session, std::int64_t end_ns);

}  // namespace afm::exhibit
