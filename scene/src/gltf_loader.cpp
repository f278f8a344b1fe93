// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_loader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "gltf_accessor.h"
#include "gltf_file.h"
#include "gltf_validation.h"

namespace afm::scene {
namespace {

std::optional<int> attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? std::nullopt : std::optional(found->second);
}

Material build_material(const tinygltf::Material& source) {
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  Material material;
  material.name = source.name;
  material.base_color = glm::vec4(glm::make_vec4(pbr.baseColorFactor.data()));
  material.metallic = static_cast<float>(pbr.metallicFactor);
  material.roughness = static_cast<float>(pbr.roughnessFactor);
  material.double_sided = source.doubleSided;
  material.blended = source.alphaMode == "BLEND";
  material.unlit = source.extensions.count("KHR_materials_unlit") != 0;
  double strength = 1;
  const auto extension = source.extensions.find("KHR_materials_emissive_strength");
  if (extension != source.extensions.end() && extension->second.Has("emissiveStrength")) {
    strength = extension->second.Get("emissiveStrength").GetNumberAsDouble();
  }
  material.emissive = glm::vec3(glm::make_vec3(source.emissiveFactor.data()) * strength);
  return material;
}

glm::vec3 unit_or_up(glm::vec3 normal) {
  const float length = glm::length(normal);
  return length > 0 && std::isfinite(length) ? normal / length : glm::vec3(0, 0, 1);
}

// Every triangle gets corners of its own and their common normal.
void make_flat(Primitive& primitive) {
  std::vector<Vertex> corners;
  corners.reserve(primitive.indices.size());
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    const Vertex& a = primitive.vertices[primitive.indices[i]];
    const Vertex& b = primitive.vertices[primitive.indices[i + 1]];
    const Vertex& c = primitive.vertices[primitive.indices[i + 2]];
    const glm::dvec3 origin(a.position);
    const glm::dvec3 normal = glm::cross(glm::dvec3(b.position) - origin, glm::dvec3(c.position) - origin);
    const double length = glm::length(normal);
    for (Vertex corner : {a, b, c}) {
      corner.normal = length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
      corners.push_back(corner);
    }
  }
  for (std::size_t i = 0; i < corners.size(); ++i) primitive.indices[i] = static_cast<std::uint32_t>(i);
  primitive.vertices = std::move(corners);
}

Primitive build_primitive(const tinygltf::Model& model, const tinygltf::Primitive& source,
                          std::uint32_t default_material) {
  Primitive primitive;
  primitive.material = source.material < 0 ? default_material : static_cast<std::uint32_t>(source.material);
  const AccessorReader positions(model, *attribute(source, "POSITION"));
  primitive.vertices.resize(positions.count());
  for (std::size_t i = 0; i < positions.count(); ++i) primitive.vertices[i].position = glm::vec3(positions.floats(i));
  if (const std::optional<int> accessor = attribute(source, "COLOR_0")) {
    const AccessorReader colors(model, *accessor);
    for (std::size_t i = 0; i < colors.count(); ++i) primitive.vertices[i].color = colors.floats(i, glm::vec4(1.0F));
  }

  if (source.indices >= 0) {
    const AccessorReader indices(model, source.indices);
    primitive.indices.resize(indices.count());
    for (std::size_t i = 0; i < indices.count(); ++i) primitive.indices[i] = indices.index(i);
  } else {
    primitive.indices.resize(positions.count());
    for (std::size_t i = 0; i < positions.count(); ++i) primitive.indices[i] = static_cast<std::uint32_t>(i);
  }

  if (const std::optional<int> accessor = attribute(source, "NORMAL")) {
    const AccessorReader normals(model, *accessor);
    for (std::size_t i = 0; i < normals.count(); ++i)
      primitive.vertices[i].normal = unit_or_up(glm::vec3(normals.floats(i)));
  } else {
    make_flat(primitive);
  }
  return primitive;
}

glm::dmat4 parent_from(const tinygltf::Node& node) {
  if (!node.matrix.empty()) return glm::make_mat4(node.matrix.data());
  glm::dmat4 transform(1.0);
  if (!node.rotation.empty()) {
    const std::vector<double>& q = node.rotation;  // x, y, z, w
    transform = glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
  }
  for (int i = 0; i < 3 && !node.scale.empty(); ++i) transform[i] *= node.scale[static_cast<std::size_t>(i)];
  if (!node.translation.empty()) transform[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
  return transform;
}

// The roots to show: those of the default scene, of the first scene, or of the whole file.
std::vector<int> shown_roots(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

// Depth first without recursion: a hostile file's hierarchy may be as deep as it has nodes.
void build_nodes(const tinygltf::Model& model, Scene& scene) {
  std::vector<std::pair<int, std::optional<NodeIndex>>> waiting;
  const std::vector<int> roots = shown_roots(model);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) waiting.emplace_back(*root, std::nullopt);
  while (!waiting.empty()) {
    const auto [index, parent] = waiting.back();
    waiting.pop_back();
    const tinygltf::Node& source = model.nodes[static_cast<std::size_t>(index)];
    const auto own_index = static_cast<NodeIndex>(scene.nodes.size());
    Node node{source.name, parent, std::nullopt, parent_from(source)};
    if (source.mesh >= 0) node.mesh = static_cast<std::uint32_t>(source.mesh);
    scene.nodes.push_back(std::move(node));
    for (auto child = source.children.rbegin(); child != source.children.rend(); ++child)
      waiting.emplace_back(*child, own_index);
  }
}

Scene build_scene(const tinygltf::Model& model) {
  Scene scene;
  bool uses_default_material = false;
  for (const tinygltf::Material& material : model.materials) scene.materials.push_back(build_material(material));
  const auto default_material = static_cast<std::uint32_t>(scene.materials.size());
  for (const tinygltf::Mesh& source : model.meshes) {
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.name = source.name;
    for (const tinygltf::Primitive& primitive : source.primitives) {
      uses_default_material |= primitive.material < 0;
      mesh.primitives.push_back(build_primitive(model, primitive, default_material));
    }
  }
  if (uses_default_material) scene.materials.push_back(Material{.name = "default"});
  build_nodes(model, scene);
  return scene;
}

}  // namespace

core::Result<Scene> load_gltf(const std::string& path) {
  const auto refuse = [&](std::string reason) {
    // a reason may quote the file, which must not break the line or reach a terminal as a control sequence
    std::replace_if(
        reason.begin(), reason.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, '?');
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("cannot load the model '{}': {}", path, reason));
  };
  const core::Result<tinygltf::Model> model = read_gltf_file(path);
  if (!model) return refuse(model.error().message);
  if (const std::optional<std::string> complaint = complaint_about(*model)) {
    return refuse(*complaint + "; export it again and check it with gltf-validator");
  }
  return build_scene(*model);
}

}  // namespace afm::scene
