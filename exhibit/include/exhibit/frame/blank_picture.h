// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/frame.h"

namespace afm::exhibit {

// Nothing but the background: neither the scene nor a panel nor a label.
void blank(render::FrameState& frame);

}  // namespace afm::exhibit
