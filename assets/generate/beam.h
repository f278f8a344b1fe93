// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "surface.h"

namespace afm::generate {

// A tube of radius 1 along z from 0 to 1, with twelve sides and open ends; scaled to draw light.
Surface unit_beam();

}  // namespace afm::generate
