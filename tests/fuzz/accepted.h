// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::fuzz {

// Number of inputs accepted by a target so far. Used by replay_main to detect a corpus of rejected files.
inline int accepted_inputs = 0;

}  // namespace afm::fuzz
