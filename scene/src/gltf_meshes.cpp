// SPDX-License-Identifier: Apache-2.0
#include "gltf_meshes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

#include "flat_normals.h"
#include "gltf_attributes.h"
#include "gltf_draco.h"
#include "gltf_topology.h"

namespace afm::scene {
namespace {

glm::vec3 unit_or(glm::vec3 direction, glm::vec3 missing) {
  const float length = glm::length(direction);
  return length > 0 && std::isfinite(length) ? direction / length : missing;
}

class PrimitiveReader {
 public:
  PrimitiveReader(const JsonElement& element, const JsonElement& root, const GltfBuffers& buffers,
                  const GltfAccessors& accessors, GltfBudget& budget)
      : element_(element),
        root_(root),
        buffers_(buffers),
        accessors_(accessors),
        budget_(budget),
        attributes_(element.required_object("attributes")),
        quantized_(uses_quantization(root)) {}

  // `default_material` is that of a primitive without one.
  Primitive read(std::uint32_t default_material) {
    const std::uint64_t mode = element_.size("mode", 4, kMostMode);
    primitive_.topology = topology_of(mode);
    primitive_.material = element_.index("material", root_.count("materials")).value_or(default_material);
    const auto position = attributes_.required_index("POSITION", accessors_.size());
    count_ = accessors_[position].count;
    if (const auto draco = element_.extension("KHR_draco_mesh_compression")) read_draco(*draco, mode);
    read_vertices();
    read_corners(mode);
    read_skinning();
    read_targets();
    read_variants();
    settle_normals();
    return std::move(primitive_);
  }

 private:
  // The values of an attribute, `count_` of them, out of its accessor or of the Draco stream.
  std::optional<std::vector<float>> floats(const JsonElement& from, const char* name) {
    const auto index = from.index(name, accessors_.size());
    if (!index) return std::nullopt;
    const Accessor& accessor = accessors_[*index];
    const auto draco = draco_.attributes.find(name);
    const auto owner = &from == &attributes_ ? AttributeOwner::Primitive : AttributeOwner::Target;
    const bool compressed = draco != draco_.attributes.end() && owner == AttributeOwner::Primitive;
    check_attribute(from, name, accessor, owner, quantized_);
    if (accessor.count != count_) from.fail(fmt::format("has {} {} but {} POSITION", accessor.count, name, count_));
    return compressed ? std::move(draco->second) : accessors_.floats(*index);
  }

  void read_draco(const JsonElement& draco, std::uint64_t mode) {
    if (mode != 4) draco.fail("compresses what is no list of triangles");
    const auto view = draco.required_index("bufferView", buffers_.views().size());
    const auto corners = element_.required_index("indices", accessors_.size());
    const JsonElement ids = draco.required_object("attributes");
    std::vector<DracoAttribute> wanted;
    for (const std::string& name : ids.keys()) {
      const auto accessor = attributes_.index(name.c_str(), accessors_.size());
      if (!accessor) ids.fail("names an attribute that the primitive has not");
      check_attribute(attributes_, name.c_str(), accessors_[*accessor], AttributeOwner::Primitive, quantized_);
      wanted.push_back(
          {name, static_cast<std::uint32_t>(ids.required_size(name.c_str(), 65535)), &accessors_[*accessor]});
    }
    budget_.take(accessors_[corners].count, sizeof(std::uint32_t));
    draco_ = decode_draco(buffers_.views()[view].bytes, accessors_[corners].count, wanted);
    is_draco_ = true;
  }

  void read_vertices() {
    budget_.take(count_, sizeof(Vertex));
    primitive_.vertices.resize(count_);
    const auto positions = *floats(attributes_, "POSITION");
    for (std::size_t i = 0; i < count_; ++i) primitive_.vertices[i].position = glm::make_vec3(&positions[3 * i]);
    primitive_.normals = Normals::Given;
    if (const auto normals = floats(attributes_, "NORMAL")) {
      for (std::size_t i = 0; i < count_; ++i) {
        primitive_.vertices[i].normal = unit_or(glm::make_vec3(&(*normals)[3 * i]), glm::vec3(0, 0, 1));
      }
    } else {
      primitive_.normals = primitive_.topology == Topology::Triangles ? Normals::Flat : Normals::None;
    }
    if (const auto colors = floats(attributes_, "COLOR_0")) {
      const std::size_t width = colors->size() / count_;
      for (std::size_t i = 0; i < count_; ++i) {
        const float* color = &(*colors)[width * i];
        primitive_.vertices[i].color = glm::vec4(color[0], color[1], color[2], width == 4 ? color[3] : 1.0F);
      }
    }
    read_texture_coordinates();

    // tangents belong to normals of the file; flat ones get theirs where they are drawn
    if (primitive_.normals != Normals::Given) return;
    if (const auto tangents = floats(attributes_, "TANGENT")) {
      budget_.take(count_, sizeof(glm::vec4));
      for (std::size_t i = 0; i < count_; ++i) {
        const float* t = &(*tangents)[4 * i];
        primitive_.tangents.emplace_back(unit_or(glm::make_vec3(t), glm::vec3(1, 0, 0)), t[3] < 0 ? -1.0F : 1.0F);
      }
    }
  }

  void read_texture_coordinates() {
    const auto first = floats(attributes_, "TEXCOORD_0"), second = floats(attributes_, "TEXCOORD_1");
    if (!first && !second) return;
    budget_.take(count_, sizeof(TextureCoordinates));
    primitive_.texture_coordinates.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (first) primitive_.texture_coordinates[i].set_0 = glm::make_vec2(&(*first)[2 * i]);
      if (second) primitive_.texture_coordinates[i].set_1 = glm::make_vec2(&(*second)[2 * i]);
    }
  }

