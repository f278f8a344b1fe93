// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "physics/curve_point.h"
#include "physics/units.h"

namespace afm::physics {

// Where tip and sample meet on an approach, by the methods that AFM programs use. The names are those of the command
// line; nanite 4.2 calls them "deviation_from_baseline", "fit_constant_line", "fit_constant_polynomial",
// "frechet_direct_path" and "gradient_zero_crossing" (its documentation describes them), and has no zero of force.
enum class ContactMethod { ZeroForce, Deviation, FitLine, FitPolynomial, Farthest, Gradient };

struct ContactMethodName {
  ContactMethod method;
  std::string_view name;
};

inline constexpr std::array kContactMethods{
    ContactMethodName{ContactMethod::ZeroForce, "zero-force"},
    ContactMethodName{ContactMethod::Deviation, "deviation"},
    ContactMethodName{ContactMethod::FitLine, "fit-line"},
    ContactMethodName{ContactMethod::FitPolynomial, "fit-polynomial"},
    ContactMethodName{ContactMethod::Farthest, "farthest"},
    ContactMethodName{ContactMethod::Gradient, "gradient"},
};

std::string_view name_of(ContactMethod method);

// For an approach above its baseline, in the order in which it was recorded. None where the method finds nothing.
//
// - ZeroForce: the first zero of the force from the deepest point outwards, after a median over five samples. With
//   adhesion the contact line's zero, not the jump; without, it runs out along any tail or undulation.
// - Deviation: where the force, from the deepest point outwards, falls below the mean of the outermost tenth and twice
//   the largest deviation from it there.
// - FitLine: the kink of zero and a straight line, by least squares.
// - FitPolynomial: the same of zero and a d + b d^1.5 + c d^2 with a, b, c >= 0, d the depth below the contact point:
//   a rigid contact (a line), a sphere on a soft sample (Hertz), a cone; hardly moved by a tail or an undulation.
// - Farthest: the point farthest below the straight line from the outermost to the deepest point.
// - Gradient: where the slope, from the steepest place outwards, falls below a hundredth of its maximum.
//
// All but ZeroForce work on the means of up to 512 bins along Z. O(n log n), allocates.
std::optional<Length> contact_point(std::span<const CurvePoint> approach, ContactMethod method);

}  // namespace afm::physics
