// SPDX-License-Identifier: Apache-2.0
#include "fitting/fit_points.h"

#include <cmath>
#include <limits>

namespace afm::curves {

namespace {

using physics::Branch;

// True if a point is beyond a limit. The depth counts from the contact point of the analysis, because that of the fit
// moves with the points left out, on a sample that stiffens further and further.
bool is_beyond(const AnalysedCurve& curve, const physics::CurvePoint& point, const FitOptions& options) {
  const physics::CurveFeatures& features = curve.features;
  const double force_n = (point.force - features.baseline.at(point.z)).si;
  const double bent_m = force_n / curve.curve.metadata.spring_constant->si;
  const double depth_m = features.contact_point ? features.contact_point->si - (point.z.si + bent_m) : 0.0;
  return force_n > options.most_force_n || depth_m > options.most_depth_m;
}

// Force without waves, which the fit does not model; it finds level and tilt itself.
double without_waves_n(const AnalysedCurve& curve, const physics::CurvePoint& point) {
  const physics::Baseline& baseline = curve.features.baseline;
  return (point.force - baseline.waves.at(point.z - baseline.z_far)).si;
}

// Heights between which a tip may stick or be free.
struct Doubtful {
  double approach_sticks_m = -std::numeric_limits<double>::infinity();  // height below which the approach surely sticks
  double retract_sticks_m = -std::numeric_limits<double>::infinity();
  double approach_free_m = std::numeric_limits<double>::infinity();  // height above which the approach is surely free
  double retract_free_m = std::numeric_limits<double>::infinity();
};

// The approach sticks from the strongest pull of its jump on, without a jump from the contact point on. The retract
// sticks up to a twentieth of its way from the contact point to the pull-off before the latter, where a lever that
// trembles lets go early. Above the pull-off nothing sticks; there the lever rings for as long as its jump.
Doubtful doubtful_heights(const AnalysedCurve& curve) {
  constexpr double kLeftOut = 0.05;
  const physics::CurveFeatures& features = curve.features;
  Doubtful heights;
  if (features.contact_point) heights.approach_sticks_m = features.contact_point->si;
  if (features.snap_in) {
    bool jumped = false;
    for (const physics::CurvePoint& point : curve.curve.points) {
      if (point.branch != Branch::Approach || point.z > features.snap_in->z) continue;
      heights.approach_sticks_m = point.z.si;
      jumped = point.force - features.baseline.at(point.z) <= features.snap_in->force_after;
      if (jumped) break;
    }
  }
  if (!features.pull_off) return heights;
  const double off_m = features.pull_off->z.si;
  const double way_m = features.contact_point ? std::fmax(off_m - features.contact_point->si, 0.0) : 0.0;
  heights.retract_sticks_m = off_m - kLeftOut * way_m;
  heights.approach_free_m = off_m;
  heights.retract_free_m = off_m - features.pull_off->force.si / curve.curve.metadata.spring_constant->si;
  return heights;
}

FitPoints adhesive_points(const AnalysedCurve& curve, const FitOptions& options) {
  const Doubtful heights = doubtful_heights(curve);
  FitPoints found;
  const std::vector<physics::CurvePoint>& points = curve.curve.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const physics::CurvePoint& point = points[i];
    const bool approach = point.branch == Branch::Approach;
    const bool sticks = point.z.si <= (approach ? heights.approach_sticks_m : heights.retract_sticks_m);
    const bool free = point.z.si > (approach ? heights.approach_free_m : heights.retract_free_m);
    if (!(sticks || free) || (sticks && is_beyond(curve, point, options))) continue;
    found.samples.push_back({point.z.si, without_waves_n(curve, point), sticks});
    found.places.push_back(i);
  }
  return found;
}

FitPoints approach_points(const AnalysedCurve& curve, const FitOptions& options) {
  FitPoints found;
  const std::vector<physics::CurvePoint>& points = curve.curve.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].branch != Branch::Approach) continue;
    if (is_beyond(curve, points[i], options)) break;
    found.samples.push_back({points[i].z.si, without_waves_n(curve, points[i])});
    found.places.push_back(i);
  }
  return found;
}

}  // namespace

FitPoints fit_points(const AnalysedCurve& curve, const FitOptions& options) {
  return fits::row_of(*options.shape).is_adhesive ? adhesive_points(curve, options) : approach_points(curve, options);
}

}  // namespace afm::curves
