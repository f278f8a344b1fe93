// SPDX-License-Identifier: Apache-2.0
#include "app/bench/render_subjects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "core/check.h"
#include "core/enumerators.h"
#include "curves/sample_model.h"
#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/frame/frame_builder.h"
#include "exhibit/frame/wall_pictures.h"
#include "exhibit/state/cycle_curve.h"
#include "exhibit/words/guidance.h"
#include "scene/gltf/gltf_loader.h"

namespace afm::app {

namespace {

constexpr int kGrowthFrames = 4;  // number of frames, each of which holds the places of all nodes

// ---- the wall ----

constexpr std::size_t kFeltMaterial = 1;
constexpr double kTopOfRelease = 1.3, kBottomOfRelease = -0.3;  // in units of Z_joc
constexpr int kTicksPerFrame = 40;
constexpr double kHeadSway_m = 0.03;

double height_at(double turn, double release_m) {
  const double down = std::abs(2.0 * turn - 1.0);  // course: 1, 0, 1
  return release_m * (kBottomOfRelease + (kTopOfRelease - kBottomOfRelease) * down);
}

// ---- separate subjects ----

struct Box {
  glm::dvec3 low{1e300};
  glm::dvec3 high{-1e300};
};

std::vector<glm::dmat4> room_from_nodes(const scene::Scene& scene) {
  std::vector<glm::dmat4> room;
  room.reserve(scene.nodes.size());
  for (const scene::Node& node : scene.nodes) {
    room.push_back(node.parent ? room[*node.parent] * node.parent_from_node : node.parent_from_node);
  }
  return room;
}

Box box_of(const scene::Scene& scene, const std::vector<glm::dmat4>& room) {
  Box box;
  for (std::size_t i = 0; i < room.size(); ++i) {
    if (!scene.nodes[i].mesh) continue;
    for (const scene::Primitive& primitive : scene.meshes[*scene.nodes[i].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        const glm::dvec3 place(room[i] * glm::dvec4(glm::dvec3(vertex.position), 1.0));
        box.low = glm::min(box.low, place);
        box.high = glm::max(box.high, place);
      }
    }
  }
  return box;
}

constexpr double kFieldOfViewRad = glm::pi<double>() / 6.0;
constexpr double kSwayRad = glm::pi<double>() / 90.0;
constexpr double kSeparation = 0.03;
const glm::dvec3 kFrom(0.3, 0.6, 1.0);

core::Result<std::array<scene::EyeView, 2>> eyes_around(const Box& box, double yaw_rad, double aspect) {
  const glm::dvec3 center = 0.5 * (box.low + box.high);
  const double radius = 0.5 * glm::length(box.high - box.low);
  const double distance = radius / std::sin(0.5 * kFieldOfViewRad);
  const glm::dmat3 turned(glm::rotate(glm::dmat4(1.0), yaw_rad, glm::dvec3(0, 1, 0)));
  const glm::dvec3 out = turned * glm::normalize(kFrom);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), out));
  const glm::dvec3 up = glm::cross(out, right);
  const double half_height = distance * std::tan(0.5 * kFieldOfViewRad);
  const glm::dvec3 lower_left = center - half_height * (up + aspect * right);
  const scene::Screen screen{.name = "subject",
                             .lower_left = lower_left,
                             .lower_right = lower_left + 2.0 * half_height * aspect * right,
                             .upper_left = lower_left + 2.0 * half_height * up};
  std::array<scene::EyeView, 2> eyes;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const double side = (i == 0 ? -0.5 : 0.5) * kSeparation * distance;
    const auto view = scene::off_axis_view(screen, center + distance * out + side * right,
                                           scene::DepthConvention::VulkanReversedInfinite, 0.02 * distance, 0.0);
    if (!view) return tl::unexpected(view.error());
    eyes[i] = *view;
  }
  return eyes;
}

core::Result<RenderSubject> standing_alone(std::string name, scene::Scene scene, glm::uvec2 eye_px,
                                           int frames = kSubjectFrames) {
  const std::vector<glm::dmat4> room = room_from_nodes(scene);
  const Box box = box_of(scene, room);
  if (!(glm::length(box.high - box.low) > 0.0)) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         name + " has nothing to draw: no mesh, or one of zero size");
  }
  RenderSubject subject{.name = std::move(name),
                        .scene = std::move(scene),
                        .drawing = {.eye_width = eye_px.x, .eye_height = eye_px.y},
                        .frames = {}};
  for (int i = 0; i < frames; ++i) {
    render::FrameState frame;
    const double yaw = kSwayRad * std::sin(2.0 * glm::pi<double>() * i / frames);
    const auto eyes = eyes_around(box, yaw, static_cast<double>(eye_px.x) / eye_px.y);
    if (!eyes) return tl::unexpected(eyes.error());
    frame.eyes = *eyes;
    frame.room_from_node = room;
    frame.key_light.shadow_center_m = glm::vec3(0.5 * (box.low + box.high));
    frame.key_light.shadow_radius_m = static_cast<float>(0.5 * glm::length(box.high - box.low));
    subject.frames.push_back(std::move(frame));
  }
  return subject;
}

