// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_loader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <new>

#include "gltf_error.h"
#include "gltf_materials.h"
#include "gltf_model.h"
#include "graph/gltf_animations.h"
#include "graph/gltf_meshes.h"
#include "graph/gltf_nodes.h"
#include "images/gltf_images.h"

namespace afm::scene {
namespace {

Scene read_scene(const std::string& path, GltfWarnings& notes) {
  GltfModel file = read_gltf_model(path, notes);
  const tinygltf::Model& model = file.parts;
  const GltfBuffers buffers(model);
  const GltfAccessors accessors(buffers, model);
  GltfBudget budget;
  Scene scene;
  read_materials(model, scene, notes);
  read_textures(file, buffers, scene, notes);
  read_meshes(model, buffers, accessors, budget, scene, notes);
  const NodePlaces places = read_nodes(model, accessors, budget, scene, notes);
  read_animations(model, accessors, places, budget, scene);
  return scene;
}

// Escapes a message, which may quote the file: it must stay on one line, without control sequences for a terminal.
std::string printable(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, '?');
  return text;
}

}  // namespace

void GltfWarnings::ignore(const std::string& what) {
  constexpr std::size_t kMostNotes = 100;
  const std::string line = printable(what);
  if (ignored.size() < kMostNotes && std::find(ignored.begin(), ignored.end(), line) == ignored.end())
    ignored.push_back(line);
}

core::Result<Scene> load_gltf(const std::string& path, GltfWarnings* notes) {
  const auto refuse = [&](std::string reason) {
    if (reason.find("; ") == std::string::npos) reason += "; export it again and check it with gltf-validator";
    return core::failure(core::ErrorCategory::BadInputFile,
                         printable(fmt::format("cannot load the model '{}': {}", path, reason)));
  };
  GltfWarnings own_notes;
  try {
    return read_scene(path, notes == nullptr ? own_notes : *notes);
  } catch (const GltfError& fault) {
    return refuse(fault.what());
  } catch (const std::bad_alloc&) {
    return refuse("it needs more memory than is available; make it smaller");
  }
}

}  // namespace afm::scene
