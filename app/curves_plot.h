// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/session_file.h"
#include "scene/material_library.h"

namespace afm::app {

// The whole curves of the sessions as two plots: all together, and the same near the surface, where the jumps to
// contact are. Self-contained SVG elements, one below the other.
std::string curves_svg(const std::vector<RecordedSession>& sessions, const scene::MaterialLibrary& materials);

}  // namespace afm::app
