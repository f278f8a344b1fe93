// SPDX-License-Identifier: Apache-2.0
#include "gltf_validation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "gltf_accessor.h"

namespace afm::scene {
namespace {

using Complaint = std::optional<std::string>;
constexpr Complaint kNone = std::nullopt;

// Vertices and indices that the scene would hold, each; meshes may share accessors, so that a small file can ask for
// much.
constexpr std::uint64_t kMostVertices = 8'000'000;

template <class T>
bool is_index(int value, const std::vector<T>& list) {
  return value >= 0 && static_cast<std::size_t>(value) < list.size();
}

Complaint missing(std::string_view owner, std::size_t owner_index, std::string_view what, int index) {
  return fmt::format("{} {} refers to {} {}, which does not exist", owner, owner_index, what, index);
}

bool all_finite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

bool all_within(const std::vector<double>& numbers, double low, double high) {
  return std::all_of(numbers.begin(), numbers.end(), [&](double number) { return number >= low && number <= high; });
}

Complaint check_extensions(const tinygltf::Model& model) {
  for (const std::string& name : model.extensionsRequired) {
    if (name != "KHR_materials_unlit" && name != "KHR_materials_emissive_strength") {
      return fmt::format("it requires the extension '{}', which is not supported", name.substr(0, 80));
    }
  }
  return kNone;
}

Complaint check_buffer_views(const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = model.bufferViews[i];
    if (!is_index(view.buffer, model.buffers)) return missing("buffer view", i, "buffer", view.buffer);
    const std::size_t size = model.buffers[static_cast<std::size_t>(view.buffer)].data.size();
    if (view.byteLength == 0) return fmt::format("buffer view {} is empty", i);
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset) {
      return fmt::format("buffer view {} reaches past the end of its buffer", i);
    }
  }
  return kNone;
}

Complaint check_accessors(const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    const tinygltf::Accessor& accessor = model.accessors[i];
    if (accessor.sparse.isSparse) return fmt::format("accessor {} is sparse, which is not supported", i);
    if (!is_index(accessor.bufferView, model.bufferViews))
      return missing("accessor", i, "buffer view", accessor.bufferView);
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const int component = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (component <= 0 || components <= 0) return fmt::format("accessor {} is of an unknown type", i);
    const auto element = static_cast<std::uint64_t>(component) * static_cast<std::uint64_t>(components);
    const std::uint64_t stride = view.byteStride != 0 ? view.byteStride : element;
    if (stride < element) return fmt::format("accessor {} has elements that overlap", i);

    // an element takes at least a byte, which keeps the product below far from overflow
    const std::uint64_t length = view.byteLength;
    if (accessor.count == 0 || accessor.count > length || accessor.byteOffset > length ||
        (accessor.count - 1) * stride + element > length - accessor.byteOffset) {
      return fmt::format("accessor {} reaches past the end of its buffer view", i);
    }
  }
  return kNone;
}

bool is_of(const tinygltf::Accessor& accessor, int type, int component_type) {
  return accessor.type == type && accessor.componentType == component_type;
}

bool is_color(const tinygltf::Accessor& accessor) {
  if (accessor.type != TINYGLTF_TYPE_VEC3 && accessor.type != TINYGLTF_TYPE_VEC4) return false;
  return accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
         (accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                  accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT));
}

bool is_index_list(const tinygltf::Accessor& accessor) {
  return accessor.type == TINYGLTF_TYPE_SCALAR && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                                   accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                                   accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

Complaint check_attributes(const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::size_t mesh) {
  if (primitive.attributes.count("POSITION") == 0) return fmt::format("mesh {} has a primitive without POSITION", mesh);
  std::size_t count = 0;
  for (const char* name : {"POSITION", "NORMAL", "COLOR_0"}) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) continue;
    if (!is_index(attribute->second, model.accessors)) return missing("mesh", mesh, "accessor", attribute->second);
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(attribute->second)];
    const bool color = std::string_view(name) == "COLOR_0";
    if (color ? !is_color(accessor) : !is_of(accessor, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT)) {
      return fmt::format("mesh {} has {} of a type that is not supported", mesh, name);
    }
    if (count == 0) count = accessor.count;
    if (accessor.count != count) return fmt::format("mesh {} has attributes of different counts", mesh);
    const AccessorReader reader(model, attribute->second);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::vec4 value = reader.floats(i);
      if (!std::isfinite(value.x) || !std::isfinite(value.y) || !std::isfinite(value.z) || !std::isfinite(value.w)) {
        return fmt::format("mesh {} has a {} that is not a finite number", mesh, name);
      }
    }
  }
  return kNone;
}

Complaint check_indices(const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::size_t mesh) {
  const int position = primitive.attributes.at("POSITION");
  const std::size_t vertices = model.accessors[static_cast<std::size_t>(position)].count;
  std::size_t corners = vertices;
  if (primitive.indices != -1) {
    if (!is_index(primitive.indices, model.accessors)) return missing("mesh", mesh, "accessor", primitive.indices);
    if (!is_index_list(model.accessors[static_cast<std::size_t>(primitive.indices)])) {
      return fmt::format("mesh {} has indices of a type that is not supported", mesh);
    }
    const AccessorReader reader(model, primitive.indices);
    corners = reader.count();
    for (std::size_t i = 0; i < corners; ++i) {
      if (reader.index(i) >= vertices) {
        return fmt::format("mesh {} has index {} but only {} vertices", mesh, reader.index(i), vertices);
      }
    }
  }
  if (corners % 3 != 0) return fmt::format("mesh {} has {} corners, not a whole number of triangles", mesh, corners);
  return kNone;
}

