// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_loader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
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

// Escapes a message, which may quote the file: it must stay on one line, without control sequences for a terminal.
std::string printable(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, '?');
  return text;
}

void add_note(std::vector<std::string>& notes, const std::string& what) {
  constexpr std::size_t kMostNotes = 100;
  const std::string line = printable(what);
  if (notes.size() < kMostNotes && std::find(notes.begin(), notes.end(), line) == notes.end()) notes.push_back(line);
}

glm::dmat4 room_from(const Scene& scene, const Node& node) {
  glm::dmat4 room_from_node = node.parent_from_node;
  for (auto above = node.parent; above; above = scene.nodes[*above].parent) {
    room_from_node = scene.nodes[*above].parent_from_node * room_from_node;
  }
  return room_from_node;
}

// The picture is framed in floats; sizes beyond their largest value, 3.4e38, leave it empty.
bool is_within_floats(const Scene& scene, const Node& node) {
  constexpr double kFarthestM = 1e37;
  const glm::dmat4 room_from_node = room_from(scene, node);
  for (const Primitive& primitive : scene.meshes[*node.mesh].primitives) {
    for (const Vertex& vertex : primitive.vertices) {
      const glm::dvec3 place(room_from_node * glm::dvec4(glm::dvec3(vertex.position), 1.0));
      if (!(std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}) < kFarthestM)) return false;
    }
  }
  return true;
}

// True unless all vertices of the node's mesh are at one place, which leaves the picture empty; true for points.
bool has_size(const Scene& scene, const Node& node) {
  const glm::dmat4 room_from_node = room_from(scene, node);
  for (const Primitive& primitive : scene.meshes[*node.mesh].primitives) {
    const auto place = [&](const Vertex& vertex) {
      return glm::dvec3(room_from_node * glm::dvec4(glm::dvec3(vertex.position), 1.0));
    };
    if (primitive.topology == Topology::Points) return true;
    const auto elsewhere = [&](const Vertex& vertex) { return place(vertex) != place(primitive.vertices.front()); };
    if (std::any_of(primitive.vertices.begin(), primitive.vertices.end(), elsewhere)) return true;
  }
  return false;
}

// Message that names the scene used, if nothing in it can be drawn.
std::string why_empty(const tinygltf::Model& model, const Scene& scene) {
  bool has_mesh = false, has_primitive = false, has_shown = false, has_endless = false;
  for (const Node& node : scene.nodes) {
    if (!node.mesh) continue;
    has_mesh = true;
    if (scene.meshes[*node.mesh].primitives.empty()) continue;
    has_primitive = true;
    has_endless |= !is_within_floats(scene, node);
    has_shown |= !scene.animations.empty() || has_size(scene, node);  // a moving node may grow from nothing
  }
  if (has_shown && !has_endless) return "";
  const std::string reason = has_endless     ? "has a mesh larger than 1e37 m: scale it down"
                             : has_primitive ? "has only meshes without size"
                             : has_mesh      ? "has only meshes that cannot be drawn"
                                             : "has no node with a mesh";
  if (model.scenes.empty()) return "the file, which lists no scene, " + reason;
  const auto shown = static_cast<std::size_t>(std::max(0, model.defaultScene));
  const std::string& name = model.scenes[shown].name;
  return fmt::format("scene {}{} {}", shown, name.empty() ? "" : fmt::format(" '{}'", name.substr(0, 60)), reason);
}

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
  notes.empty = printable(why_empty(model, scene));
  return scene;
}

}  // namespace

void GltfWarnings::ignore(const std::string& what) { add_note(ignored, what); }
void GltfWarnings::correct(const std::string& what) { add_note(corrected, what); }
void GltfWarnings::miss(const std::string& what) { add_note(missing, what); }

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
