// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.h"
#include "scene/graph/scene.h"
#include "scene/graph/subtree.h"

namespace afm::exhibit {

// Loads models one by one into one graph. Keeps the first error, so that callers need no check after each step; after
// an error every call still returns a node, but the graph must not be used.
class ModelBuilder {
 public:
  ModelBuilder(std::string models_dir, scene::Scene& scene) : models_dir_(std::move(models_dir)), scene_(scene) {}

  scene::NodeIndex frame(std::string_view name, std::optional<scene::NodeIndex> parent,
                         const glm::dmat4& parent_from_name);

  scene::NodeIndex model(const std::string& file, std::string_view name, scene::NodeIndex parent);

  // Same, rotated so that the frame `name` has the axes of the model's node `inner`.
  scene::NodeIndex model_in_frame_of(const std::string& inner, const std::string& file, const std::string& name,
                                     scene::NodeIndex parent);

  // Adds a loaded model.
  scene::NodeIndex part(const scene::Scene& part, std::string_view name, scene::NodeIndex parent) {
    return scene::append(scene_, part, name, parent, glm::dmat4(1.0));
  }

  // Finds a node by its full name, "probe/tip".
  scene::NodeIndex node(const std::string& name);

  const std::optional<core::Error>& error() const { return error_; }

 private:
  std::string models_dir_;
  scene::Scene& scene_;
  std::optional<core::Error> error_;
};

}  // namespace afm::exhibit
