// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "haptics/hand_controls.h"

namespace afm::exhibit {

using haptics::HandControls;
enum class Pointer { Mouse, Wand };
struct Controls {
  HandControls hand = HandControls::Simulated;
  Pointer pointer = Pointer::Wand;
};

}  // namespace afm::exhibit
