// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <numbers>

#include "physics/quantity_text.h"

namespace afm::curves {

inline constexpr std::array kAngles{physics::Unit{"deg", 180.0 / std::numbers::pi, true},
                                    physics::Unit{"\u00b0", 180.0 / std::numbers::pi, false},
                                    physics::Unit{"rad", 1.0, false}};
inline constexpr physics::Units kAngleUnits{"an angle", kAngles};

}  // namespace afm::curves
