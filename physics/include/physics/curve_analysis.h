// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "physics/contact_point.h"
#include "physics/curve_point.h"
#include "physics/force_curve.h"
#include "physics/rows_of_enum.h"
#include "physics/units.h"

namespace afm::physics {

// Place of a branch's strongest pull. The force is signed: negative, or zero without a pull.
struct Extreme {
  Length z;
  Force force;
};

// Properties of a curve that follow from its samples only.
struct CurveSummary {
  Extreme approach;    // strongest pull of the approach; its force is -F_attr
  Extreme retract;     // strongest pull of the retract; its force is -F_ad
  Energy loop_energy;  // energy lost by the hand: -closed integral of F dZ, by trapezoids
};

// Summary of samples in the order of the cycle. The loop is closed only if the first and the last one have the same Z.
CurveSummary summarise(std::span<const CurveSample> samples);

// The curve of a model in the form of an instrument's.
std::vector<CurvePoint> points_of(std::span<const CurveSample> samples);

// Interference of the laser's light at lever and sample: a wave along Z with this period, as a sum of a sine and a
// cosine of the distance from the outermost point.
struct Waves {
  Length period;  // wavelength along Z; zero: no interference
  Force sine, cosine;

  Force amplitude() const { return Force(std::hypot(sine.si, cosine.si)); }
  Force at(Length way) const {
    if (period.si == 0.0) return {};
    const double phase = 2.0 * std::numbers::pi * (way / period);
    return std::sin(phase) * sine + std::cos(phase) * cosine;
  }
};

// The force recorded by the instrument without interaction ("baseline" in nanite, AtomicJ and SPM-Kit): a straight line
// F = level + tilt (Z - z_far), with waves if requested.
struct Baseline {
  Length z_far;  // outermost point of the approach
  Force level;
  Stiffness tilt;
  Force noise;  // standard deviation around the baseline, from the median absolute deviation
  Waves waves{};

  Force line_at(Length z) const { return level + tilt * (z - z_far); }
  Force at(Length z) const { return line_at(z) + waves.at(z - z_far); }
};

enum class BaselineShape {
  Tilted,  // straight line
  Flat,    // constant force
  Waves,   // straight line and one wave
};

struct BaselineShapeName {
  BaselineShape shape;
  std::string_view name;
};
inline constexpr std::array kBaselineShapes{BaselineShapeName{BaselineShape::Tilted, "tilted"},
                                            BaselineShapeName{BaselineShape::Flat, "flat"},
                                            BaselineShapeName{BaselineShape::Waves, "waves"}};
static_assert(has_row_for_each(kBaselineShapes, &BaselineShapeName::shape));

// Part of the approach, as distances from its outermost point.
struct WayRange {
  Length from, to;  // distances from the outermost point, from < to
};

struct BaselineChoice {
  BaselineShape shape = BaselineShape::Tilted;
  std::optional<WayRange> range{};  // range of the approach that is fitted; empty: found from the curve
};

// A sudden change of the force: the last point before it and the strongest pull after it. Forces are above the
// baseline.
struct CurveJump {
  Length z;
  Force force_before;
  Force force_after;
};

// Range of places.
struct PlaceRange {
  Length low, high;
};

// Features that users of force microscopes read off a curve. All forces are above the baseline; a feature below the
// noise is absent.
//
// - contact_point: by the requested method. By default the zero of the force if the approach has a pull before contact
//   that is no wave (the contact line's zero, not the jump) or the curve is computed, otherwise the polynomial fit.
// - contact_estimates: result of each method. contact_range: from the deepest to the outermost of these; without a
// pull,
//   also of the places at which the polynomial fit is not significantly worse. contact_doubtful: without a pull, fewer
//   than four of the five methods that need none agree with the contact point within a third of the pushed depth, the
//   fit allows places that are apart by 0.17 of it, or less than 0.18 of the approach lies outside the contact; with a
//   pull and without a snap-in, the latter or the fit disagrees by a third of the pushed depth.
// - snap_in: the jump to contact ("jump-in", "pull-on"). Counts only a fall that is sudden at the curve's own step.
// - pull_off: the jump off contact, the last point before the force rises suddenly for the last time; its forces are
//   comparable to a model's. A curve that releases without a jump has it at its strongest pull, in the median of
//   neighbouring samples.
// - adhesion: the strongest pull of the retract ("adhesion force", SPM-Kit's "adhesion"); equals the pull-off unless
//   bonds break one after the other or the lever is stiff.
// - let_go: where the tip is free again: at the pull-off if that is a jump, otherwise at the end of the last
//   significant pull; without a pull, at the contact point.
// - contact_slope: -dF/dZ of the approach's upper half, by least squares: the lever's stiffness if the sample is much
//   stiffer ("InvOLS" is its inverse, in volts).
// - loop_energy: the area between the branches from the deepest point to let_go ("hysteresis area").
// - adhesion_energy: the area between the retract branch and the baseline while the tip is pulled ("work of
//   separation").
struct CurveFeatures {
  Baseline baseline;
  Force greatest_push;
  std::optional<Length> contact_point;
  ContactMethod contact_method = ContactMethod::ZeroForce;
  std::array<std::optional<Length>, kContactMethods.size()> contact_estimates{};  // in the order of kContactMethods
  std::optional<PlaceRange> contact_range;
  bool contact_doubtful = false;
  std::optional<CurveJump> snap_in;
  std::optional<Extreme> pull_off;
  bool jumps_off = false;  // true: the pull-off is a jump
  std::optional<Extreme> adhesion;
  std::optional<Length> let_go;
  std::optional<Stiffness> contact_slope;
  Energy loop_energy;
  Energy adhesion_energy;
};

// Least number of points of an analysable approach. A retract may be missing.
inline constexpr std::size_t kFewestApproachPoints = 10;
inline constexpr std::size_t kFewestBaselinePoints = 5;

// Zero of a curve's force: True for a computed curve; Instrument if it must be estimated, at the risk of taking a
// long-range attraction for tilt.
enum class ForceZero { Instrument, True };

// Analyses points in the order of the cycle, any number per branch. Throws std::invalid_argument for fewer
// than kFewestApproachPoints, a point is not finite, all points have the same Z, or fewer than kFewestBaselinePoints
// lie in the chosen range. O(n log n), allocates.
CurveFeatures analyse(std::span<const CurvePoint> points, ForceZero zero = ForceZero::Instrument,
                      std::optional<ContactMethod> method = std::nullopt, const BaselineChoice& baseline = {});

}  // namespace afm::physics