void add_quad(scene::Primitive& primitive, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  primitive.indices.insert(primitive.indices.end(), {a, b, c, a, c, d});
}

double hill(double x, double z) {
  return 0.04 * std::sin(9.0 * x) * std::cos(7.0 * z) + 0.01 * std::cos(63.0 * x) * std::cos(63.0 * z);
}

scene::Primitive cube() {
  scene::Primitive primitive;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const float side = face % 2 == 0 ? -1.0F : 1.0F;
    glm::vec3 normal(0.0F), u(0.0F);
    normal[axis] = side;
    u[(axis + 1) % 3] = 1.0F;
    const glm::vec3 v = glm::cross(normal, u);
    const auto first = static_cast<std::uint32_t>(primitive.vertices.size());
    for (const glm::vec3& corner : {normal - u - v, normal + u - v, normal + u + v, normal - u + v}) {
      primitive.vertices.push_back({.position = 0.5F * corner, .normal = normal});
    }
    add_quad(primitive, first, first + 1, first + 2, first + 3);
  }
  return primitive;
}

constexpr double kBoxSide = 0.6;  // relative to the distance between two boxes

// The first `count` places of a grid in a cube.
std::vector<glm::dvec3> places_in_cube(std::uint32_t count) {
  const auto side = static_cast<std::uint32_t>(std::ceil(std::cbrt(count) - 1e-9));
  std::vector<glm::dvec3> places;
  places.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) places.emplace_back(i % side, i / side % side, i / (side * side));
  return places;
}

RenderSubject boxes(std::uint32_t count, glm::uvec2 eye_px, int frames) {
  scene::Scene scene;
  scene.materials.push_back(
      {.name = "brass", .base_color = {0.8F, 0.6F, 0.3F, 1.0F}, .metallic = 1.0F, .roughness = 0.4F});
  scene.meshes.push_back({.name = "box", .primitives = {cube()}});
  for (const glm::dvec3& place : places_in_cube(count)) {
    const glm::dmat4 parent_from_node = glm::scale(glm::translate(glm::dmat4(1.0), place), glm::dvec3(kBoxSide));
    scene.nodes.push_back({.name = "box", .parent = {}, .mesh = 0, .parent_from_node = parent_from_node});
  }
  auto subject =
      standing_alone(std::to_string(count) + (count == 1 ? " node" : " nodes"), std::move(scene), eye_px, frames);
  AFM_CHECK(subject.has_value());
  return std::move(*subject);
}

// Eyes of a viewer who sways in front of the screen like a standing person.
core::Result<std::array<scene::EyeView, 2>> eyes_of_moved_head(const exhibit::Stage& stage, double turn_rad) {
  const scene::Viewer& viewer = stage.wall.viewers.front();
  scene::HeadPose head = viewer.sweet_spot;
  head.position_m += kHeadSway_m * glm::dvec3(std::cos(turn_rad), 0.3 * std::sin(turn_rad), std::sin(turn_rad));
  return exhibit::eyes_before(stage.screen, head, viewer.ipd_m);
}

}  // namespace

