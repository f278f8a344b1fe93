// SPDX-License-Identifier: Apache-2.0
#include "app/live/kept_control.h"

#include "app/view/view_parts.h"
#include "servo/keep_running.h"

namespace afm::app {

void KeptControl::take(const ViewInput& /*input*/, const ViewFrame& /*frame*/) {
  if (!beat_.beat()) parts_.turn.leaving = true;
}

}  // namespace afm::app
