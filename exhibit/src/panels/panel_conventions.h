// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::exhibit {

// Ranges of the force axis above and below zero in all panels, in units of the greatest force in either direction.
inline constexpr double kForceAbove = 0.52, kForceBelow = 1.22;
inline constexpr int kDigits = 3;  // significant digits of a value

}  // namespace afm::exhibit
