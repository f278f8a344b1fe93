// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::exhibit {

// Value with a typographic sign, or without one if it rounds to zero: "\u22120.407 nN".
std::string signed_text(double value, int decimals, const char* unit);

// A force in nanonewtons, with two decimals, which can be read at a glance.
std::string force_text(double force_n);

}  // namespace afm::exhibit
