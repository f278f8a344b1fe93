// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/key.h"

namespace afm::render {

// Key for a GLFW code.
Key key_of(int glfw_code);

}  // namespace afm::render
