// SPDX-License-Identifier: Apache-2.0
#include "gltf_nodes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "gltf_fault.h"
#include "gltf_transform.h"

namespace afm::scene {
namespace {

// With the instances of EXT_mesh_gpu_instancing; and the vertices that they show together.
constexpr std::uint64_t kMostNodes = 250'000;
constexpr std::uint64_t kMostDrawnCorners = 48'000'000;
constexpr std::uint64_t kMostDraws = 100'000;
// Of meshes with skins or morph targets, each of which is copied when it is posed.
constexpr std::uint64_t kMostMovedVertices = 4'000'000;

// The children of every node, each of which has at most one parent and is not its own ancestor.
std::vector<std::vector<std::uint32_t>> read_children(const std::vector<JsonElement>& nodes,
                                                      std::vector<bool>& has_parent) {
  std::vector<std::vector<std::uint32_t>> children(nodes.size());
  has_parent.assign(nodes.size(), false);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const JsonElement& element : nodes[i].values("children")) {
      const std::uint32_t child = element.as_index(nodes.size());
      if (has_parent[child]) element.fail(fmt::format("is node {}, which has more than one parent", child));
      has_parent[child] = true;
      children[i].push_back(child);
    }
  }

  // with one parent each, what the roots do not reach is a loop
  std::vector<std::uint32_t> reached;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (!has_parent[i]) reached.push_back(i);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    reached.insert(reached.end(), children[reached[next]].begin(), children[reached[next]].end());
  }
  if (reached.size() != nodes.size()) throw GltfFault("its nodes form a loop");
  return children;
}

// The roots to show: those of the default scene, of the first one, or of the whole file.
std::vector<std::uint32_t> shown_roots(const JsonElement& root, const std::vector<bool>& has_parent) {
  const std::vector<JsonElement> scenes = root.objects("scenes");
  const std::size_t shown = root.index("scene", scenes.size()).value_or(0);
  std::vector<std::uint32_t> roots;
  std::vector<std::size_t> listed_by(has_parent.size(), scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    for (const JsonElement& element : scenes[i].values("nodes")) {
      const std::uint32_t node = element.as_index(has_parent.size());
      if (has_parent[node] || listed_by[node] == i)
        element.fail(fmt::format("is node {}, not a root or listed twice", node));
      listed_by[node] = i;
      if (i == shown) roots.push_back(node);
    }
  }
  for (std::uint32_t i = 0; scenes.empty() && i < has_parent.size(); ++i) {
    if (!has_parent[i]) roots.push_back(i);
  }
  return roots;
}

class NodeReader {
 public:
  NodeReader(const JsonElement& root, const GltfAccessors& accessors, Scene& scene)
      : accessors_(accessors),
        scene_(scene),
        elements_(root.objects("nodes")),
        places_(elements_.size()),
        skins_(root.count("skins")),
        cameras_(root.count("cameras")) {
    const auto lights = root.extension("KHR_lights_punctual");
    lights_ = lights ? lights->count("lights") : 0;
  }

  // Depth first without recursion: a hierarchy may be as deep as it has nodes.
  NodePlaces read(const JsonElement& root) {
    std::vector<bool> has_parent;
    const auto children = read_children(elements_, has_parent);
    std::vector<std::pair<std::uint32_t, std::optional<NodeIndex>>> waiting;
    const auto roots = shown_roots(root, has_parent);
    for (auto node = roots.rbegin(); node != roots.rend(); ++node) waiting.emplace_back(*node, std::nullopt);
    while (!waiting.empty()) {
      const auto [index, parent] = waiting.back();
      waiting.pop_back();
      const auto place = static_cast<NodeIndex>(scene_.nodes.size());
      places_[index] = place;
      add(elements_[index], parent);
      for (auto child = children[index].rbegin(); child != children[index].rend(); ++child) {
        waiting.emplace_back(*child, place);
      }
    }
    return std::move(places_);
  }

 private:
  void add(const JsonElement& element, std::optional<NodeIndex> parent) {
    Node node{element.text("name", ""), parent, std::nullopt, matrix_of(read_transform(element))};
    const auto mesh = element.index("mesh", scene_.meshes.size());
    node.skin = element.index("skin", skins_);
    node.camera = element.index("camera", cameras_);
    if (const auto light = element.extension("KHR_lights_punctual"))
      node.light = light->required_index("light", lights_);
    node.role = read_role(element);
    if (node.skin && !mesh) element.fail("has a skin but no mesh");
    read_weights(element, mesh, node);
    const auto instances = element.extension("EXT_mesh_gpu_instancing");
    if (!instances) node.mesh = mesh;
    scene_.nodes.push_back(std::move(node));
    if (instances && mesh) {
      add_instances(*instances, *mesh);
    } else if (mesh) {
      count_drawn(element, *mesh, 1);
    }
  }

