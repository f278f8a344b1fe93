// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "surface.h"

namespace afm::generate {

// A tube of radius 1 along z from 0 to 1, with twelve sides and open ends; scaled to draw light.
Surface unit_beam();

// A dark rim around that tube, wound inwards.
Surface beam_outline(double radius);

}  // namespace afm::generate
