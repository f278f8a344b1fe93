// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "physics/curve_point.h"
#include "physics/rows_of_enum.h"
#include "physics/units.h"

namespace afm::physics {

// Methods of AFM programs for finding the contact point on an approach, with their names on the command line. nanite
// 4.2 calls them "deviation_from_baseline", "fit_constant_line", "fit_constant_polynomial", "frechet_direct_path" and
// "gradient_zero_crossing" (see its documentation), and has no counterpart of ZeroForce.
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
static_assert(has_row_for_each(kContactMethods, &ContactMethodName::method));

std::string_view name_of(ContactMethod method);

// Contact point of an approach above its baseline, in the order of recording. Empty if the method finds none.
//
// - ZeroForce: the first zero of the force from the deepest point outwards, after a median over five samples. With
//   adhesion this is the zero of the contact line, not the jump; without, it extends along any tail or undulation.
// - Deviation: where the force, from the deepest point outwards, falls below the mean of the outermost tenth plus twice
//   the largest deviation from it there.
// - FitLine: the kink between zero and a straight line, by least squares.
// - FitPolynomial: the same for any straight line, a remaining tilt, and an elastic contact under a lever, whose depth
//   below the contact point is a F^(2/3) + b F (sphere) or a F^(1/2) + b F (cone) with a, b >= 0. Little affected by a
//   tail or an undulation.
// - Farthest: the point farthest below the straight line from the outermost to the deepest point.
// - Gradient: where the slope, from the steepest place outwards, falls below a hundredth of its maximum.
//
// All except ZeroForce use the means of up to 512 bins along Z, the last fit of up to 256. O(n log n), allocates.
std::optional<Length> contact_point(std::span<const CurvePoint> approach, ContactMethod method);

}  // namespace afm::physics
