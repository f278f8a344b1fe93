// SPDX-License-Identifier: Apache-2.0
#include "graph/gltf_meshes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <numeric>
#include <string_view>

#include "gltf_error.h"
#include "graph/gltf_attributes.h"
#include "graph/gltf_draco.h"
#include "graph/gltf_topology.h"
#include "scene/graph/flat_normals.h"

namespace afm::scene {
namespace {

constexpr float kRoundedWeight = 0.01F;  // largest negative weight due to an exporter's rounding

glm::vec3 unit_or(glm::vec3 direction, glm::vec3 missing) {
  const float length = glm::length(direction);
  return length > 0 && std::isfinite(length) ? direction / length : missing;
}

class PrimitiveReader {
 public:
  PrimitiveReader(std::string path, const tinygltf::Primitive& source, const tinygltf::Model& model,
                  const GltfBuffers& buffers, const GltfAccessors& accessors, GltfBudget& budget)
      : path_(std::move(path)),
        source_(source),
        buffers_(buffers),
        accessors_(accessors),
        budget_(budget),
        mode_(static_cast<std::uint64_t>(source.mode)),
        quantized_(uses_quantization(model)) {}

  // `default_material` is used for a primitive without one.
  Primitive read(std::uint32_t default_material) {
    primitive_.topology = topology_of(mode_);
    primitive_.material = source_.material < 0 ? default_material : static_cast<std::uint32_t>(source_.material);
    count_ = accessors_[source_.attributes.at("POSITION")].count;
    read_draco();
    read_vertices();
    read_corners();
    read_skinning();
    read_targets();
    read_variants();
    settle_normals();
    return std::move(primitive_);
  }

 private:
  using Attributes = std::map<std::string, int>;

  [[noreturn]] void fail(std::string_view reason) const { throw GltfError(fmt::format("{} {}", path_, reason)); }

  // Values of an attribute, `count_` of them, from its accessor.
  std::optional<std::vector<float>> floats(const Attributes& from, const char* name, AttributeOwner owner) {
    const auto found = from.find(name);
    if (found == from.end()) return std::nullopt;
    const Accessor& accessor = accessors_[found->second];
    check_attribute(path_, name, accessor, owner, quantized_);
    if (accessor.count != count_) fail(fmt::format("has {} {} but {} POSITION", accessor.count, name, count_));
    return accessors_.floats(found->second);
  }

  // Same for the primitive itself, which may have them in a Draco stream.
  std::optional<std::vector<float>> floats(const char* name) {
    const auto draco = draco_.attributes.find(name);
    if (draco != draco_.attributes.end()) return std::move(draco->second);
    return floats(source_.attributes, name, AttributeOwner::Primitive);
  }

  void read_draco() {
    const tinygltf::Value* draco = find_extension(source_.extensions, "KHR_draco_mesh_compression");
    if (draco == nullptr) return;
    if (mode_ != TINYGLTF_MODE_TRIANGLES) fail("compresses a primitive that is not a triangle list");
    if (source_.indices < 0) fail("has a Draco stream but no indices");
    const auto view = static_cast<std::size_t>(draco->Get("bufferView").GetNumberAsInt());
    const std::size_t corners = accessors_[source_.indices].count;
    std::vector<DracoAttribute> wanted;
    for (const auto& [name, id] : draco->Get("attributes").Get<tinygltf::Value::Object>()) {
      const auto accessor = source_.attributes.find(name);
      if (accessor == source_.attributes.end()) fail("has a Draco stream for an attribute that it lacks");
      const Accessor& described = accessors_[accessor->second];
      check_attribute(path_, name, described, AttributeOwner::Primitive, quantized_);
      if (described.count != count_) fail(fmt::format("has {} {} but {} POSITION", described.count, name, count_));
      wanted.push_back({name, static_cast<std::uint32_t>(id.GetNumberAsInt()), &described});
    }
    budget_.take(corners, sizeof(std::uint32_t));
    draco_ = decode_draco(buffers_.views()[view].bytes, corners, wanted);
    is_draco_ = true;
  }