  void read_weights(const JsonElement& element, std::optional<std::uint32_t> mesh, Node& node) {
    const auto weights = element.values("weights");
    if (weights.empty()) return;
    if (!mesh || weights.size() != scene_.meshes[*mesh].weights.size()) {
      element.fail("has not as many weights as its mesh has morph targets");
    }
    for (const JsonElement& weight : weights) node.weights.push_back(static_cast<float>(weight.as_number()));
  }

  static std::string read_role(const JsonElement& element) {
    if (!element.has("extras") || !element.json()["extras"].is_object()) return {};
    const auto own = element.required_object("extras").object("touchafm");
    if (!own) return {};
    const std::string role = own->required_text("role");
    if (role != "tip" && role != "base" && role != "surface") own->fail("has a role that is not tip, base or surface");
    return role;
  }

  void count_drawn(const JsonElement& element, std::uint32_t mesh, std::uint64_t times) {
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
      element.fail(fmt::format("moves more than {} vertices together by skins and morph targets", kMostMovedVertices));
    }
    if (drawn_corners_ > kMostDrawnCorners || draws_ > kMostDraws || scene_.nodes.size() + times > kMostNodes) {
      element.fail(fmt::format("shows too much: more than {} nodes, {} primitives or {} corners together", kMostNodes,
                               kMostDraws, kMostDrawnCorners));
    }
  }

  // An instance is a node below the node whose mesh it shows.
  void add_instances(const JsonElement& extension, std::uint32_t mesh) {
    const JsonElement attributes = extension.required_object("attributes");
    const auto read = [&](const char* name, int components) -> std::vector<float> {
      const auto index = attributes.index(name, accessors_.size());
      if (!index) return {};
      const Accessor& accessor = accessors_[*index];
      const bool is_rotation = components == 4;
      const bool right_type = accessor.type == ComponentType::Float || (is_rotation && accessor.normalized);
      if (accessor.components != components || accessor.matrix || !right_type || accessor.count > kMostNodes) {
        attributes.fail(fmt::format("has {} of a type or number that it may not have", name));
      }
      return accessors_.floats(*index);
    };
    const auto translations = read("TRANSLATION", 3), rotations = read("ROTATION", 4), scales = read("SCALE", 3);
    const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
    for (const auto& [size, width] :
         {std::pair(translations.size(), 3U), {rotations.size(), 4U}, {scales.size(), 3U}}) {
      if (size != 0 && size / width != count) attributes.fail("has attributes of different counts");
    }
    count_drawn(extension, mesh, count);
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
        if (std::abs(glm::length(transform.rotation) - 1.0) > 0.01) attributes.fail("has a ROTATION of no unit length");
        transform.rotation = glm::normalize(transform.rotation);
      }
      scene_.nodes.push_back(Node{fmt::format("{}#{}", name, i), parent, mesh, matrix_of(transform)});
    }
  }

  const GltfAccessors& accessors_;
  Scene& scene_;
  std::vector<JsonElement> elements_;
  NodePlaces places_;
  std::size_t skins_, cameras_, lights_ = 0;
  std::uint64_t drawn_corners_ = 0, draws_ = 0, moved_vertices_ = 0;
};

void read_skins(const JsonElement& root, const GltfAccessors& accessors, const NodePlaces& places, GltfBudget& budget,
                Scene& scene) {
  std::vector<bool> used(root.count("skins"), false);
  for (const Node& node : scene.nodes) {
    if (node.skin) used[*node.skin] = true;
  }
  for (const JsonElement& element : root.objects("skins")) {
    Skin& skin = scene.skins.emplace_back();
    skin.name = element.text("name", "");
    for (const JsonElement& joint : element.values("joints")) {
      const auto place = places[joint.as_index(places.size())];
      if (!place && used[scene.skins.size() - 1]) joint.fail("is no node of the scene that is shown");
      skin.joints.push_back(place.value_or(0));
    }
    if (skin.joints.empty()) element.fail("has no joint");
    budget.take(skin.joints.size(), sizeof(glm::mat4));
    skin.joint_from_mesh.assign(skin.joints.size(), glm::mat4(1.0F));
    const auto index = element.index("inverseBindMatrices", accessors.size());
    if (!index) continue;
    const Accessor& accessor = accessors[*index];
    if (!accessor.matrix || accessor.components != 16 || accessor.type != ComponentType::Float ||
        accessor.count < skin.joints.size()) {
      element.fail("has inverseBindMatrices that are not one 4 x 4 matrix of floats for each joint");
    }
    budget.take(accessor.count, sizeof(glm::mat4));
    const std::vector<float> numbers = accessors.floats(*index);
    for (std::size_t i = 0; i < skin.joints.size(); ++i) skin.joint_from_mesh[i] = matrix_from(&numbers[16 * i]);
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
      throw GltfFault(fmt::format("/meshes/{} refers to joint {} of a skin that has {}", *node.mesh,
                                  *largest[*node.mesh], scene.skins[*node.skin].joints.size()));
    }
  }
}

