// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shared/shared_blocks.h"

namespace afm::servo {

// "the renderer gave no frame for 250 ms"
const char* reason(scene::FaultCode fault);

}  // namespace afm::servo
