// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.h"
#include "scene/graph/scene.h"

namespace afm::imaging {

// A user's own models instead of those of the assets (docs/gltf.md, "Roles"), at rest. Each part becomes one node, so
// that the servo's block has room whatever the number of nodes in the file. The error names the file and the part that
// it lacks.

// Probe with nodes "cantilever" > "tip" > "apex", as in the assets' probe.glb.
core::Result<scene::Scene> load_own_probe(const std::string& file);

// BadInputFile for a path that is no file: a folder, a pipe. An empty name passes.
core::Result<void> check_own_sample(const std::string& file);

// Sample with the node "surface", as in the assets' sample-*.glb, of a file that passed check_own_sample(). An image is
// refused like any other file that is no model.
core::Result<scene::Scene> load_own_sample(const std::string& file);

}  // namespace afm::imaging
