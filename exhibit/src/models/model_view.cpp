// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/model_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "scene/gltf/noted_model.h"
#include "scene/graph/pose.h"

namespace afm::exhibit {

namespace {

using glm::dmat4;
using glm::dvec3;

constexpr double kWallHeightM = 2.286;  // the paper's wall
constexpr double kAutoFieldOfViewRad = 0.7;
constexpr double kAutoAzimuthRad = 0.35;  // direction from the front, slightly from the right and above
constexpr double kAutoElevationRad = 0.22;

struct Sphere {
  dvec3 center{0.0};
  double radius = 1.0;
};

// A flag per node: 1 to draw it, 0 for unit shapes that only the wall gives a length (beams, rays), unless the model
// has nothing else.
std::vector<std::uint8_t> drawn_nodes(const scene::Scene& scene) {
  std::vector<std::uint8_t> drawn;
  bool any = false;
  for (const scene::Node& node : scene.nodes) {
    drawn.push_back(node.role == "mark" ? 0 : 1);
    any = any || (node.mesh && drawn.back() != 0);
  }
  if (!any) std::fill(drawn.begin(), drawn.end(), std::uint8_t{1});
  return drawn;
}

// Sphere around the box of all drawn nodes.
Sphere bounds_of(const scene::Scene& scene, const std::vector<std::uint8_t>& drawn,
                 const std::vector<dmat4>& scene_from_node) {
  dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].mesh || drawn[i] == 0) continue;
    for (const scene::Primitive& primitive : scene.meshes[*scene.nodes[i].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        const dvec3 place(scene_from_node[i] * glm::dvec4(dvec3(vertex.position), 1.0));
        low = glm::min(low, place);
        high = glm::max(high, place);
      }
    }
  }
  Sphere sphere{0.5 * (low + high), 0.5 * glm::length(high - low)};
  if (!(sphere.radius > 0.0) || !std::isfinite(sphere.radius)) {
    sphere.radius = 1.0;
    if (!std::isfinite(glm::length(sphere.center))) sphere.center = dvec3(0.0);
  }
  return sphere;
}

double aspect_of(const ModelChoice& choice) {
  return static_cast<double>(choice.size_px.x) / static_cast<double>(choice.size_px.y);
}

// View of the model: the pose looks along -z with +y up, in the model's metres.
struct Look {
  dmat4 scene_from_camera{1.0};
  scene::Camera camera{};
  double focus_m = 1.0;  // distance of the wall's plane
};

Look automatic_look(const Sphere& bounds, double aspect) {
  const dvec3 direction(std::sin(kAutoAzimuthRad) * std::cos(kAutoElevationRad), std::sin(kAutoElevationRad),
                        std::cos(kAutoAzimuthRad) * std::cos(kAutoElevationRad));
  const double narrow = 2.0 * std::atan(std::tan(0.5 * kAutoFieldOfViewRad) * std::min(1.0, aspect));
  Look look;
  look.focus_m = bounds.radius / std::sin(0.5 * narrow);
  look.camera.yfov_rad = static_cast<float>(kAutoFieldOfViewRad);
  look.scene_from_camera =
      glm::inverse(glm::lookAt(bounds.center + look.focus_m * direction, bounds.center, dvec3(0.0, 1.0, 0.0)));
  return look;
}

core::Result<Look> chosen_look(const scene::Scene& scene, const std::vector<dmat4>& scene_from_node,
                               const Sphere& bounds, const ModelChoice& choice) {
  if (choice.camera == "auto") return automatic_look(bounds, aspect_of(choice));
  std::string names;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const scene::Node& node = scene.nodes[i];
    if (!node.camera) continue;
    const scene::Camera& camera = scene.cameras[*node.camera];
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", camera_name(scene, node));
    if (choice.camera != camera_name(scene, node)) continue;
    Look look{scene_from_node[i], camera, 1.0};

    // removes the camera's scale, which is not a zoom
    for (int axis = 0; axis < 3; ++axis) {
      const double length = glm::length(look.scene_from_camera[axis]);
      if (length > 0.0) look.scene_from_camera[axis] /= length;
    }
    const double ahead = glm::dot(bounds.center - dvec3(look.scene_from_camera[3]), -dvec3(look.scene_from_camera[2]));
    look.focus_m = std::max({ahead, 2.0 * static_cast<double>(camera.near_m), 1e-3 * bounds.radius});
    return look;
  }
  return core::failure(core::ErrorCategory::WrongUsage,
                       fmt::format("--camera: the model has no camera \"{}\"; it has {}, and there is auto",
                                   choice.camera, names.empty() ? "none" : names));
}

// Size of the wall, which shows the frustum's cross-section at the focus. The room's origin is the middle of the wall.
double metres_of_wall(const Look& look) {
  const double height_m = look.camera.perspective
                              ? 2.0 * look.focus_m * std::tan(0.5 * static_cast<double>(look.camera.yfov_rad))
                              : 2.0 * static_cast<double>(look.camera.half_size_m.y);
  return kWallHeightM / height_m;
}

