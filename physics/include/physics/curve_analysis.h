// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "physics/contact_point.h"
#include "physics/curve_point.h"
#include "physics/force_curve.h"
#include "physics/units.h"

namespace afm::physics {

// Where a branch of a curve is pulled hardest. The force is signed: it is zero or negative, and zero where nothing
// pulls.
struct Extreme {
  Length z;
  Force force;
};

// What the samples alone say about a curve.
struct CurveSummary {
  Extreme approach;    // its force is -F_attr
  Extreme retract;     // its force is -F_ad
  Energy loop_energy;  // energy lost by the hand: -closed integral of F dZ, by trapezoids
};

// For samples in the order of the cycle. The loop is closed only if the first and the last sample share their Z.
CurveSummary summarise(std::span<const CurveSample> samples);

// The curve of a model as an instrument would have recorded it.
std::vector<CurvePoint> points_of(std::span<const CurveSample> samples);

// The force that the instrument shows where nothing acts ("baseline" in nanite, AtomicJ and SPM-Kit): a straight line
// F = level + tilt (Z - z_far).
struct Baseline {
  Length z_far;  // outermost point of the approach
  Force level;
  Stiffness tilt;
  Force noise;  // standard deviation around the line, from the median absolute deviation

  Force at(Length z) const { return level + tilt * (z - z_far); }
};

// A sudden change of the force: the last point before it and the hardest pull after it. Forces are above the baseline.
struct CurveJump {
  Length z;
  Force force_before;
  Force force_after;
};

// What users of force microscopes read off a curve. All forces are above the baseline; a feature that does not stand
// out of the noise is absent.
//
// - contact_point: by the method that was asked for. Without one, the zero of the force where the approach is pulled
//   before contact (the contact line's zero, not the jump) or the curve is computed, else the fit of a polynomial.
// - contact_estimates: what each method says. contact_doubtful: without a pull, fewer than four of the five methods
//   that need none lie within a third of the pushed depth of the contact point.
// - snap_in: the jump to contact ("jump-in", "pull-on"). Only a fall that is sudden at the curve's own step counts.
// - pull_off: the jump off contact, the last point before the force rises suddenly for the last time; forces of a
//   curve's pull_off are those of a model's. A curve that lets go without a jump has it where it is pulled hardest, in
//   the median of neighbouring samples.
// - adhesion: the hardest pull of the retract ("adhesion force", SPM-Kit's "adhesion"); the pull-off unless bonds break
//   one after the other or the lever is stiff.
// - let_go: where the tip is free again: the pull-off where that is a jump, else where the last significant pull ends;
//   without a pull, the contact point.
// - contact_slope: -dF/dZ of the approach's upper half, by least squares: the lever's stiffness where the sample is
//   much stiffer ("InvOLS" is its inverse, in volts).
// - loop_energy: the area between the branches from the deepest point to let_go ("hysteresis area").
// - adhesion_energy: the area between the retract branch and the baseline while the tip is pulled ("work of
//   separation").
struct CurveFeatures {
  Baseline baseline;
  Force greatest_push;
  std::optional<Length> contact_point;
  ContactMethod contact_method = ContactMethod::ZeroForce;
  std::array<std::optional<Length>, kContactMethods.size()> contact_estimates{};  // order of kContactMethods
  bool contact_doubtful = false;
  std::optional<CurveJump> snap_in;
  std::optional<Extreme> pull_off;
  bool jumps_off = false;  // the pull-off is a jump
  std::optional<Extreme> adhesion;
  std::optional<Length> let_go;
  std::optional<Stiffness> contact_slope;
  Energy loop_energy;
  Energy adhesion_energy;
};

// The least number of points that an approach must have to be analysed; a retract may be missing.
inline constexpr std::size_t kFewestApproachPoints = 10;

// Whether the force of a curve has a zero of its own, as a computed one has, or that of an instrument, which has to be
// found: a long attraction would then be taken for tilt.
enum class ForceZero { Instrument, True };

// For points in the order of the cycle, of any number of samples a branch. Throws std::invalid_argument if the approach
// has fewer than kFewestApproachPoints, a point is not finite, or all points share their Z. O(n log n), allocates.
CurveFeatures analyse(std::span<const CurvePoint> points, ForceZero zero = ForceZero::Instrument,
                      std::optional<ContactMethod> method = std::nullopt);

}  // namespace afm::physics
