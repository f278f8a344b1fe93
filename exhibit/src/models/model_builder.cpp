// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/model_builder.h"

#include <fmt/format.h>

#include <glm/matrix.hpp>

#include "scene/gltf/gltf_loader.h"

namespace afm::exhibit {

using glm::dmat4;

scene::NodeIndex ModelBuilder::frame(std::string_view name, std::optional<scene::NodeIndex> parent,
                                     const dmat4& parent_from_name) {
  return scene::append(scene_, {}, name, parent, parent_from_name);
}

scene::NodeIndex ModelBuilder::model(const std::string& file, std::string_view name, scene::NodeIndex parent) {
  const auto part = scene::load_gltf(models_dir_ + "/" + file);
  if (!part) {
    if (!error_) error_ = part.error();
    return frame(name, parent, dmat4(1.0));
  }
  return scene::append(scene_, *part, name, parent, dmat4(1.0));
}

scene::NodeIndex ModelBuilder::model_in_frame_of(const std::string& inner, const std::string& file,
                                                 const std::string& name, scene::NodeIndex parent) {
  const scene::NodeIndex root = model(file, name, parent);
  const scene::NodeIndex axes = node(name + "/" + inner);
  if (!error_) scene_.nodes[root].parent_from_node = glm::inverse(ancestor_from_node(scene_, root, axes));
  return root;
}

scene::NodeIndex ModelBuilder::node(const std::string& name) {
  if (const auto found = scene_.find_node(name)) return *found;
  if (!error_) {
    error_ = core::Error{core::ErrorCategory::BadInputFile,
                         fmt::format("models in {}: there is no node \"{}\"; restore the folder from the repository",
                                     models_dir_, name)};
  }
  return 0;
}

}  // namespace afm::exhibit