void read_cameras(const JsonElement& root, Scene& scene) {
  constexpr JsonElement::Range kAbove{1e-30, 1e30};
  for (const JsonElement& element : root.objects("cameras")) {
    Camera& camera = scene.cameras.emplace_back();
    camera.name = element.text("name", "");
    const std::string type = element.required_text("type");
    if (type != "perspective" && type != "orthographic") element.fail("has a type that glTF does not know");
    camera.perspective = type == "perspective";
    const JsonElement lens = element.required_object(type.c_str());
    camera.near_m = static_cast<float>(lens.required_number("znear", {0, 1e30}));
    if (lens.has("zfar")) camera.far_m = static_cast<float>(lens.required_number("zfar", kAbove));
    if (camera.far_m && *camera.far_m <= camera.near_m) lens.fail("has a zfar that is not beyond znear");
    if (camera.perspective) {
      camera.yfov_rad = static_cast<float>(lens.required_number("yfov", {1e-6, 3.1415}));
      if (lens.has("aspectRatio"))
        camera.aspect_ratio = static_cast<float>(lens.required_number("aspectRatio", kAbove));
    } else {
      if (!camera.far_m) lens.fail("has no 'zfar'");
      camera.half_size_m = {lens.required_number("xmag", kAbove), lens.required_number("ymag", kAbove)};
    }
  }
}

void read_lights(const JsonElement& root, Scene& scene) {
  const auto extension = root.extension("KHR_lights_punctual");
  if (!extension) return;
  constexpr double kRightAngle = 1.5707963267948966;
  for (const JsonElement& element : extension->objects("lights")) {
    PunctualLight& light = scene.lights.emplace_back();
    light.name = element.text("name", "");
    const std::string type = element.required_text("type");
    if (type != "directional" && type != "point" && type != "spot") element.fail("has a type that is not known");
    std::array<double, 3> color{1, 1, 1};
    element.numbers("color", color, {0, 1e6});
    light.intensity = glm::vec3(glm::dvec3(color[0], color[1], color[2]) * element.number("intensity", 1, {0, 1e12}));
    if (element.has("range")) light.range_m = static_cast<float>(element.required_number("range", {1e-30, 1e30}));
    light.kind = type == "point" ? PunctualLight::Kind::Point : PunctualLight::Kind::Directional;
    if (type != "spot") continue;
    light.kind = PunctualLight::Kind::Spot;
    const JsonElement spot = element.required_object("spot");
    light.inner_cone_rad = static_cast<float>(spot.number("innerConeAngle", 0, {0, kRightAngle}));
    light.outer_cone_rad = static_cast<float>(spot.number("outerConeAngle", 0.25 * 3.14159265358979, {0, kRightAngle}));
    if (light.inner_cone_rad >= light.outer_cone_rad) spot.fail("has an inner cone that is not within the outer one");
  }
}

}  // namespace

NodePlaces read_nodes(const JsonElement& root, const GltfAccessors& accessors, GltfBudget& budget, Scene& scene,
                      GltfNotes& notes) {
  read_cameras(root, scene);
  read_lights(root, scene);
  if (const auto listed = root.extension("KHR_materials_variants")) {
    for (const JsonElement& variant : listed->objects("variants"))
      scene.variants.push_back(variant.required_text("name"));
  }
  const NodePlaces places = NodeReader(root, accessors, scene).read(root);
  read_skins(root, accessors, places, budget, scene);
  check_joints(scene);
  if (root.count("scenes") > 1)
    notes.ignore(fmt::format("{} more scenes: only one is shown", root.count("scenes") - 1));
  return places;
}

}  // namespace afm::scene
