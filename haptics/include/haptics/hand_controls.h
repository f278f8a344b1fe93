// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace afm::haptics {

// The controls in a hand, which the wall names. Device: controls without names of their own, such as those of a
// device that --haptics auto found.
enum class HandControls { Mouse, Pen, Grip, Gamepad, Device, Simulated };

}  // namespace afm::haptics