core::Result<RenderSubject> wall_subject(const exhibit::Stage& stage, std::uint32_t eye_width_px, WallMotion motion) {
  std::vector<curves::SampleModel> materials;
  for (const scene::MaterialEntry& entry : stage.materials.materials) {
    auto model = curves::make_sample_model(curves::ContactSetup{entry, {}, {}});
    if (!model) return tl::unexpected(model.error());
    materials.push_back(std::move(*model));
  }
  static constexpr std::array kNames{"wall", "wall, head moving", "wall at rest"};
  static_assert(kNames.size() == core::kEnumerators<WallMotion>.size());
  RenderSubject subject{.name = kNames[static_cast<std::size_t>(motion)],
                        .scene = stage.wall_scene.scene(),
                        .drawing = stage.renderer_options(eye_width_px),
                        .eyes_move = motion == WallMotion::TipAndHead};
  const std::size_t material = std::min(kFeltMaterial, materials.size() - 1);
  const double release_m = materials[material].scaling.release_z_m();
  const double stiffness = materials[material].setup.material.contact.spring_constant.si;
  const exhibit::FrameBuilder frames(stage.wall_scene, materials, stage.eyes);
  std::vector<exhibit::CycleCurve> curves(materials.size());
  for (int i = 0; i < kSubjectFrames; ++i) {
    exhibit::Moment moment;
    for (int tick = 0; tick < kTicksPerFrame; ++tick) {
      scene::TipSample sample;
      const double z_m = height_at((i + static_cast<double>(tick) / kTicksPerFrame) / kSubjectFrames, release_m);
      const double force_n = z_m < release_m ? materials[material].tables->attached.force(physics::Length(z_m)).si : 0;
      sample.tip = {.z_m = z_m, .force_n = force_n, .deflection_m = -force_n / stiffness};
      sample.servo_state = scene::ServoState::Running;
      sample.phase = physics::Phase::Attached;
      curves[material].add(sample);
      moment.wall.tip = sample.tip;
    }
    moment.wall.material = material;
    moment.servo_state = scene::ServoState::Running;
    moment.phase = physics::Phase::Attached;
    moment.retracting = 2 * i > kSubjectFrames;
    moment.guidance = exhibit::step_text(stage.phrases(), exhibit::Hint::LetGo, {});
    moment.curves = curves;
    subject.frames.push_back(frames.build(moment));
    if (motion != WallMotion::TipAndHead) continue;
    const auto eyes = eyes_of_moved_head(stage, 2.0 * glm::pi<double>() * i / kSubjectFrames);
    if (!eyes) return tl::unexpected(eyes.error());
    subject.frames.back().eyes = *eyes;
  }
  if (motion == WallMotion::None) subject.frames.erase(subject.frames.begin(), subject.frames.end() - 1);
  return subject;
}

core::Result<RenderSubject> gltf_subject(const std::string& path, glm::uvec2 eye_px, int frames) {
  auto scene = scene::load_gltf(path);
  if (!scene) return tl::unexpected(scene.error());
  return standing_alone(path, std::move(*scene), eye_px, frames);
}

RenderSubject hills_subject(std::uint32_t quads, glm::uvec2 eye_px) {
  scene::Scene scene;
  scene.materials.push_back(
      {.name = "slate", .base_color = {0.35F, 0.4F, 0.5F, 1.0F}, .metallic = 0.0F, .roughness = 0.5F});
  scene::Primitive primitive;
  for (std::uint32_t row = 0; row <= quads; ++row) {
    for (std::uint32_t column = 0; column <= quads; ++column) {
      const double x = static_cast<double>(column) / quads - 0.5, z = static_cast<double>(row) / quads - 0.5;
      constexpr double kStep = 1e-4;
      const glm::dvec3 normal(hill(x - kStep, z) - hill(x + kStep, z), 2.0 * kStep,
                              hill(x, z - kStep) - hill(x, z + kStep));
      primitive.vertices.push_back(
          {.position = glm::vec3(glm::dvec3(x, hill(x, z), z)), .normal = glm::vec3(glm::normalize(normal))});
    }
  }
  for (std::uint32_t row = 0; row < quads; ++row) {
    for (std::uint32_t column = 0; column < quads; ++column) {
      const std::uint32_t corner = row * (quads + 1) + column, below = corner + quads + 1;
      add_quad(primitive, corner, below, below + 1, corner + 1);
    }
  }
  scene.meshes.push_back({.name = "hills", .primitives = {std::move(primitive)}});
  scene.nodes.push_back({.name = "hills", .parent = {}, .mesh = 0});
  auto subject = standing_alone(std::to_string(2 * quads * quads) + " triangles", std::move(scene), eye_px);
  AFM_CHECK(subject.has_value());
  return std::move(*subject);
}

RenderSubject boxes_subject(std::uint32_t count, glm::uvec2 eye_px) { return boxes(count, eye_px, kSubjectFrames); }

RenderSubject growing_subject(std::uint32_t count, glm::uvec2 eye_px) {
  RenderSubject subject = boxes(count, eye_px, kGrowthFrames);
  subject.things = count;
  return subject;
}

RenderSubject copies_subject(std::uint32_t count, glm::uvec2 eye_px) {
  RenderSubject subject = growing_subject(count, eye_px);
  subject.name = std::to_string(count) + " copies";
  subject.scene.nodes.assign(1, {.name = "box", .parent = {}, .mesh = 0, .most_copies = count});
  render::MeshCopies copies{.node = 0, .copies = {}};
  for (const glm::dvec3& place : places_in_cube(count)) {
    copies.copies.push_back({.place = glm::vec3(place), .scale = static_cast<float>(kBoxSide)});
  }
  for (render::FrameState& frame : subject.frames) {
    frame.room_from_node.assign(1, glm::dmat4(1.0));
    frame.copies.assign(1, copies);
  }
  return subject;
}

}  // namespace afm::app
