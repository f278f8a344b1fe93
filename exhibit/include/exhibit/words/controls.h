// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::exhibit {

// The device in the hand, whose controls the wall names. Device: one without names for them, found by --haptics auto.
enum class HandControls { Mouse, Pen, Grip, Gamepad, Device, Simulated };
enum class Pointer { Mouse, Wand };
struct Controls {
  HandControls hand = HandControls::Simulated;
  Pointer pointer = Pointer::Wand;
};

}  // namespace afm::exhibit
