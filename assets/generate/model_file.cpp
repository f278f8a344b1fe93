// SPDX-License-Identifier: Apache-2.0
#include "model_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace afm::generate {
namespace {

constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

struct Writer {
  Json root;
  std::vector<std::uint8_t> binary;

  void put(std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) binary.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void put(float value) { put(std::bit_cast<std::uint32_t>(value), 4); }
};

std::array<double, 3> components(V3 v) { return {v.x, v.y, v.z}; }

// A power of two that divides the mesh's size into at most 2^22 steps, so that every multiple is a float.
double position_grid(const Surface& surface) {
  double size = 0;
  for (const SurfaceVertex& vertex : surface.vertices) {
    for (const double c : components(vertex.position)) size = std::max(size, std::abs(c));
  }
  double grid = 1;
  while (grid > size) grid /= 2;
  while (grid < size) grid *= 2;
  return grid / (1U << 22U);
}

// Same surface on the grid, without the triangles that have no area there.
Surface on_grid(const Surface& surface) {
  const double grid = position_grid(surface);
  const auto round = [grid](double c) { return std::floor(c / grid + 0.5) * grid; };
  Surface result;
  for (SurfaceVertex vertex : surface.vertices) {
    vertex.position = {round(vertex.position.x), round(vertex.position.y), round(vertex.position.z)};
    result.add(vertex);
  }
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    result.add_triangle(surface.indices[i], surface.indices[i + 1], surface.indices[i + 2]);
  }
  return result;
}

std::size_t add_view(Writer& writer, std::size_t offset, int target, std::optional<int> stride) {
  Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", writer.binary.size() - offset}};
  if (stride) view["byteStride"] = *stride;
  view["target"] = target;
  while (writer.binary.size() % 4 != 0) writer.binary.push_back(0);
  writer.root["bufferViews"].push_back(view);
  return writer.root["bufferViews"].size() - 1;
}

std::size_t add_accessor(Writer& writer, Json accessor) {
  writer.root["accessors"].push_back(std::move(accessor));
  return writer.root["accessors"].size() - 1;
}

Json add_attributes(Writer& writer, const Surface& surface, bool colors) {
  const std::size_t offset = writer.binary.size();
  std::array<double, 3> low{}, high{};
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const SurfaceVertex& vertex = surface.vertices[i];
    const std::array<double, 3> position = components(vertex.position);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto stored = static_cast<float>(position[k]);
      low[k] = i == 0 ? static_cast<double>(stored) : std::min(low[k], static_cast<double>(stored));
      high[k] = i == 0 ? static_cast<double>(stored) : std::max(high[k], static_cast<double>(stored));
      writer.put(stored);
    }
    for (const double c : components(vertex.normal)) writer.put(static_cast<float>(c));
    if (!colors) continue;
    const V3 color = vertex.color;
    for (const double c : {color.x, color.y, color.z, vertex.alpha})
      writer.put(static_cast<std::uint32_t>(std::lround(std::clamp(c, 0.0, 1.0) * 255)), 1);
  }

  const std::size_t view = add_view(writer, offset, kArrayBuffer, colors ? 28 : 24);
  const std::size_t count = surface.vertices.size();
  Json attributes;
  attributes["POSITION"] = add_accessor(writer, {{"bufferView", view},
                                                 {"componentType", kFloat},
                                                 {"count", count},
                                                 {"type", "VEC3"},
                                                 {"min", low},
                                                 {"max", high}});
  attributes["NORMAL"] = add_accessor(
      writer,
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", kFloat}, {"count", count}, {"type", "VEC3"}});
  if (colors) {
    attributes["COLOR_0"] = add_accessor(writer, {{"bufferView", view},
                                                  {"byteOffset", 24},
                                                  {"componentType", kUnsignedByte},
                                                  {"normalized", true},
                                                  {"count", count},
                                                  {"type", "VEC4"}});
  }
  return attributes;
}

std::size_t add_indices(Writer& writer, const Surface& surface) {
  const std::size_t offset = writer.binary.size();
  // 65535 restarts a primitive and may not be an index
  const bool is_short = surface.vertices.size() < 65535;
  for (const std::uint32_t index : surface.indices) writer.put(index, is_short ? 2 : 4);
  const std::size_t view = add_view(writer, offset, kElementArrayBuffer, std::nullopt);
  return add_accessor(writer, {{"bufferView", view},
                               {"componentType", is_short ? kUnsignedShort : kUnsignedInt},
                               {"count", surface.indices.size()},
                               {"type", "SCALAR"}});
}