core::Result<void> set_perspective_eyes(const Look& look, double scale, const ModelChoice& choice,
                                        render::FrameState& frame) {
  const double aspect = aspect_of(choice);
  const double half_height = 0.5 * kWallHeightM, half_width = half_height * aspect;
  const scene::Screen screen{.name = "model",
                             .lower_left = {-half_width, -half_height, 0.0},
                             .lower_right = {half_width, -half_height, 0.0},
                             .upper_left = {-half_width, half_height, 0.0}};
  const double distance_m = look.focus_m * scale;
  const double near_m =
      std::clamp(static_cast<double>(look.camera.near_m) * scale, 1e-3 * distance_m, 0.5 * distance_m);
  for (std::size_t i = 0; i < 2; ++i) {
    const dvec3 eye((i == 0 ? -0.5 : 0.5) * choice.eyes_apart_m, 0.0, distance_m);
    const auto view = scene::off_axis_view(screen, eye, scene::DepthConvention::VulkanReversedInfinite, near_m, 1.0);
    if (!view) return tl::unexpected(view.error());
    frame.eyes[i] = *view;
  }
  return {};
}

// Sets a parallel projection: both eyes see the same. The camera is at the depth `far` in front of its objects.
void set_parallel_eyes(const Look& look, double scale, double aspect, render::FrameState& frame) {
  const double distance_m = look.focus_m * scale;
  const double near_m = static_cast<double>(look.camera.near_m) * scale;
  const double far_m = static_cast<double>(look.camera.far_m.value_or(1e6F)) * scale;
  scene::EyeView view;
  view.eye_position_m = dvec3(0.0, 0.0, distance_m);
  view.view = glm::translate(dmat4(1.0), -view.eye_position_m);
  view.projection[0][0] = 2.0 / (kWallHeightM * aspect);
  view.projection[1][1] = -2.0 / kWallHeightM;
  view.projection[2][2] = 1.0 / (far_m - near_m);
  view.projection[3][2] = far_m / (far_m - near_m);
  frame.eyes = {view, view};
}

void place_lights(const scene::Scene& scene, double scale, render::FrameState& frame) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].light) continue;
    render::PlacedLight placed{scene.lights[*scene.nodes[i].light]};
    const dmat4& room_from_node = frame.room_from_node[i];
    const dvec3 backward(room_from_node[2]);
    const double length = glm::length(backward);
    placed.position_m = glm::vec3(dvec3(room_from_node[3]));
    placed.direction = length > 0.0 ? glm::vec3(-backward / length) : glm::vec3(0, 0, -1);

    // scaled with the model, so that the illumination stays the same
    if (placed.light.kind != scene::PunctualLight::Kind::Directional) {
      placed.light.intensity *= static_cast<float>(scale * scale);
    }
    if (placed.light.range_m) *placed.light.range_m *= static_cast<float>(scale);
    frame.lights.push_back(placed);
  }
}

}  // namespace

std::string camera_name(const scene::Scene& scene, const scene::Node& node) {
  const scene::Camera& camera = scene.cameras.at(node.camera.value());
  if (!camera.name.empty()) return camera.name;
  return node.name.empty() ? fmt::format("#{}", *node.camera) : node.name;
}

core::Result<ModelView> open_model(const ModelChoice& choice) {
  auto loaded = scene::load_noted_model(choice.file);
  if (!loaded) return tl::unexpected(loaded.error());
  ModelView view;
  view.scene =
      scene::posed(std::move(*loaded), choice.at_s ? std::optional(static_cast<float>(*choice.at_s)) : std::nullopt);
  if (!choice.variant.empty() && !scene::choose_variant(view.scene, choice.variant)) {
    return core::failure(
        core::ErrorCategory::WrongUsage,
        fmt::format("--variant: the model has no variant \"{}\"; it has {}", choice.variant,
                    view.scene.variants.empty() ? std::string("none")
                                                : fmt::format("{}", fmt::join(view.scene.variants, ", "))));
  }
  const std::vector<dmat4> scene_from_node = scene::scene_from_nodes(view.scene);
  view.frame.visible = drawn_nodes(view.scene);
  const Sphere bounds = bounds_of(view.scene, view.frame.visible, scene_from_node);
  const auto look = chosen_look(view.scene, scene_from_node, bounds, choice);
  if (!look) return tl::unexpected(look.error());

  const double scale = metres_of_wall(*look);
  const dmat4 room_from_scene = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, look->focus_m * scale)) *
                                glm::scale(dmat4(1.0), dvec3(scale)) * glm::inverse(look->scene_from_camera);
  render::FrameState& frame = view.frame;
  for (const dmat4& node : scene_from_node) frame.room_from_node.push_back(room_from_scene * node);
  if (look->camera.perspective) {
    if (auto done = set_perspective_eyes(*look, scale, choice, frame); !done) return tl::unexpected(done.error());
  } else {
    set_parallel_eyes(*look, scale, aspect_of(choice), frame);
  }
  place_lights(view.scene, scale, frame);
  if (!frame.lights.empty()) frame.key_light.radiance = glm::vec3(0.0F);
  frame.key_light.shadow_center_m = glm::vec3(dvec3(room_from_scene * glm::dvec4(bounds.center, 1.0)));
  frame.key_light.shadow_radius_m = static_cast<float>(bounds.radius * scale);
  return view;
}

}  // namespace afm::exhibit