  void read_vertices() {
    budget_.take(count_, sizeof(Vertex));
    primitive_.vertices.resize(count_);
    const auto positions = *floats("POSITION");
    for (std::size_t i = 0; i < count_; ++i) primitive_.vertices[i].position = glm::make_vec3(&positions[3 * i]);
    primitive_.normals = Normals::Given;
    if (const auto normals = floats("NORMAL")) {
      for (std::size_t i = 0; i < count_; ++i) {
        primitive_.vertices[i].normal = unit_or(glm::make_vec3(&(*normals)[3 * i]), glm::vec3(0, 0, 1));
      }
    } else {
      primitive_.normals = primitive_.topology == Topology::Triangles ? Normals::Flat : Normals::None;
    }
    if (const auto colors = floats("COLOR_0")) {
      const std::size_t width = colors->size() / count_;
      for (std::size_t i = 0; i < count_; ++i) {
        const float* color = &(*colors)[width * i];
        primitive_.vertices[i].color = glm::vec4(color[0], color[1], color[2], width == 4 ? color[3] : 1.0F);
      }
    }
    read_texture_coordinates();

    // tangents belong to normals from the file; for flat normals they are computed when drawing
    if (primitive_.normals != Normals::Given) return;
    if (const auto tangents = floats("TANGENT")) {
      budget_.take(count_, sizeof(glm::vec4));
      for (std::size_t i = 0; i < count_; ++i) {
        const float* t = &(*tangents)[4 * i];
        primitive_.tangents.emplace_back(unit_or(glm::make_vec3(t), glm::vec3(1, 0, 0)), t[3] < 0 ? -1.0F : 1.0F);
      }
    }
  }

  void read_texture_coordinates() {
    const auto first = floats("TEXCOORD_0"), second = floats("TEXCOORD_1");
    if (!first && !second) return;
    budget_.take(count_, sizeof(TextureCoordinates));
    primitive_.texture_coordinates.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (first) primitive_.texture_coordinates[i].set_0 = glm::make_vec2(&(*first)[2 * i]);
      if (second) primitive_.texture_coordinates[i].set_1 = glm::make_vec2(&(*second)[2 * i]);
    }
  }

  void read_corners() {
    std::vector<std::uint32_t> corners;
    if (is_draco_) {
      corners = std::move(draco_.indices);
    } else if (source_.indices >= 0) {
      const Accessor& accessor = accessors_[source_.indices];
      check_indices(path_, accessor);
      corners = accessors_.integers(source_.indices);
      const std::uint32_t restart = restart_index(accessor);
      if (std::find(corners.begin(), corners.end(), restart) != corners.end()) {
        fail(fmt::format("has index {}, which would restart the primitive", restart));
      }
    } else {
      corners.resize(count_);
      std::iota(corners.begin(), corners.end(), 0U);
    }
    for (const std::uint32_t corner : corners) {
      if (corner >= count_) fail(fmt::format("has index {} but only {} vertices", corner, count_));
    }
    const std::uint64_t size = list_size(mode_, corners.size());
    if (size == 0) {
      fail(fmt::format("has {} corners, which is not a whole number of points, lines or triangles", corners.size()));
    }
    budget_.take(size, sizeof(std::uint32_t));
    primitive_.indices = as_list(mode_, std::move(corners));
  }

  void read_skinning() {
    read_influences("JOINTS_0", "WEIGHTS_0", primitive_.influences);
    read_influences("JOINTS_1", "WEIGHTS_1", primitive_.more_influences);
  }