  void read_corners(std::uint64_t mode) {
    std::vector<std::uint32_t> corners;
    if (is_draco_) {
      corners = std::move(draco_.indices);
    } else if (const auto index = element_.index("indices", accessors_.size())) {
      check_indices(element_, accessors_[*index]);
      corners = accessors_.integers(*index);
    } else {
      corners.resize(count_);
      std::iota(corners.begin(), corners.end(), 0U);
    }
    for (const std::uint32_t corner : corners) {
      if (corner >= count_) element_.fail(fmt::format("has index {} but only {} vertices", corner, count_));
    }
    const std::uint64_t size = list_size(mode, corners.size());
    if (size == 0) {
      element_.fail(fmt::format("has {} corners, no whole number of points, lines or triangles", corners.size()));
    }
    budget_.take(size, sizeof(std::uint32_t));
    primitive_.indices = as_list(mode, std::move(corners));
  }

  void read_skinning() {
    read_influences("JOINTS_0", "WEIGHTS_0", primitive_.influences);
    read_influences("JOINTS_1", "WEIGHTS_1", primitive_.more_influences);
  }

  void read_influences(const char* joints_name, const char* weights_name, std::vector<Influence>& influences) {
    if (attributes_.has(joints_name) != attributes_.has(weights_name)) {
      attributes_.fail("has joints without weights, or weights without joints");
    }
    const auto joints = floats(attributes_, joints_name), weights = floats(attributes_, weights_name);
    if (!joints || !weights) return;
    budget_.take(count_, sizeof(Influence));
    influences.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        influences[i].joints[k] = static_cast<std::uint32_t>((*joints)[4 * i + k]);
        const float weight = (*weights)[4 * i + k];
        if (weight < 0) attributes_.fail(fmt::format("has a negative {}", weights_name));
        influences[i].weights[static_cast<int>(k)] = weight;
      }
    }
  }

  std::vector<glm::vec3> target_stream(const JsonElement& target, const char* name) {
    std::vector<glm::vec3> stream;
    const auto values = floats(target, name);
    if (!values) return stream;
    budget_.take(count_, sizeof(glm::vec3));
    for (std::size_t i = 0; i < count_; ++i) stream.push_back(glm::make_vec3(&(*values)[3 * i]));
    return stream;
  }

  void read_targets() {
    for (const JsonElement& target : element_.objects("targets")) {
      MorphTarget& made = primitive_.targets.emplace_back();
      made.positions = target_stream(target, "POSITION");
      made.normals = target_stream(target, "NORMAL");
      made.tangents = target_stream(target, "TANGENT");
    }
  }

  void read_variants() {
    const auto extension = element_.extension("KHR_materials_variants");
    if (!extension) return;
    const auto listed = root_.extension("KHR_materials_variants");
    const std::size_t variants = listed ? listed->count("variants") : 0;
    for (const JsonElement& mapping : extension->objects("mappings")) {
      const auto material = mapping.required_index("material", root_.count("materials"));
      for (const JsonElement& variant : mapping.values("variants")) {
        primitive_.variants.push_back({variant.as_index(variants), material});
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

  const JsonElement& element_;
  const JsonElement& root_;
  const GltfBuffers& buffers_;
  const GltfAccessors& accessors_;
  GltfBudget& budget_;
  JsonElement attributes_;
  bool quantized_;
  Primitive primitive_;
  std::size_t count_ = 0;
  DracoMesh draco_;
  bool is_draco_ = false;
};

void note_unread_attributes(const JsonElement& primitive, GltfNotes& notes) {
  for (const std::string& name : primitive.required_object("attributes").keys()) {
    if (!is_read_attribute(name)) notes.ignore(fmt::format("attribute {}: nothing is drawn from it", name));
  }
}

void read_weights(const JsonElement& element, Mesh& mesh) {
  const std::size_t targets = mesh.primitives.front().targets.size();
  for (const Primitive& primitive : mesh.primitives) {
    if (primitive.targets.size() != targets) element.fail("has primitives with different numbers of morph targets");
  }
  mesh.weights.assign(targets, 0.0F);
  const auto weights = element.values("weights");
  if (!weights.empty() && weights.size() != targets) element.fail("has not as many weights as morph targets");
  for (std::size_t i = 0; i < weights.size(); ++i) mesh.weights[i] = static_cast<float>(weights[i].as_number());
}

}  // namespace

void read_meshes(const JsonElement& root, const GltfBuffers& buffers, const GltfAccessors& accessors,
                 GltfBudget& budget, Scene& scene, GltfNotes& notes) {
  const auto default_material = static_cast<std::uint32_t>(scene.materials.size());
  bool uses_default = false;
  for (const JsonElement& element : root.objects("meshes")) {
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.name = element.text("name", "");
    for (const JsonElement& primitive : element.objects("primitives")) {
      note_unread_attributes(primitive, notes);
      if (!primitive.required_object("attributes").has("POSITION")) {
        notes.ignore("a primitive without POSITION: nothing can be drawn of it");
        continue;
      }
      uses_default |= !primitive.has("material");
      mesh.primitives.push_back(PrimitiveReader(primitive, root, buffers, accessors, budget).read(default_material));
    }
    if (element.count("primitives") == 0) element.fail("has no primitive");
    if (!mesh.primitives.empty()) read_weights(element, mesh);
  }
  if (uses_default) scene.materials.push_back(Material{.name = "default"});
}

}  // namespace afm::scene
