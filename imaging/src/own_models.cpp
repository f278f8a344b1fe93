// SPDX-License-Identifier: Apache-2.0
#include "imaging/own_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <system_error>
#include <utility>

#include "core/file_kind.h"
#include "core/log.h"
#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "curves/image_file.h"
#include "curves/unread_kinds.h"
#include "physics/quantity_text.h"
#include "scene/gltf/not_gltf.h"
#include "scene/gltf/noted_model.h"
#include "scene/graph/pose.h"
#include "scene/graph/subtree.h"

namespace afm::imaging {

namespace {

using glm::dmat4;
using glm::dvec3;

// Width to which a wider sample is scaled, because it cannot be shown in true size.
constexpr double kWidestSampleM = 1e-6;
constexpr double kFittedSampleM = 60e-9;
constexpr double kNarrowestSampleM = 100e-12;

core::Error missing(const std::string& file, std::string_view what) {
  return {core::ErrorCategory::BadInputFile,
          fmt::format("cannot use the model '{}': {} (docs/gltf.md, Roles)", file, what)};
}

void transform(scene::Primitive& primitive, const dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const double mirrored = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
  const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
  for (scene::Vertex& vertex : primitive.vertices) {
    vertex.position = glm::vec3(dvec3(matrix * glm::dvec4(dvec3(vertex.position), 1.0)));
    const dvec3 normal = mirrored * cofactor * dvec3(vertex.normal);
    const double length = glm::length(normal);
    if (length > 0.0) vertex.normal = glm::vec3(normal / length);
  }
  for (glm::vec4& tangent : primitive.tangents) {
    tangent = glm::vec4(glm::vec3(linear * dvec3(tangent)), static_cast<float>(mirrored) * tangent.w);
  }
  for (std::size_t i = 0;
       mirrored < 0.0 && primitive.topology == scene::Topology::Triangles && i + 2 < primitive.indices.size(); i += 3) {
    std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
  }
}

// All meshes of the nodes that `wanted` accepts, as one mesh in a frame.
template <class Wanted>
scene::Mesh merged(const scene::Scene& scene, const dmat4& frame_from_scene, Wanted wanted) {
  const std::vector<dmat4> scene_from_node = scene::scene_from_nodes(scene);
  scene::Mesh mesh;
  for (scene::NodeIndex i = 0; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].mesh || !wanted(i)) continue;
    for (const scene::Primitive& primitive : scene.meshes[*scene.nodes[i].mesh].primitives) {
      transform(mesh.primitives.emplace_back(primitive), frame_from_scene * scene_from_node[i]);
    }
  }
  return mesh;
}

// The materials and textures of a model without its nodes and meshes.
scene::Scene without_shape(const scene::Scene& scene) {
  scene::Scene bare;
  bare.materials = scene.materials;
  bare.textures = scene.textures;
  bare.images = scene.images;
  bare.variants = scene.variants;
  return bare;
}

core::Result<scene::Scene> load(const std::string& file) {
  auto loaded = scene::load_noted_model(file);
  if (loaded && !loaded->animations.empty()) {
    core::log_line(fmt::format("'{}' is shown at rest: the wall does not play the animations of a model", file));
  }
  return loaded;
}

// Area of the triangles as seen along each axis: of all, and of those that face along it less those that face back.
struct ProjectedAreas {
  dvec3 all{0.0}, net{0.0};
};
ProjectedAreas projected_areas(const scene::Mesh& mesh) {
  ProjectedAreas areas;
  for (const scene::Primitive& primitive : mesh.primitives) {
    if (primitive.topology != scene::Topology::Triangles) continue;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const auto corner = [&](std::size_t of) { return dvec3(primitive.vertices[primitive.indices[i + of]].position); };
      const dvec3 area = 0.5 * glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      areas.all += glm::abs(area);
      areas.net += area;
    }
  }
  return areas;
}

// Empty unless the surface is on edge under the tip, as that of an exporter whose up is +y: the tip would meet
// nothing. A block ten times as high as wide does so, too.
std::string doubt_of_normal(const scene::Mesh& mesh) {
  constexpr double kLeastShare = 0.1, kMostly = 0.5;
  const auto [areas, net] = projected_areas(mesh);
  if (areas.z >= kLeastShare * std::max(areas.x, areas.y)) return "";
  // heights over x and y face up, and their slopes to both sides
  const int faced = areas.y > areas.x ? 1 : 0;
  if (std::abs(net.z) >= kMostly * areas.z && std::abs(net[faced]) < kMostly * areas[faced]) {
    return "its relief is more than ten times as high as it is wide, so that the tip meets only walls: are its heights "
           "in another unit than its sides?";
  }
  return fmt::format(
      "its surface is on edge under the tip: +z of the node for the role surface is the outward normal, but the "
      "surface faces along its {}; turn this node, without the mesh, by {} degrees about {}",
      areas.y > areas.x ? "y" : "x", areas.y > areas.x ? -90 : 90, areas.y > areas.x ? "x" : "y");
}

