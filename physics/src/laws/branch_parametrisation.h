// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "physics/force_law.h"
#include "physics/van_der_waals.h"

// Parameters for branches, distributed so that equal steps resolve both the atomic scale and the millimetre. They
// increase from a branch's first point to its last.
namespace afm::physics {

// Extent of a branch outwards, into the sample, and in force against a wall: beyond the reach of any lever accepted by
// validate() within a millimetre of travel.
inline constexpr double kFarthest = 1e-3;     // largest height, m
inline constexpr double kDeepest = 1e-3;      // largest depth, m
inline constexpr double kHardestPress = 1e3;  // largest force against a wall, N

// A force and its slope dF/dh.
struct ForceAndSlope {
  double force;
  double slope;
};

// Van der Waals attraction as a function of the height above a gap.
inline auto attraction_above(const VanDerWaals& van_der_waals, Length gap) {
  return [van_der_waals, gap](double above) {
    const Length d = gap + Length(above);
    return ForceAndSlope{van_der_waals.force(d).si, van_der_waals.gradient(d).si};
  };
}

// Heights about `origin`: h = origin + scale sinh(s), linear near it, exponential far from it.
struct Heights {
  double origin;
  double scale;

  double parameter(double above_origin) const { return std::asinh(above_origin / scale); }

  // The point at s of a law that is given as a function of the height above the origin, which avoids the rounding of
  // the height itself.
  template <class ForceAbove>
  LawPoint point(double s, ForceAbove force_above) const {
    const double above = scale * std::sinh(s);
    const double dh_ds = scale * std::cosh(s);
    const ForceAndSlope f = force_above(above);
    return {Length(origin + above), Force(f.force), dh_ds, f.slope * dh_ds};
  }

  // Branch from far away down to the origin.
  template <class ForceAbove>
  LawBranch inwards(ForceAbove force_above) const {
    const Heights heights = *this;
    const auto at = [heights, force_above](double s) {
      LawPoint point = heights.point(-s, force_above);
      point.dh_ds = -point.dh_ds;
      point.dforce_ds = -point.dforce_ds;
      return point;
    };
    return {-parameter(kFarthest), 0.0, at, {}};
  }
};

// The reversed branch, from its last point back to the one at `to`.
LawBranch reversed(const LawBranch& branch, double to);

// The integral of F dh along a branch from one parameter to a larger one.
Energy work_along(const LawBranch& branch, double from, double to);

}  // namespace afm::physics
