// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.h"
#include "curves/measured_topography.h"
#include "exhibit/models/topography_model.h"
#include "scene/graph/scene.h"
#include "scene/samples/material_library.h"

namespace afm::exhibit {

// Models that stand on the wall instead of those of the assets (docs/gltf.md, "Roles"): at rest, each part of them one
// node, so that however many nodes a file has the servo's block holds them.
struct UserModels {
  std::optional<scene::Scene> probe;   // "cantilever", below it "tip", below that "apex", as in the assets' probe.glb
  std::optional<scene::Scene> sample;  // a node "surface", as in the assets' sample-*.glb
  std::optional<TopographyModel> topography;  // instead of a sample: one that an instrument measured
};

// Empty names are of no model; the first bytes of the sample's file say whether it is an image. Errors name the file
// and what is missing in it.
core::Result<UserModels> load_own_models(const std::string& probe_file, const std::string& sample_file,
                                         const curves::TopographyReading& reading = {});

// The sample in the variant that is named like the material or its look, in any case of letters, if there is one.
scene::Scene sample_as(const scene::Scene& sample, const scene::MaterialEntry& material);

}  // namespace afm::exhibit
