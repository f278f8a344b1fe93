// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <iosfwd>
#include <optional>
#include <string>

#include "core/result.h"
#include "render/frame.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

// A model and the way to show it.
struct ModelChoice {
  std::string file{};
  std::optional<double> at_s{};  // of its animations; none: at rest
  std::string camera = "auto";   // as camera_name(), or "auto"
  std::string variant{};         // of KHR_materials_variants; empty: the file's own materials
  glm::uvec2 size_px{960, 720};  // of an eye's picture
  double eyes_apart_m = 0.063;   // in front of a wall of the paper's height; 0: one eye in the middle
};

// A model alone, ready to be drawn.
struct ModelView {
  scene::Scene scene;
  render::FrameState frame;
};

// The name of a camera: its own name, its node's, or its place in the file as "#0".
std::string camera_name(const scene::Scene& scene, const scene::Node& node);

// Loads a model, poses it, and places it behind a wall as its camera, or one that has all of it in view, sees it: what
// the camera looks at lies in the wall's plane, two eyes look from where it stands. Errors name what is wrong: a file
// that cannot be read, a camera or a variant that the model has not.
core::Result<ModelView> open_model(const ModelChoice& choice);

// What is in a model and what of it is not shown: a line each, or one JSON object. Fails as load_gltf() does.
enum class DescriptionForm { Lines, Json };
core::Result<void> describe_model(const std::string& file, DescriptionForm form, std::ostream& out);

}  // namespace afm::exhibit
