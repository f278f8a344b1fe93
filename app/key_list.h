// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/frame.h"

namespace afm::app {

enum class HandSource { Mouse, Simulated, Device };

// What the live window's keys and buttons do, for the wall.
render::DataPanel key_list(HandSource hand);

}  // namespace afm::app
