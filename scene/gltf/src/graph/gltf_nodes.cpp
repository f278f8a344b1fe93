// SPDX-License-Identifier: Apache-2.0
#include "graph/gltf_nodes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "gltf_error.h"
#include "graph/gltf_transform.h"

namespace afm::scene {
namespace {

// Includes the instances of EXT_mesh_gpu_instancing. The second limit is on the vertices that they show in total.
constexpr std::uint64_t kMostNodes = 250'000;
constexpr std::uint64_t kMostDrawnCorners = 48'000'000;
constexpr std::uint64_t kMostDraws = 100'000;
// Limit on the vertices of meshes with skins or morph targets, each of which is copied when it is posed.
constexpr std::uint64_t kMostMovedVertices = 4'000'000;

// True for the nodes with a parent. A node has at most one, and none is its own ancestor.
std::vector<bool> find_parents(const std::vector<tinygltf::Node>& nodes) {
  std::vector<bool> has_parent(nodes.size(), false);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int child : nodes[i].children) {
      const auto place = static_cast<std::size_t>(child);
      if (has_parent[place]) {
        throw GltfError(fmt::format(
            "/nodes/{} '{}' has the child {} '{}', which has more than one parent, and glTF allows one; give each "
            "parent a separate node with the same mesh",
            i, nodes[i].name, child, nodes[place].name));
      }
      has_parent[place] = true;
    }
  }

  // since each has one parent, nodes not reached from the roots form a loop
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!has_parent[i]) reached.push_back(i);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const auto& children = nodes[reached[next]].children;
    reached.insert(reached.end(), children.begin(), children.end());
  }
  if (reached.size() != nodes.size()) throw GltfError("its nodes form a loop");
  return has_parent;
}

// Nodes below one of `roots`, excluding the roots.
std::vector<bool> descendants(const std::vector<tinygltf::Node>& nodes, const std::vector<int>& roots) {
  std::vector<bool> below(nodes.size(), false);
  std::vector<int> waiting = roots;
  while (!waiting.empty()) {
    const auto node = static_cast<std::size_t>(waiting.back());
    waiting.pop_back();
    for (const int child : nodes[node].children) {
      if (below[static_cast<std::size_t>(child)]) continue;
      below[static_cast<std::size_t>(child)] = true;
      waiting.push_back(child);
    }
  }
  return below;
}

// Roots to show: those of the default scene, of the first one, or of the whole file. Old versions of UniGLTF list a
// child of a node that is in no scene: it is shown by itself.
std::vector<std::size_t> shown_roots(const tinygltf::Model& model, const std::vector<bool>& has_parent,
                                     GltfWarnings& notes) {
  std::vector<std::size_t> roots;
  if (model.scenes.empty()) {
    for (std::size_t i = 0; i < has_parent.size(); ++i) {
      if (!has_parent[i]) roots.push_back(i);
    }
    return roots;
  }
  const std::size_t shown = model.defaultScene < 0 ? 0 : static_cast<std::size_t>(model.defaultScene);
  const std::vector<int>& listed = model.scenes[shown].nodes;
  const std::vector<bool> below = descendants(model.nodes, listed);
  std::vector<bool> seen(has_parent.size(), false);
  for (const int root : listed) {
    const auto node = static_cast<std::size_t>(root);
    if (below[node] || seen[node]) {
      throw GltfError(fmt::format("/scenes/{} has the node {}, which is not a root or listed twice", shown, node));
    }
    if (has_parent[node]) {
      notes.correct(fmt::format("/scenes/{} lists the node {}, whose parent it does not list: drawn without the parent",
                                shown, node));
    }
    seen[node] = true;
    roots.push_back(node);
  }
  return roots;
}

std::optional<std::uint32_t> index_or_none(int index) {
  return index < 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(index));
}

class NodeReader {
 public:
  NodeReader(const tinygltf::Model& model, const GltfAccessors& accessors, Scene& scene, GltfWarnings& notes)
      : model_(model), accessors_(accessors), scene_(scene), notes_(notes), places_(model.nodes.size()) {}

