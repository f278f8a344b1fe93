// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "physics/law.h"

namespace afm::physics {

// All laws with a force_law().
inline std::vector<Law> curve_laws() {
  std::vector<Law> laws;
  for (const LawTraits& row : kLawTable) {
    if (row.curve != nullptr) laws.push_back(row.law);
  }
  return laws;
}

}  // namespace afm::physics
