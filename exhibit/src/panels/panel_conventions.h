// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::exhibit {

// Shared by the panels. The shares of the axis of force above and below zero, in units of the greatest force
// towards the one and the other side.
inline constexpr double kForceAbove = 0.52, kForceBelow = 1.22;
inline constexpr int kDigits = 3;  // of a number

}  // namespace afm::exhibit