  // Depth first without recursion: a hierarchy may be as deep as its number of nodes.
  NodePlaces read() {
    std::vector<std::pair<std::size_t, std::optional<NodeIndex>>> waiting;
    const auto roots = shown_roots(model_, find_parents(model_.nodes), notes_);
    for (auto node = roots.rbegin(); node != roots.rend(); ++node) waiting.emplace_back(*node, std::nullopt);
    while (!waiting.empty()) {
      const auto [index, parent] = waiting.back();
      waiting.pop_back();
      const auto place = static_cast<NodeIndex>(scene_.nodes.size());
      places_[index] = place;
      add(index, parent);
      const auto& children = model_.nodes[index].children;
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        waiting.emplace_back(static_cast<std::size_t>(*child), place);
      }
    }
    return std::move(places_);
  }

 private:
  [[noreturn]] static void fail(std::size_t index, std::string_view reason) {
    throw GltfError(fmt::format("/nodes/{} {}", index, reason));
  }

  void add(std::size_t index, std::optional<NodeIndex> parent) {
    const tinygltf::Node& source = model_.nodes[index];
    Node node{source.name, parent, std::nullopt, matrix_of(read_transform(model_, index))};
    const auto mesh = index_or_none(source.mesh);
    node.skin = index_or_none(source.skin);
    node.camera = index_or_none(source.camera);
    if (const auto* light = find_extension(source.extensions, "KHR_lights_punctual")) {
      node.light = static_cast<std::uint32_t>(light->Get("light").GetNumberAsInt());
    }
    if (source.extras.IsObject()) node.role = text_or(source.extras.Get("touchafm"), "role", "");
    if (!source.weights.empty() && (!mesh || source.weights.size() != scene_.meshes[*mesh].weights.size())) {
      fail(index, "has a number of weights that differs from its mesh's morph targets");
    }
    node.weights.assign(source.weights.begin(), source.weights.end());
    const auto* instances = find_extension(source.extensions, "EXT_mesh_gpu_instancing");
    if (instances == nullptr) node.mesh = mesh;
    scene_.nodes.push_back(std::move(node));
    if (instances != nullptr && mesh) {
      add_instances(index, *instances, *mesh);
    } else if (mesh) {
      count_drawn(index, *mesh, 1);
    }
  }

  void count_drawn(std::size_t index, std::uint32_t mesh, std::uint64_t times) {
    std::uint64_t corners = 0;
    for (const Primitive& primitive : scene_.meshes[mesh].primitives) {
      corners += primitive.indices.size();
      if (!primitive.influences.empty() || !primitive.targets.empty()) {
        moved_vertices_ += times * primitive.vertices.size();
      }
    }
    drawn_corners_ += times * corners;
    draws_ += times * scene_.meshes[mesh].primitives.size();
    if (moved_vertices_ > kMostMovedVertices) {
      throw GltfError(fmt::format("its skins and morph targets move more than {} vertices in total; make it smaller",
                                  kMostMovedVertices));
    }
    if (drawn_corners_ > kMostDrawnCorners || draws_ > kMostDraws || scene_.nodes.size() + times > kMostNodes) {
      fail(index, fmt::format("is too large: more than {} nodes, {} primitives or {} corners in total", kMostNodes,
                              kMostDraws, kMostDrawnCorners));
    }
  }

  // An instance is a child of the node whose mesh it shows.
  void add_instances(std::size_t index, const tinygltf::Value& extension, std::uint32_t mesh) {
    const tinygltf::Value& attributes = extension.Get("attributes");
    const auto read = [&](const char* name, int components) -> std::vector<float> {
      if (!attributes.Has(name)) return {};
      const int number = attributes.Get(name).GetNumberAsInt();
      const Accessor& accessor = accessors_[number];
      const bool is_rotation = components == 4;
      const bool right_type = accessor.is_float() || (is_rotation && accessor.normalized);
      if (accessor.components != components || accessor.matrix || !right_type || accessor.count > kMostNodes) {
        fail(index, fmt::format("has instances with {} of a forbidden type or number", name));
      }
      return accessors_.floats(number);
    };
    const auto translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4), scales = read("SCALE", 3);
    const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
    for (const auto& [size, width] :
         {std::pair(translations.size(), 3U), {rotations.size(), 4U}, {scales.size(), 3U}}) {
      if (size != 0 && size / width != count) fail(index, "has instances with attributes of different counts");
    }
    count_drawn(index, mesh, count);
    const auto parent = static_cast<NodeIndex>(scene_.nodes.size() - 1);
    const std::string name = scene_.nodes[parent].name.substr(0, 60);
    for (std::size_t i = 0; i < count; ++i) {
      NodeTransform transform;
      for (int k = 0; k < 3; ++k) {
        const auto at = 3 * i + static_cast<std::size_t>(k);
        if (!translations.empty()) transform.translation[k] = static_cast<double>(translations[at]);
        if (!scales.empty()) transform.scale[k] = static_cast<double>(scales[at]);
      }
      if (!rotations.empty()) {
        const float* q = &rotations[4 * i];
        transform.rotation = glm::dquat(glm::quat(q[3], q[0], q[1], q[2]));
        if (std::abs(glm::length(transform.rotation) - 1.0) > 0.01)
          fail(index, "has an instance with a ROTATION that is not of unit length");
        transform.rotation = glm::normalize(transform.rotation);
      }
      scene_.nodes.push_back(Node{fmt::format("{}#{}", name, i), parent, mesh, matrix_of(transform)});
    }
  }

  const tinygltf::Model& model_;
  const GltfAccessors& accessors_;
  Scene& scene_;
  GltfWarnings& notes_;
  NodePlaces places_;
  std::uint64_t drawn_corners_ = 0, draws_ = 0, moved_vertices_ = 0;
};

