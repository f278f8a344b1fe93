// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/view/view_control.h"

namespace afm::servo {
class KeptBeat;
}

namespace afm::app {

struct ViewParts;

// Informs the keeper of a kiosk that the window still draws, and ends the window with its keeper.
class KeptControl final : public ViewControl {
 public:
  KeptControl(ViewParts& parts, servo::KeptBeat& beat) : parts_(parts), beat_(beat) {}

  void take(const ViewInput& input, const ViewFrame& frame) override;

 private:
  ViewParts& parts_;
  servo::KeptBeat& beat_;
};

}  // namespace afm::app
