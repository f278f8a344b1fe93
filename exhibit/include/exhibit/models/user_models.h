// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/result.h"
#include "curves/measured_topography.h"
#include "exhibit/models/topography_model.h"
#include "scene/graph/scene.h"
#include "scene/samples/material_library.h"

namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

// Models that replace those of the assets (docs/gltf.md, "Roles"), at rest. Each part becomes one node, so that the
// servo's block has room whatever the number of nodes in the file.
struct UserModels {
  std::optional<scene::Scene> probe;          // nodes "cantilever" > "tip" > "apex", as in the assets' probe.glb
  std::optional<scene::Scene> sample;         // nodes "surface" and "outline"
  std::optional<TopographyModel> topography;  // an instrument's topography instead of a sample
  std::shared_ptr<const scene::ParticleSet> particles;  // particles on a level sample; may be null
  bool force_volume = false;                            // adds nodes for the curves of a force map over the sample
};

// An empty name means no model. The first bytes of the sample's file decide whether it is an image. The error names the
// file and the part that it lacks.
core::Result<UserModels> load_own_models(const std::string& probe_file, const std::string& sample_file,
                                         const curves::TopographyReading& reading = {});

// The sample, whose first mesh is its body, with the dark line around it that the assets' samples have.
scene::Scene with_outline(scene::Scene sample);

// The sample in the variant with the name of the material or of its look, ignoring case, if there is one.
scene::Scene sample_as(const scene::Scene& sample, const scene::MaterialEntry& material);

}  // namespace afm::exhibit