Complaint check_meshes(const tinygltf::Model& model) {
  std::uint64_t total = 0;
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    if (model.meshes[i].primitives.empty()) return fmt::format("mesh {} has no primitive", i);
    for (const tinygltf::Primitive& primitive : model.meshes[i].primitives) {
      if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
        return fmt::format("mesh {} has a primitive of mode {}; only triangle lists (4) are supported", i,
                           primitive.mode);
      }
      if (primitive.material != -1 && !is_index(primitive.material, model.materials)) {
        return missing("mesh", i, "material", primitive.material);
      }
      if (Complaint complaint = check_attributes(model, primitive, i)) return complaint;
      if (Complaint complaint = check_indices(model, primitive, i)) return complaint;
      const AccessorReader longest(model,
                                   primitive.indices != -1 ? primitive.indices : primitive.attributes.at("POSITION"));
      total += std::max(longest.count(), AccessorReader(model, primitive.attributes.at("POSITION")).count());
      if (total > kMostVertices) return fmt::format("its meshes have more than {} vertices or indices", kMostVertices);
    }
  }
  return kNone;
}

Complaint check_materials(const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const tinygltf::Material& material = model.materials[i];
    const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
    if (pbr.baseColorFactor.size() != 4 || material.emissiveFactor.size() != 3 ||
        !all_within(pbr.baseColorFactor, 0, 1) || !all_within(material.emissiveFactor, 0, 1) ||
        !all_within({pbr.metallicFactor, pbr.roughnessFactor}, 0, 1)) {
      return fmt::format("material {} has a factor outside 0..1", i);
    }
    const auto strength = material.extensions.find("KHR_materials_emissive_strength");
    if (strength != material.extensions.end() && strength->second.Has("emissiveStrength")) {
      const tinygltf::Value& value = strength->second.Get("emissiveStrength");
      if (!value.IsNumber() || !all_within({value.GetNumberAsDouble()}, 0, 1e6)) {
        return fmt::format("material {} has an emissiveStrength outside 0..1e6", i);
      }
    }
  }
  return kNone;
}

Complaint check_nodes(const tinygltf::Model& model) {
  const auto is_size = [](const std::vector<double>& list, std::size_t size) {
    return list.empty() || list.size() == size;
  };
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const tinygltf::Node& node = model.nodes[i];
    if (node.mesh != -1 && !is_index(node.mesh, model.meshes)) return missing("node", i, "mesh", node.mesh);
    if (!is_size(node.matrix, 16) || !is_size(node.translation, 3) || !is_size(node.rotation, 4) ||
        !is_size(node.scale, 3)) {
      return fmt::format("node {} has a transform with a wrong number of elements", i);
    }
    if (!all_finite(node.matrix) || !all_finite(node.translation) || !all_finite(node.rotation) ||
        !all_finite(node.scale)) {
      return fmt::format("node {} has a transform that is not a finite number", i);
    }
    const std::vector<double>& m = node.matrix;
    if (!m.empty() && (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)) {
      return fmt::format("node {} has a matrix that is not affine", i);
    }
    double norm = 0;
    for (const double q : node.rotation) norm += q * q;
    if (!node.rotation.empty() && std::abs(norm - 1) > 0.01)
      return fmt::format("node {} has a rotation that is no unit quaternion", i);
  }
  return kNone;
}

// Every node has at most one parent and none is its own ancestor; the scene's nodes are roots.
Complaint check_hierarchy(const tinygltf::Model& model) {
  std::vector<bool> has_parent(model.nodes.size(), false);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    for (const int child : model.nodes[i].children) {
      if (!is_index(child, model.nodes)) return missing("node", i, "node", child);
      if (has_parent[static_cast<std::size_t>(child)]) return fmt::format("node {} has more than one parent", child);
      has_parent[static_cast<std::size_t>(child)] = true;
    }
  }

  // with one parent each, what the roots do not reach is a loop
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!has_parent[i]) reached.push_back(i);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const int child : model.nodes[reached[next]].children) reached.push_back(static_cast<std::size_t>(child));
  }
  if (reached.size() != model.nodes.size()) return "its nodes form a loop";

  if (model.defaultScene != -1 && !is_index(model.defaultScene, model.scenes)) {
    return fmt::format("its default scene {} does not exist", model.defaultScene);
  }
  std::vector<std::size_t> listed_by(model.nodes.size(), model.scenes.size());
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    for (const int node : model.scenes[i].nodes) {
      if (!is_index(node, model.nodes)) return missing("scene", i, "node", node);
      const auto index = static_cast<std::size_t>(node);
      if (has_parent[index] || listed_by[index] == i) {
        return fmt::format("scene {} lists node {}, which is not a root or stands twice", i, node);
      }
      listed_by[index] = i;
    }
  }
  return kNone;
}

}  // namespace

std::optional<std::string> complaint_about(const tinygltf::Model& model) {
  // each check relies on those before it
  for (const auto check : {check_extensions, check_buffer_views, check_accessors, check_meshes, check_materials,
                           check_nodes, check_hierarchy}) {
    if (Complaint complaint = check(model)) return complaint;
  }
  return kNone;
}

}  // namespace afm::scene