void use_extension(Writer& writer, const char* name) {
  Json& used = writer.root["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

// Materials are identified by name; two different ones of one name are refused.
std::size_t add_material(Writer& writer, const MaterialSpec& spec) {
  Json& materials = writer.root["materials"];
  Json material{{"name", spec.name}};
  const V3 base = spec.base_color;
  material["pbrMetallicRoughness"] = {{"baseColorFactor", {base.x, base.y, base.z, spec.alpha}},
                                      {"metallicFactor", spec.metallic},
                                      {"roughnessFactor", spec.roughness}};
  if (spec.alpha < 1 || spec.fading) material["alphaMode"] = "BLEND";
  if (!(spec.emissive == V3{})) material["emissiveFactor"] = components(spec.emissive);
  if (spec.emissive_strength != 1) {
    use_extension(writer, "KHR_materials_emissive_strength");
    material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = spec.emissive_strength;
  }
  if (spec.unlit) {
    use_extension(writer, "KHR_materials_unlit");
    material["extensions"]["KHR_materials_unlit"] = Json::object();
  }
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i] == material) return i;
    if (materials[i]["name"] == spec.name) {
      throw std::invalid_argument("two materials are named \"" + spec.name + "\"; give one another name");
    }
  }
  materials.push_back(material);
  return materials.size() - 1;
}

std::size_t add_mesh(Writer& writer, const NodeSpec& node) {
  Json mesh{{"name", node.name}};
  for (const Part& part : node.parts) {
    Json primitive;
    const Surface surface = on_grid(part.surface);
    primitive["attributes"] = add_attributes(writer, surface, part.material.vertex_colors);
    primitive["indices"] = add_indices(writer, surface);
    primitive["material"] = add_material(writer, part.material);
    mesh["primitives"].push_back(primitive);
  }
  writer.root["meshes"].push_back(mesh);
  return writer.root["meshes"].size() - 1;
}

void set_placement(Json& node, const Placement& placement) {
  const V3 x = placement.x, y = placement.y, z = placement.z, o = placement.origin;
  const bool turned = !(x == V3{1, 0, 0} && y == V3{0, 1, 0} && z == V3{0, 0, 1});
  if (turned) {
    node["matrix"] = {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, o.x, o.y, o.z, 1};
  } else {
    node["translation"] = components(o);
  }
}

void add_nodes(Writer& writer, const Model& model) {
  Json roots = Json::array();
  std::vector<Json> nodes;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const NodeSpec& spec = model.nodes[i];
    Json node{{"name", spec.name}};
    if (spec.placement) set_placement(node, *spec.placement);
    if (!spec.parts.empty()) node["mesh"] = add_mesh(writer, spec);
    if (!spec.extras.is_null()) node["extras"] = spec.extras;
    nodes.push_back(node);
    if (spec.parent) {
      nodes[*spec.parent]["children"].push_back(i);
    } else {
      roots.push_back(i);
    }
  }
  writer.root["scene"] = 0;
  writer.root["scenes"] = Json::array({{{"name", model.name}, {"nodes", roots}}});
  writer.root["nodes"] = nodes;
}

}  // namespace

Json mark_role() { return {{"touchafm", {{"role", "mark"}}}}; }

std::vector<std::uint8_t> to_glb(const Model& model) {
  Writer writer;
  writer.root["asset"] = {
      {"version", "2.0"}, {"generator", "TouchAFM generate-models"}, {"copyright", "the TouchAFM authors, Apache-2.0"}};
  for (const char* list : {"materials", "meshes", "accessors", "bufferViews"}) writer.root[list] = Json::array();
  add_nodes(writer, model);
  writer.root["buffers"] = Json::array({{{"byteLength", writer.binary.size()}}});

  std::string text = writer.root.dump();
  while (text.size() % 4 != 0) text += ' ';
  const std::vector<std::uint8_t> binary = std::move(writer.binary);
  writer.binary.clear();
  constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const auto text_size = static_cast<std::uint32_t>(text.size());
  const auto binary_size = static_cast<std::uint32_t>(binary.size());
  for (const std::uint32_t word : {kMagic, kVersion, 12 + 8 + text_size + 8 + binary_size, text_size, kJson})
    writer.put(word, 4);
  writer.binary.insert(writer.binary.end(), text.begin(), text.end());
  for (const std::uint32_t word : {binary_size, kBinary}) writer.put(word, 4);
  writer.binary.insert(writer.binary.end(), binary.begin(), binary.end());
  return std::move(writer.binary);
}

}  // namespace afm::generate
