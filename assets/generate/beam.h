// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "surface.h"

namespace afm::generate {

// A tube of radius 1 along z from 0 to 1, twelve sides, open at both ends: light is drawn by scaling it.
Surface unit_beam();

}  // namespace afm::generate
