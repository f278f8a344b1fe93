// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::curves {

// Units of panels and plots.
inline constexpr double kNmPerM = 1e9;
inline constexpr double kNnPerN = 1e9;
inline constexpr double kAjPerJ = 1e18;

}  // namespace afm::curves
