// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>
#include <ostream>

#include "core/written_by.h"
#include "exhibit/models/model_view.h"
#include "scene/gltf/loading_notice.h"
#include "scene/graph/pose.h"

namespace afm::exhibit {

namespace {

constexpr std::array kRoles{"tip", "base", "surface"};

// Escapes a name from a foreign file, which must not break a line or reach a terminal as a control sequence.
std::string quoted(std::string name) {
  std::replace_if(name.begin(), name.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; }, '?');
  return '"' + name.substr(0, 80) + '"';
}

struct Counts {
  std::size_t vertices = 0, triangles = 0, lines = 0, points = 0;
  std::size_t targets = 0;
};

Counts count(const scene::Scene& scene) {
  Counts counts;
  for (const scene::Mesh& mesh : scene.meshes) {
    counts.targets += mesh.weights.size();
    for (const scene::Primitive& primitive : mesh.primitives) {
      counts.vertices += primitive.vertices.size();
      counts.triangles += primitive.topology == scene::Topology::Triangles ? primitive.indices.size() / 3 : 0;
      counts.lines += primitive.topology == scene::Topology::Lines ? primitive.indices.size() / 2 : 0;
      counts.points += primitive.topology == scene::Topology::Points ? primitive.indices.size() : 0;
    }
  }
  return counts;
}

std::ptrdiff_t count_textures(const scene::PbrMaterial& material) {
  return std::count_if(material.textures.begin(), material.textures.end(),
                       [](const scene::TextureUse& use) { return use.texture.has_value(); });
}

void describe_parts(const scene::Scene& scene, std::ostream& out) {
  const Counts counts = count(scene);
  out << fmt::format(
      "geometry: {} nodes, {} meshes, {} vertices, {} triangles, {} lines, {} points, {} morph targets, {} skins\n",
      scene.nodes.size(), scene.meshes.size(), counts.vertices, counts.triangles, counts.lines, counts.points,
      counts.targets, scene.skins.size());
  for (const scene::PbrMaterial& material : scene.materials) {
    out << fmt::format("material: {}, {} textures{}{}{}\n", quoted(material.name), count_textures(material),
                       material.unlit ? ", unlit" : "", material.blended ? ", blended" : "",
                       material.alpha_cutoff ? ", mask" : "");
  }
  for (const scene::Image& image : scene.images) {
    out << fmt::format("image: {} x {} pixels\n", image.width, image.height);
  }
  for (const scene::Animation& animation : scene.animations) {
    out << fmt::format("animation: {}, {:g} s, moves {} nodes\n", quoted(animation.name), animation.length_s,
                       animation.nodes.size());
  }
  for (const scene::PunctualLight& light : scene.lights) out << fmt::format("light: {}\n", quoted(light.name));
  for (const std::string& variant : scene.variants) out << fmt::format("variant: {}\n", quoted(variant));
  for (const scene::Node& node : scene.nodes) {
    if (node.camera) out << fmt::format("camera: {}\n", quoted(camera_name(scene, node)));
  }
  for (const char* role : kRoles) {
    if (const auto node = scene::find_role(scene, role)) {
      out << fmt::format("role {}: node {}\n", role, quoted(scene.nodes[*node].name));
    }
  }
}

nlohmann::json json_of(const scene::Scene& scene) {
  const Counts counts = count(scene);
  const auto list = [] { return nlohmann::json::array(); };
  nlohmann::json json{{"nodes", scene.nodes.size()},
                      {"meshes", scene.meshes.size()},
                      {"vertices", counts.vertices},
                      {"triangles", counts.triangles},
                      {"lines", counts.lines},
                      {"points", counts.points},
                      {"morph_targets", counts.targets},
                      {"skins", scene.skins.size()},
                      {"materials", list()},
                      {"images", list()},
                      {"animations", list()},
                      {"lights", list()},
                      {"variants", scene.variants},
                      {"cameras", list()},
                      {"roles", nlohmann::json::object()}};
  for (const scene::PbrMaterial& material : scene.materials) {
    json["materials"].push_back({{"name", material.name},
                                 {"textures", count_textures(material)},
                                 {"unlit", material.unlit},
                                 {"blended", material.blended},
                                 {"mask", material.alpha_cutoff.has_value()}});
  }
  for (const scene::Image& image : scene.images) {
    json["images"].push_back({{"width_px", image.width}, {"height_px", image.height}});
  }
  for (const scene::Animation& animation : scene.animations) {
    json["animations"].push_back(
        {{"name", animation.name}, {"length_s", animation.length_s}, {"moved_nodes", animation.nodes.size()}});
  }
  for (const scene::PunctualLight& light : scene.lights) json["lights"].push_back(light.name);
  for (const scene::Node& node : scene.nodes) {
    if (node.camera) json["cameras"].push_back(camera_name(scene, node));
  }
  for (const char* role : kRoles) {
    if (const auto node = scene::find_role(scene, role)) json["roles"][role] = scene.nodes[*node].name;
  }
  return json;
}

}  // namespace

core::Result<void> describe_model(const std::string& file, DescriptionForm form, std::ostream& out) {
  scene::GltfWarnings notes;
  const auto scene = [&] {
    const scene::LoadingNotice notice(file);
    return scene::load_gltf(file, &notes);
  }();
  if (!scene) return tl::unexpected(scene.error());
  if (form == DescriptionForm::Json) {
    nlohmann::json json = json_of(*scene);
    core::name_software(json);
    json["file"] = file;
    json["generator"] = notes.generator;
    json["understood"] = notes.extensions;
    json["ignored"] = notes.ignored;
    json["corrected"] = notes.corrected;
    json["missing"] = notes.missing;
    json["nothing_shown"] = notes.empty;
    out << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    return {};
  }
  out << fmt::format("file: {}\n", file);
  if (!notes.generator.empty()) out << fmt::format("written by: {}\n", quoted(notes.generator));
  describe_parts(*scene, out);
  for (const std::string& extension : notes.extensions) out << fmt::format("understood: {}\n", quoted(extension));
  for (const std::string& ignored : notes.ignored) out << fmt::format("ignored: {}\n", ignored);
  for (const std::string& corrected : notes.corrected) out << fmt::format("corrected: {}\n", corrected);
  for (const std::string& missing : notes.missing) out << fmt::format("missing: {}\n", missing);
  if (!notes.empty.empty()) out << fmt::format("nothing is shown: {}\n", notes.empty);
  return {};
}

}  // namespace afm::exhibit
