// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::exhibit {

// "\u22120.407 nN": the value with a typographic sign, without one if it rounds to zero.
std::string signed_text(double value, int decimals, const char* unit);

// A force in nanonewtons, with the two decimals that a glance can take in.
std::string force_text(double force_n);

}  // namespace afm::exhibit
