// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace afm::curves {

struct SampleModel;

// Reason why a lever that taps loses its swing under a hand on this sample; empty if it does not. Takes tenths of a
// second for a drive above the resonance.
std::string why_swing_is_lost(const SampleModel& model);

}  // namespace afm::curves
