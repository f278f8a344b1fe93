// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::fuzz {

// How many inputs a target has found good so far. replay_main asks, so that no corpus is of files that are refused.
inline int accepted_inputs = 0;

}  // namespace afm::fuzz