core::Result<scene::Scene> load_model_of_sample(const std::string& file) {
  auto loaded = load(file);
  if (!loaded) return loaded;
  const scene::Scene model = scene::posed(std::move(*loaded), std::nullopt);
  const auto surface = scene::find_role(model, "surface");
  if (!surface) return tl::unexpected(missing(file, "a sample needs a node for the role surface"));
  const dmat4 surface_from_scene = glm::inverse(scene::scene_from_nodes(model)[*surface]);
  const auto all = [](scene::NodeIndex) { return true; };

  scene::Scene sample = without_shape(model);
  sample.nodes.push_back({"surface", std::nullopt, 0U, dmat4(1.0)});
  sample.meshes.push_back(merged(model, surface_from_scene, all));
  const scene::Bounds bounds = bounds_below(sample, 0);
  const double width = std::max(bounds.high.x - bounds.low.x, bounds.high.y - bounds.low.y);
  if (!std::isnormal(width)) return tl::unexpected(missing(file, "its surface has no extent along x and y"));
  if (width < kNarrowestSampleM) {
    return tl::unexpected(
        missing(file, fmt::format("its surface is {} wide, less than an atom: one unit of a sample is one metre",
                                  physics::format_quantity(physics::Length(width), physics::kLengthUnits, 3))));
  }
  const double rounding = 1e-3 * width;
  const auto is_beside = [rounding](double low, double high) { return low > rounding || high < -rounding; };
  if (is_beside(bounds.low.x, bounds.high.x) || is_beside(bounds.low.y, bounds.high.y)) {
    return tl::unexpected(missing(
        file,
        "its node for the role surface, where the tip comes down, lies beside the sample: put it on the surface"));
  }
  if (bounds.low.z > width || bounds.high.z < -width) {
    const double distance = std::min(std::abs(bounds.low.z), std::abs(bounds.high.z));
    return tl::unexpected(
        missing(file, fmt::format("its node for the role surface lies {} {} the sample: put it on the surface",
                                  physics::format_quantity(physics::Length(distance), physics::kLengthUnits, 3),
                                  bounds.low.z > 0.0 ? "below" : "above")));
  }
  if (const std::string doubt = doubt_of_normal(sample.meshes[0]); !doubt.empty()) {
    return tl::unexpected(missing(file, doubt));
  }
  if (width > kWidestSampleM) {
    for (scene::Primitive& primitive : sample.meshes[0].primitives) {
      transform(primitive, glm::scale(dmat4(1.0), dvec3(kFittedSampleM / width)));
    }
  }
  return sample;
}

// Returns whether an existing file begins neither as binary glTF nor as JSON.
bool is_no_model(const std::string& path) {
  std::error_code missing;
  if (!std::filesystem::is_regular_file(path, missing)) return false;
  std::ifstream file(path, std::ios::binary);
  char first = '\0';
  return file && (!(file >> first) || (first != '{' && first != 'g'));
}

// Reason why a file is neither a model nor an image, as far as its beginning shows, and what to do.
std::string refusal_of_other(const std::string& file) {
  std::string neither =
      fmt::format("it is neither a glTF model nor an image that can be read ({}); export it in one of these formats",
                  curves::kImageFiles);
  const auto beginning = core::read_beginning(file, core::kFileKindBytes);
  if (!beginning) return neither;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (const auto model = core::file_kind(*beginning, size); model && model->role == core::FileRole::Model)
    return scene::not_gltf(*model);
  std::string kind = curves::unread_kind_of(*beginning, size);
  if (kind.empty() && curves::is_curve_file(file)) kind = "a curve, which has no surface";
  return kind.empty() ? neither : fmt::format("it is {}; {}", kind, neither);
}

tl::unexpected<core::Error> unusable_sample(const std::string& file, const std::string& why) {
  return core::failure(core::ErrorCategory::BadInputFile, fmt::format("cannot use the sample '{}': {}", file, why));
}

}  // namespace

core::Result<scene::Scene> load_own_probe(const std::string& file) {
  auto loaded = load(file);
  if (!loaded) return loaded;
  const scene::Scene model = scene::posed(std::move(*loaded), std::nullopt);
  const auto base = scene::find_role(model, "base"), tip = scene::find_role(model, "tip");
  if (!base || !tip) return tl::unexpected(missing(file, "a probe needs a node for the role base and one for tip"));
  const std::vector<dmat4> scene_from_node = scene::scene_from_nodes(model);
  const dmat4 base_from_scene = glm::inverse(scene_from_node[*base]),
              tip_from_scene = glm::inverse(scene_from_node[*tip]);

  scene::Scene probe = without_shape(model);
  const dmat4 base_from_tip = base_from_scene * scene_from_node[*tip];
  probe.nodes.push_back({"cantilever", std::nullopt, 0U, dmat4(1.0)});
  probe.nodes.push_back({"tip", 0U, 1U, base_from_tip});
  const auto in_tip = [&](scene::NodeIndex node) { return is_below(model, *tip, node); };
  probe.meshes.push_back(merged(model, base_from_scene, [&](scene::NodeIndex node) { return !in_tip(node); }));
  probe.meshes.push_back(merged(model, tip_from_scene, in_tip));
  if (!(base_from_tip[3].x > 0.0) || !std::isfinite(base_from_tip[3].x)) {
    return tl::unexpected(missing(file, "the tip does not lie along +x of the base"));
  }
  const double apex = bounds_below(probe, 1).low.z;
  if (!(apex < 0.0)) return tl::unexpected(missing(file, "nothing hangs below the node of the tip, along its -z"));
  probe.nodes.push_back({"apex", 1U, std::nullopt, glm::translate(dmat4(1.0), dvec3(0.0, 0.0, apex))});
  return probe;
}

core::Result<void> check_own_sample(const std::string& file) {
  const std::string kind = core::kind_of_no_file(file);
  if (kind.empty()) return {};
  return unusable_sample(
      file, fmt::format("it is {}, not a file; name a glTF model or an image ({})", kind, curves::kImageFiles));
}

core::Result<scene::Scene> load_own_sample(const std::string& file) {
  if (is_no_model(file)) return unusable_sample(file, refusal_of_other(file));
  return load_model_of_sample(file);
}

}  // namespace afm::imaging
