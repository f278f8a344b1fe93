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

// A model and how to show it.
struct ModelChoice {
  std::string file{};
  std::optional<double> at_s{};  // time in its animations; empty: at rest
  std::string camera = "auto";   // name from camera_name(), or "auto"
  std::string variant{};         // variant of KHR_materials_variants; empty: the file's default materials
  glm::uvec2 size_px{960, 720};  // size of an eye's picture
  double eyes_apart_m = 0.063;   // eye distance in front of a wall of the paper's height; 0: one eye in the middle
};

// A single model, ready to be drawn.
struct ModelView {
  scene::Scene scene;
  render::FrameState frame;
};

// Name of a camera: its own, its node's, or its index in the file as "#0".
std::string camera_name(const scene::Scene& scene, const scene::Node& node);

// Loads a model, poses it, and places it behind a wall as seen by its camera, or by one that shows all of it: the
// camera's focus is in the wall's plane, and two eyes look from the camera's position. The error names an unreadable
// file, or a camera or variant that the model lacks.
core::Result<ModelView> open_model(const ModelChoice& choice);

// Describes a model and the parts of it that are not shown, as lines or as one JSON object. Fails as load_gltf() does.
enum class DescriptionForm { Lines, Json };
core::Result<void> describe_model(const std::string& file, DescriptionForm form, std::ostream& out);

}  // namespace afm::exhibit
