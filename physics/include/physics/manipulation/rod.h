// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

// A rod on a flat sample, pushed across its axis at a place off its middle. Its friction q is the same everywhere along
// its length (docs/manipulation.md, "Rods"; equation numbers (M...)). Any thread.
namespace afm::physics {

// d = sqrt(s^2 + L^2/4) - |s| (M19): distance from the middle to the point about which the rod turns, on the other side
// of it. In the middle it moves without turning, and every pivot from L/2 on balances.
Length rod_pivot(Length length, Length place) noexcept;

// F = 2 q d (M20), with the force q L that moves the rod sideways as a whole.
Force rod_threshold(Force sideways, Length length, Length place) noexcept;

// The longest rod whose ends lag by at most kRigidShare of its length: a longer one is not rigid. The ends of a solid
// rod lag behind its pushed middle by q L^4/(128 E I), I = pi r^4/4 (M21).
inline constexpr double kRigidShare = 0.02;
Length longest_rigid_rod(Stiffness friction_per_length, Pressure modulus, Length radius) noexcept;

}  // namespace afm::physics
