// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

namespace afm::physics {

// F(Z) of one branch, to be looked up in O(1) without allocation by one or many threads. (The builder's side is the
// author's to design; what users need is this.)
class BranchTable {
 public:
  // Continued beyond both ends: to zero far away from the sample, along the last slope deep inside it.
  Force force(Length z) const noexcept;
};

}  // namespace afm::physics
