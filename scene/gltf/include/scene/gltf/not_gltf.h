// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/file_kind.h"

namespace afm::scene {

// The refusal of a file of another kind, with the remedy: "it is an STL file, not glTF; export glTF 2.0 (.glb) from the
// program that made it". Any thread.
std::string not_gltf(const core::FileKind& kind);

}  // namespace afm::scene
