// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/graph/scene.h"

namespace afm::exhibit {

// The false colours of heights as an upright strip, unlit: from the origin upwards, 1 high and `width` wide. A node
// "strip".
scene::Scene height_bar(double width);

}  // namespace afm::exhibit