  void read_influences(const char* joints_name, const char* weights_name, std::vector<Influence>& influences) {
    if (source_.attributes.count(joints_name) != source_.attributes.count(weights_name)) {
      fail("has joints without weights, or weights without joints");
    }
    const auto joints = floats(joints_name), weights = floats(weights_name);
    if (!joints || !weights) return;
    budget_.take(count_, sizeof(Influence));
    influences.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        influences[i].joints[k] = static_cast<std::uint32_t>((*joints)[4 * i + k]);
        const float weight = (*weights)[4 * i + k];
        if (weight < -kRoundedWeight) fail(fmt::format("has a negative {}", weights_name));
        influences[i].weights[static_cast<int>(k)] = std::max(weight, 0.0F);
      }
    }
  }

  std::vector<glm::vec3> target_stream(const Attributes& target, const char* name) {
    std::vector<glm::vec3> stream;
    const auto values = floats(target, name, AttributeOwner::Target);
    if (!values) return stream;
    budget_.take(count_, sizeof(glm::vec3));
    for (std::size_t i = 0; i < count_; ++i) stream.push_back(glm::make_vec3(&(*values)[3 * i]));
    return stream;
  }

  void read_targets() {
    for (const Attributes& target : source_.targets) {
      MorphTarget& made = primitive_.targets.emplace_back();
      made.positions = target_stream(target, "POSITION");
      made.normals = target_stream(target, "NORMAL");
      made.tangents = target_stream(target, "TANGENT");
    }
  }

  void read_variants() {
    const tinygltf::Value* extension = find_extension(source_.extensions, "KHR_materials_variants");
    if (extension == nullptr) return;
    using Values = tinygltf::Value::Array;
    for (const tinygltf::Value& mapping : extension->Get("mappings").Get<Values>()) {
      const auto material = static_cast<std::uint32_t>(mapping.Get("material").GetNumberAsInt());
      for (const tinygltf::Value& variant : mapping.Get("variants").Get<Values>()) {
        primitive_.variants.push_back({static_cast<std::uint32_t>(variant.GetNumberAsInt()), material});
      }
    }
  }

  void settle_normals() {
    if (primitive_.normals != Normals::Flat) return;
    std::uint64_t bytes = sizeof(Vertex);
    if (!primitive_.texture_coordinates.empty()) bytes += sizeof(TextureCoordinates);
    bytes += sizeof(Influence) * (!primitive_.influences.empty() + !primitive_.more_influences.empty());
    bytes += 3 * sizeof(glm::vec3) * primitive_.targets.size();
    budget_.take(primitive_.indices.size(), bytes);
    separate_corners(primitive_);
    set_flat_normals(primitive_);
  }

  std::string path_;
  const tinygltf::Primitive& source_;
  const GltfBuffers& buffers_;
  const GltfAccessors& accessors_;
  GltfBudget& budget_;
  std::uint64_t mode_;
  bool quantized_;
  Primitive primitive_;
  std::size_t count_ = 0;
  DracoMesh draco_;
  bool is_draco_ = false;
};

void read_weights(std::size_t index, const tinygltf::Mesh& source, Mesh& mesh) {
  if (mesh.primitives.empty()) return;
  const std::size_t targets = mesh.primitives.front().targets.size();
  for (const Primitive& primitive : mesh.primitives) {
    if (primitive.targets.size() != targets) {
      throw GltfError(fmt::format("/meshes/{} has primitives with different numbers of morph targets", index));
    }
  }
  if (!source.weights.empty() && source.weights.size() != targets) {
    throw GltfError(fmt::format("/meshes/{} has different numbers of weights and morph targets", index));
  }
  mesh.weights.assign(source.weights.begin(), source.weights.end());
  mesh.weights.resize(targets, 0.0F);
}

bool is_drawn(const tinygltf::Primitive& primitive, GltfWarnings& notes) {
  for (const auto& [name, accessor] : primitive.attributes) {
    if (!is_read_attribute(name)) notes.ignore(fmt::format("attribute {}: not drawn", name));
  }
  const bool has_position = primitive.attributes.count("POSITION") != 0;
  if (!has_position) notes.ignore("a primitive without POSITION: cannot be drawn");
  return has_position;
}

}  // namespace

void read_meshes(const tinygltf::Model& model, const GltfBuffers& buffers, const GltfAccessors& accessors,
                 GltfBudget& budget, Scene& scene, GltfWarnings& notes) {
  const auto default_material = static_cast<std::uint32_t>(scene.materials.size());
  std::vector<bool> used(model.meshes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    if (node.mesh >= 0) used[static_cast<std::size_t>(node.mesh)] = true;
  }
  bool uses_default = false;
  for (std::size_t m = 0; m < model.meshes.size(); ++m) {
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.name = model.meshes[m].name;
    if (used[m] && model.meshes[m].primitives.empty()) notes.ignore(fmt::format("/meshes/{}: has no primitives", m));
    try {
      for (std::size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
        const tinygltf::Primitive& primitive = model.meshes[m].primitives[p];
        if (!is_drawn(primitive, notes)) continue;
        uses_default |= primitive.material < 0;
        PrimitiveReader reader(fmt::format("/meshes/{}/primitives/{}", m, p), primitive, model, buffers, accessors,
                               budget);
        mesh.primitives.push_back(reader.read(default_material));
      }
      read_weights(m, model.meshes[m], mesh);
    } catch (const GltfError& fault) {
      if (used[m]) throw;
      mesh.primitives.clear();
      notes.ignore(fmt::format("/meshes/{}: no node uses it, and it cannot be read ({})", m, fault.what()));
    }
  }
  if (uses_default) scene.materials.push_back(PbrMaterial{.name = "default"});
}

}  // namespace afm::scene
