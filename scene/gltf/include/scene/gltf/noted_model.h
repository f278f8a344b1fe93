// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "scene/graph/scene.h"

namespace afm::scene {

// load_gltf() for a picture: after a second reports that loading continues, then logs the missing images,
// and the reason if nothing is shown.
core::Result<Scene> load_noted_model(const std::string& file);

}  // namespace afm::scene
