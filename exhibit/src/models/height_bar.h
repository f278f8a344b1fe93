// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/graph/scene.h"

namespace afm::exhibit {

// The false colours of heights as an unlit vertical strip from the origin upwards, 1 high and `width` wide. Node
// "strip".
scene::Scene height_bar(double width);

}  // namespace afm::exhibit
