// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "physics/quantity_text.h"

namespace afm::curves {

inline constexpr std::array kViscosityUnits{physics::Unit{"Pa*s", 1.0, true}, physics::Unit{"mPa*s", 1e3, true},
                                            physics::Unit{"uPa*s", 1e6, true}};

}  // namespace afm::curves