void read_skins(const tinygltf::Model& model, const GltfAccessors& accessors, const NodePlaces& places,
                GltfBudget& budget, Scene& scene) {
  std::vector<bool> used(model.skins.size(), false);
  for (const Node& node : scene.nodes) {
    if (node.skin) used[*node.skin] = true;
  }
  for (std::size_t i = 0; i < model.skins.size(); ++i) {
    const tinygltf::Skin& source = model.skins[i];
    Skin& skin = scene.skins.emplace_back();
    skin.name = source.name;
    if (source.joints.empty()) {
      if (used[i]) throw GltfError(fmt::format("/skins/{}/joints is a list of 0, but a node uses it", i));
      continue;
    }
    for (const int joint : source.joints) {
      const auto place = places[static_cast<std::size_t>(joint)];
      if (!place && used[i]) {
        throw GltfError(
            fmt::format("/skins/{} has the joint {}, which is not a node of the displayed scene", i, joint));
      }
      skin.joints.push_back(place.value_or(0));
    }
    budget.take(skin.joints.size(), sizeof(glm::mat4));
    skin.joint_from_mesh.assign(skin.joints.size(), glm::mat4(1.0F));
    if (source.inverseBindMatrices < 0) continue;
    const Accessor& accessor = accessors[source.inverseBindMatrices];
    if (!accessor.matrix || accessor.components != 16 || !accessor.is_float() || accessor.count < skin.joints.size()) {
      throw GltfError(
          fmt::format("/skins/{} has inverseBindMatrices that are not one 4 x 4 matrix of floats for each joint", i));
    }
    budget.take(accessor.count, sizeof(glm::mat4));
    const std::vector<float> numbers = accessors.floats(source.inverseBindMatrices);
    for (std::size_t k = 0; k < skin.joints.size(); ++k) skin.joint_from_mesh[k] = matrix_from(&numbers[16 * k]);
  }
}

std::uint32_t largest_joint(const Mesh& mesh) {
  std::uint32_t largest = 0;
  for (const Primitive& primitive : mesh.primitives) {
    for (const auto* stream : {&primitive.influences, &primitive.more_influences}) {
      for (const Influence& influence : *stream) {
        for (std::size_t k = 0; k < 4; ++k) largest = std::max(largest, influence.joints[k]);
      }
    }
  }
  return largest;
}

void check_joints(const Scene& scene) {
  std::vector<std::optional<std::uint32_t>> largest(scene.meshes.size());
  for (const Node& node : scene.nodes) {
    if (!node.skin || !node.mesh) continue;
    if (!largest[*node.mesh]) largest[*node.mesh] = largest_joint(scene.meshes[*node.mesh]);
    if (*largest[*node.mesh] >= scene.skins[*node.skin].joints.size()) {
      throw GltfError(fmt::format("/meshes/{} refers to joint {} of a skin that has {}", *node.mesh,
                                  *largest[*node.mesh], scene.skins[*node.skin].joints.size()));
    }
  }
}

