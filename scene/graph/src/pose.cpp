// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "scene/graph/flat_normals.h"

namespace afm::scene {
namespace {

glm::dvec3 vector_at(const std::optional<Track>& track, float time_s, const glm::dvec3& rest) {
  if (!track) return rest;
  std::vector<float> value;
  sample(*track, time_s, value);
  return glm::dvec3(glm::vec3(value[0], value[1], value[2]));
}

void move_nodes(Scene& scene, float time_s) {
  // the first animation last, so that it takes precedence
  for (auto animation = scene.animations.rbegin(); animation != scene.animations.rend(); ++animation) {
    for (const AnimatedNode& moved : animation->nodes) {
      Node& node = scene.nodes[moved.node];
      if (moved.weights) sample(*moved.weights, time_s, node.weights);
      if (!moved.translations && !moved.rotations && !moved.scales) continue;
      const glm::dquat rotation = moved.rotations ? sample_rotation(*moved.rotations, time_s) : moved.rotation;
      const glm::dvec3 scale = vector_at(moved.scales, time_s, moved.scale);
      node.parent_from_node = glm::mat4_cast(rotation);
      for (int i = 0; i < 3; ++i) node.parent_from_node[i] *= scale[i];
      node.parent_from_node[3] = glm::dvec4(vector_at(moved.translations, time_s, moved.translation), 1.0);
    }
  }
}

void apply_morphs(Primitive& primitive, const std::vector<float>& weights) {
  for (std::size_t k = 0; k < primitive.targets.size(); ++k) {
    const MorphTarget& target = primitive.targets[k];
    const float weight = weights[k];
    if (weight == 0.0F) continue;
    for (std::size_t i = 0; i < target.positions.size(); ++i) {
      primitive.vertices[i].position += weight * target.positions[i];
    }
    for (std::size_t i = 0; i < target.normals.size(); ++i) primitive.vertices[i].normal += weight * target.normals[i];
    for (std::size_t i = 0; i < std::min(target.tangents.size(), primitive.tangents.size()); ++i) {
      primitive.tangents[i] += glm::vec4(weight * target.tangents[i], 0.0F);
    }
  }
  primitive.targets.clear();
}

// Weighted sum of the joints' matrices; the weights need not add up to one.
glm::mat4 blended(const Primitive& primitive, std::size_t vertex, const std::vector<glm::mat4>& joints) {
  glm::mat4 sum(0.0F);
  float total = 0.0F;
  for (const auto* stream : {&primitive.influences, &primitive.more_influences}) {
    if (stream->empty()) continue;
    const Influence& influence = (*stream)[vertex];
    for (std::size_t k = 0; k < 4; ++k) {
      const float weight = influence.weights[static_cast<int>(k)];
      if (weight > 0.0F) sum += weight * joints[influence.joints[k]];
      total += weight;
    }
  }
  return total > 0.0F ? sum / total : glm::mat4(1.0F);
}

void apply_skin(Primitive& primitive, const std::vector<glm::mat4>& joints) {
  for (std::size_t i = 0; i < primitive.vertices.size(); ++i) {
    Vertex& vertex = primitive.vertices[i];
    const glm::mat4 matrix = blended(primitive, i, joints);
    const glm::mat3 linear(matrix);
    const glm::mat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
    vertex.position = glm::vec3(matrix * glm::vec4(vertex.position, 1.0F));
    vertex.normal = cofactor * vertex.normal;
    if (!primitive.tangents.empty()) {
      primitive.tangents[i] = glm::vec4(linear * glm::vec3(primitive.tangents[i]), primitive.tangents[i].w);
    }
  }
  primitive.influences.clear();
  primitive.more_influences.clear();
}

void settle_directions(Primitive& primitive) {
  if (primitive.normals == Normals::Flat) set_flat_normals(primitive);
  for (Vertex& vertex : primitive.vertices) {
    const float length = glm::length(vertex.normal);
    vertex.normal = length > 0.0F && std::isfinite(length) ? vertex.normal / length : glm::vec3(0, 0, 1);
  }
}

std::vector<glm::mat4> joint_matrices(const Skin& skin, const std::vector<glm::dmat4>& scene_from_node) {
  std::vector<glm::mat4> matrices;
  matrices.reserve(skin.joints.size());
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    matrices.emplace_back(scene_from_node[skin.joints[i]] * glm::dmat4(skin.joint_from_mesh[i]));
  }
  return matrices;
}

bool is_skinned(const Node& node, const Mesh& mesh) {
  return node.skin && std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                                  [](const Primitive& primitive) { return !primitive.influences.empty(); });
}

}  // namespace

std::vector<glm::dmat4> scene_from_nodes(const Scene& scene) {
  std::vector<glm::dmat4> matrices;
  matrices.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes) {
    matrices.push_back(node.parent ? matrices[*node.parent] * node.parent_from_node : node.parent_from_node);
  }
  return matrices;
}

Scene posed(Scene scene, std::optional<float> time_s) {
  if (time_s) move_nodes(scene, *time_s);
  const std::vector<glm::dmat4> scene_from_node = scene_from_nodes(scene);
  const std::size_t nodes = scene.nodes.size(), meshes = scene.meshes.size();
  for (std::size_t i = 0; i < nodes; ++i) {
    if (!scene.nodes[i].mesh) continue;
    const Mesh& rest = scene.meshes[*scene.nodes[i].mesh];
    const bool skinned = is_skinned(scene.nodes[i], rest);
    const std::vector<float>& weights = scene.nodes[i].weights.empty() ? rest.weights : scene.nodes[i].weights;
    const bool morphed = std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0.0F; });
    if (!skinned && !morphed) continue;
    Mesh moved = rest;
    for (Primitive& primitive : moved.primitives) {
      apply_morphs(primitive, weights);
      if (skinned) apply_skin(primitive, joint_matrices(scene.skins[*scene.nodes[i].skin], scene_from_node));
      settle_directions(primitive);
    }
    const auto place = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(moved));
    if (skinned) {
      // a skin places the vertices in the scene's own frame, wherever the node is
      scene.nodes.push_back(Node{scene.nodes[i].name, std::nullopt, place, glm::dmat4(1.0)});
      scene.nodes[i].mesh.reset();
    } else {
      scene.nodes[i].mesh = place;
    }
  }

  // original versions of moved meshes are no longer needed
  std::vector<bool> shown(meshes, false);
  for (const Node& node : scene.nodes) {
    if (node.mesh && *node.mesh < meshes) shown[*node.mesh] = true;
  }
  for (std::size_t i = 0; i < meshes; ++i) {
    if (!shown[i]) scene.meshes[i].primitives.clear();
  }
  scene.animations.clear();
  for (Node& node : scene.nodes) node.skin.reset();
  scene.skins.clear();
  return scene;
}

bool choose_variant(Scene& scene, std::string_view name) {
  const auto found = std::find(scene.variants.begin(), scene.variants.end(), name);
  if (found == scene.variants.end()) return false;
  const auto variant = static_cast<std::uint32_t>(found - scene.variants.begin());
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      for (const VariantMaterial& mapping : primitive.variants) {
        if (mapping.variant == variant) primitive.material = mapping.material;
      }
    }
  }
  return true;
}

std::optional<NodeIndex> find_role(const Scene& scene, std::string_view role) {
  const auto found =
      std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& node) { return node.role == role; });
  if (found != scene.nodes.end()) return static_cast<NodeIndex>(found - scene.nodes.begin());
  return scene.find_node(role);
}

}  // namespace afm::scene
