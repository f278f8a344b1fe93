// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/cycle_curve.h"

#include <algorithm>
#include <array>
#include <utility>

#include "curves/plot_units.h"

namespace afm::exhibit {

CycleCurve CycleCurve::from(const std::vector<std::array<double, 2>>& points) {
  CycleCurve curve;
  for (const auto& [z_nm, force_nn] : points) curve.add_point({.place_nm = z_nm, .force_nn = force_nn});
  return curve;
}

std::vector<std::array<double, 2>> CycleCurve::points() const {
  std::vector<std::array<double, 2>> points(points_.size());
  std::transform(points_.begin(), points_.end(), points.begin(),
                 [](const render::PlotPoint& point) { return std::array{point.place_nm, point.force_nn}; });
  return points;
}

void CycleCurve::add(const scene::TipSample& sample) {
  const bool with_force =
      sample.servo_state == scene::ServoState::Running && sample.phase != physics::Phase::WaitForLift;
  if (!with_force) return;
  const double amplitude_m = sample.swing.amplitude_m;
  add_point({.place_nm = sample.tip.z_m * curves::kNmPerM,
             .force_nn = amplitude_m > 0.0 ? amplitude_m * curves::kNmPerM : sample.tip.force_n * curves::kNnPerN});
}

void CycleCurve::add(const scene::TipEvent& event) {
  if (!physics::is_jump(event.kind)) return;  // events with lateral forces, not drawn
  add_point({.place_nm = event.z_m * curves::kNmPerM, .force_nn = event.force_before_n * curves::kNnPerN});
  add_point({.place_nm = event.z_m * curves::kNmPerM, .force_nn = event.force_after_n * curves::kNnPerN});
}

void CycleCurve::add_point(const render::PlotPoint& point) {
  if (points_.empty() || point.place_nm < points_[deepest_].place_nm) deepest_ = points_.size();
  points_.push_back(point);
}

render::PlotCurve CycleCurve::plot(std::string label, const glm::vec3& color) const {
  render::PlotCurve curve;
  curve.label = std::move(label);
  curve.color = color;
  if (points_.empty()) return curve;
  const auto turn = points_.begin() + static_cast<std::ptrdiff_t>(deepest_);
  curve.approach.assign(points_.begin(), turn + 1);
  curve.retract.assign(turn, points_.end());
  return curve;
}

CycleCurve curve_until(const servo::RecordedSession& session, std::int64_t end_ns) {
  CycleCurve curve;
  auto event = session.events.begin();
  for (const scene::TipSample& sample : session.samples) {
    if (sample.time_ns > end_ns) break;
    for (; event != session.events.end() && event->time_ns <= sample.time_ns; ++event) curve.add(*event);
    curve.add(sample);
  }
  return curve;
}

}  // namespace afm::exhibit