void read_cameras(const tinygltf::Model& model, Scene& scene) {
  for (std::size_t i = 0; i < model.cameras.size(); ++i) {
    const tinygltf::Camera& source = model.cameras[i];
    Camera& camera = scene.cameras.emplace_back();
    camera.name = source.name;
    camera.perspective = source.type == "perspective";
    const auto positive = [](double number) {
      return number > 0 ? std::optional(static_cast<float>(number)) : std::nullopt;
    };
    if (camera.perspective) {
      camera.yfov_rad = static_cast<float>(source.perspective.yfov);
      camera.aspect_ratio = positive(source.perspective.aspectRatio);
      camera.near_m = static_cast<float>(source.perspective.znear);
      camera.far_m = positive(source.perspective.zfar);
    } else {
      camera.half_size_m = {source.orthographic.xmag, source.orthographic.ymag};
      camera.near_m = static_cast<float>(source.orthographic.znear);
      camera.far_m = static_cast<float>(source.orthographic.zfar);
    }
    if (camera.far_m && *camera.far_m <= camera.near_m) {
      throw GltfError(fmt::format("/cameras/{} has a zfar that is not beyond znear", i));
    }
  }
}

void read_lights(const tinygltf::Model& model, Scene& scene, GltfWarnings& notes) {
  constexpr float kNarrower = 0.999F;  // factor for the inner cone if the outer one has the same angle
  for (std::size_t i = 0; i < model.lights.size(); ++i) {
    const tinygltf::Light& source = model.lights[i];
    PunctualLight& light = scene.lights.emplace_back();
    light.name = source.name;
    const glm::dvec3 color =
        source.color.empty() ? glm::dvec3(1) : glm::dvec3(source.color[0], source.color[1], source.color[2]);
    light.intensity = glm::vec3(color * source.intensity);
    if (source.range > 0) light.range_m = static_cast<float>(source.range);
    light.kind = source.type == "point" ? PunctualLight::Kind::Point : PunctualLight::Kind::Directional;
    if (source.type != "spot") continue;
    light.kind = PunctualLight::Kind::Spot;
    light.inner_cone_rad = static_cast<float>(source.spot.innerConeAngle);
    light.outer_cone_rad = static_cast<float>(source.spot.outerConeAngle);
    const bool same =
        light.inner_cone_rad >= light.outer_cone_rad && light.inner_cone_rad <= 1.01F * light.outer_cone_rad;
    if (same && light.outer_cone_rad > 0.0F) {
      light.inner_cone_rad = kNarrower * light.outer_cone_rad;
      notes.correct(fmt::format("light {} has equal cones: the inner one is drawn narrower", i));
    }
    if (light.inner_cone_rad >= light.outer_cone_rad) {
      throw GltfError(
          fmt::format("/extensions/KHR_lights_punctual/lights/{} has an inner cone that is not within the "
                      "outer one",
                      i));
    }
  }
}

void read_variants(const tinygltf::Model& model, Scene& scene) {
  const auto* listed = find_extension(model.extensions, "KHR_materials_variants");
  if (listed == nullptr) return;
  for (const tinygltf::Value& variant : listed->Get("variants").Get<tinygltf::Value::Array>()) {
    scene.variants.push_back(variant.Get("name").Get<std::string>());
  }
}

}  // namespace

NodePlaces read_nodes(const tinygltf::Model& model, const GltfAccessors& accessors, GltfBudget& budget, Scene& scene,
                      GltfWarnings& notes) {
  read_cameras(model, scene);
  read_lights(model, scene, notes);
  read_variants(model, scene);
  const NodePlaces places = NodeReader(model, accessors, scene, notes).read();
  read_skins(model, accessors, places, budget, scene);
  check_joints(scene);
  if (model.scenes.size() > 1)
    notes.ignore(fmt::format("{} more scenes: only one is displayed", model.scenes.size() - 1));
  return places;
}

}  // namespace afm::scene
