// SPDX-License-Identifier: Apache-2.0
#include "app/wall_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "core/check.h"
#include "physics/contact.h"
#include "scene/gltf_loader.h"

namespace afm::app {

namespace {

// The layout, in fractions of the paper wall's metre: one unit is the wall's height / 2.286. The origin is the contact
// point; x right, y up, z out of the wall towards the viewer.
constexpr double kReferenceWallHeightM = 2.286;
constexpr double kStrokeHeight = kReferenceWallHeightM / 3.0;  // what the current material's stroke fills
constexpr double kSampleTiltRad = 0.26;                        // towards the viewer, so that terraces are seen
constexpr double kLeverAzimuthRad = 0.42;                      // the lever comes from behind, a little from the left
constexpr double kLeverDrawnLength = 1.35;
constexpr double kTipDrawnLength = 0.21;
constexpr double kStageDrawnDiameter = 1.9;
constexpr glm::dvec3 kLaser(-0.56, 0.80, -0.55);
constexpr glm::dvec3 kPhotodiode(0.56, 0.66, -0.30);
constexpr double kPhotodiodeHalfSize = 0.0875;
constexpr double kSpotReach = 0.8;  // of the half size, at the deflection of the pull-off
constexpr double kBeamRadius = 0.007;
constexpr double kSpotRadius = 0.022;
constexpr glm::dvec3 kWandGrip(0.40, -0.62, 0.75);
constexpr double kShelfY = -1.13;
constexpr double kShelfZ = 0.22;
constexpr double kSwatchSpacing = 0.46;
constexpr double kSwatchRadius = 0.16;
constexpr double kPanelMargin = 0.03;

// The stroke of a cycle in units of Z_joc: from the deepest push below zero to the highest lift.
constexpr double kStrokeOfZjoc = 0.30 + 1.32;

using glm::dmat4;
using glm::dvec3;

dmat4 frame_matrix(const dvec3& x, const dvec3& y, const dvec3& z, const dvec3& origin) {
  return {glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), glm::dvec4(origin, 1.0)};
}

// A frame at `origin` whose z axis looks along `direction`, upright as far as possible.
dmat4 looking_along(const dvec3& origin, const dvec3& direction) {
  const dvec3 z = glm::normalize(direction);
  const dvec3 reference = std::abs(z.y) < 0.99 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 x = glm::normalize(glm::cross(reference, z));
  return frame_matrix(x, glm::cross(z, x), z, origin);
}

// A unit cylinder along +z, stretched between two points.
dmat4 stretched(const dvec3& from, const dvec3& to, double radius) {
  const double length = std::max(1e-6, glm::distance(from, to));
  return glm::scale(looking_along(from, to - from), dvec3(radius, radius, length));
}

core::Error missing_node(const std::string& name) {
  return {
      core::ErrorCategory::BadInputFile,
      fmt::format("models: there is no node \"{}\"; restore assets/models, or run the target generate_models", name)};
}

// The node's transform relative to one of its ancestors.
dmat4 ancestor_from_node(const scene::Scene& scene, scene::NodeIndex ancestor, scene::NodeIndex node) {
  dmat4 result(1.0);
  for (std::optional<scene::NodeIndex> n = node; n && *n != ancestor; n = scene.nodes[*n].parent) {
    result = scene.nodes[*n].parent_from_node * result;
  }
  return result;
}

bool is_below(const scene::Scene& scene, scene::NodeIndex ancestor, scene::NodeIndex node) {
  for (std::optional<scene::NodeIndex> n = node; n; n = scene.nodes[*n].parent) {
    if (*n == ancestor) return true;
  }
  return false;
}

struct Bounds {
  dvec3 low{std::numeric_limits<double>::infinity()};
  dvec3 high{-std::numeric_limits<double>::infinity()};
};

// Of everything below `root`, in root's frame.
Bounds bounds_below(const scene::Scene& scene, scene::NodeIndex root) {
  Bounds bounds;
  for (scene::NodeIndex i = 0; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].mesh || !is_below(scene, root, i)) continue;
    const dmat4 root_from_node = ancestor_from_node(scene, root, i);
    for (const scene::Primitive& primitive : scene.meshes[*scene.nodes[i].mesh].primitives) {
      for (const scene::Vertex& vertex : primitive.vertices) {
        const dvec3 p(root_from_node * glm::dvec4(dvec3(vertex.position), 1.0));
        bounds.low = glm::min(bounds.low, p);
        bounds.high = glm::max(bounds.high, p);
      }
    }
  }
  return bounds;
}

// Loads the models one by one into one graph, and remembers the first error, so that the composition reads straight.
class Builder {
 public:
  Builder(std::string models_dir, scene::Scene& scene) : models_dir_(std::move(models_dir)), scene_(scene) {}

  scene::NodeIndex frame(std::string_view name, std::optional<scene::NodeIndex> parent, const dmat4& parent_from_name) {
    return scene::append(scene_, {}, name, parent, parent_from_name);
  }

  scene::NodeIndex model(const std::string& file, std::string_view name, scene::NodeIndex parent) {
    const auto part = scene::load_gltf(models_dir_ + "/" + file);
    if (!part) {
      if (!error_) error_ = part.error();
      return frame(name, parent, dmat4(1.0));
    }
    return scene::append(scene_, *part, name, parent, dmat4(1.0));
  }

  // The same, turned so that the frame `name` has the axes of the model's node `inner`.
  scene::NodeIndex model_in_frame_of(const std::string& inner, const std::string& file, const std::string& name,
                                     scene::NodeIndex parent) {
    const scene::NodeIndex root = model(file, name, parent);
    if (!error_)
      scene_.nodes[root].parent_from_node = glm::inverse(ancestor_from_node(scene_, root, node(name + "/" + inner)));
    return root;
  }

  scene::NodeIndex node(const std::string& name) {
    if (const auto found = scene_.find_node(name)) return *found;
    if (!error_) error_ = missing_node(name);
    return 0;
  }

  const std::optional<core::Error>& error() const { return error_; }

 private:
  std::string models_dir_;
  scene::Scene& scene_;
  std::optional<core::Error> error_;
};

}  // namespace

core::Result<WallScene> WallScene::load(const std::string& assets_dir, const scene::MaterialLibrary& materials,
                                        const scene::Screen& screen, const glm::dvec3& viewer_m) {
  WallScene w;

  // the contact point: at eye height, in the middle, but never out of the wall's middle third
  const double unit = screen.height_m() / kReferenceWallHeightM;
  const dvec3 right = glm::normalize(screen.lower_right - screen.lower_left);
  const dvec3 out = screen.normal();
  const dvec3 up = glm::cross(out, right);
  const double eye_height = glm::dot(viewer_m - screen.lower_left, up);
  const double contact_height = std::clamp(eye_height, screen.height_m() / 3.0, screen.height_m() * 2.0 / 3.0);
  const dvec3 contact = screen.lower_left + 0.5 * screen.width_m() * right + contact_height * up;
  w.room_from_layout_ = frame_matrix(unit * right, unit * up, unit * out, contact);
  w.wall_width_ = screen.width_m() / unit;
  w.wall_bottom_ = -contact_height / unit;
  w.wall_top_ = w.wall_bottom_ + kReferenceWallHeightM;

  Builder build(assets_dir + "/models", w.scene_);
  w.layout_ = build.frame("layout", std::nullopt, w.room_from_layout_);
  const double c = std::cos(kSampleTiltRad), s = std::sin(kSampleTiltRad);
  w.sample_frame_ = build.frame("sample", w.layout_, frame_matrix({1, 0, 0}, {0, s, -c}, {0, c, s}, dvec3(0.0)));
  w.stage_ = build.model_in_frame_of("stage", "stage.glb", "stage", w.sample_frame_);
  w.probe_frame_ = build.frame("probe-frame", w.sample_frame_, dmat4(1.0));
  w.lever_ = build.model("probe.glb", "probe", w.probe_frame_);
  w.cantilever_ = build.node("probe/cantilever");
  w.tip_ = build.node("probe/tip");
  build.model("optics.glb", "optics", w.layout_);
  w.laser_ = build.node("optics/laser");
  w.photodiode_ = build.node("optics/photodiode");
  w.beam_in_ = build.node("optics/beam");
  w.spot_ = build.node("optics/spot");
  build.model("wand.glb", "wand", w.layout_);
  w.wand_ = build.node("wand/wand");
  w.ray_ = build.node("wand/ray");
  for (const scene::MaterialEntry& material : materials.materials) {
    const physics::ApproachRetractEvents events = physics::approach_retract_events(material.interaction);
    MaterialLook look{};
    const std::string sample = "sample-" + material.name;
    look.sample = build.model_in_frame_of("surface", sample + ".glb", sample, w.sample_frame_);
    look.surface = build.node(sample + "/surface");
    look.swatch = build.model("swatch-" + material.name + ".glb", "swatch-" + material.name, w.layout_);
    look.stroke_m = events.z_joc.si * kStrokeOfZjoc;
    look.full_deflection_m = events.f_ad.si / material.interaction.spring_constant.si;
    w.looks_.push_back(look);
    w.titles_.push_back(material.title);
  }
  if (build.error()) return tl::unexpected(*build.error());

  // the second half of the beam is a node of its own that shows the same mesh
  scene::Node beam_out = w.scene_.nodes[w.beam_in_];
  beam_out.name = "optics/beam-reflected";
  w.beam_out_ = static_cast<scene::NodeIndex>(w.scene_.nodes.size());
  w.scene_.nodes.push_back(beam_out);

  w.lever_length_ = dvec3(glm::inverse(ancestor_from_node(w.scene_, w.lever_, w.cantilever_)) *
                          ancestor_from_node(w.scene_, w.lever_, w.tip_)[3])
                        .x;
  w.tip_length_ = -bounds_below(w.scene_, w.tip_).low.z;
  return w;
}

DrawnScale WallScene::drawn_scale(std::size_t material) const {
  const double unit_m = glm::length(dvec3(room_from_layout_[0]));
  return {.sample_m_per_m = looks_[material].stroke_m / (kStrokeHeight * unit_m),
          .lever_m_per_m = lever_length_ / (kLeverDrawnLength * unit_m),
          .tip_m_per_m = tip_length_ / (kTipDrawnLength * unit_m)};
}

std::vector<input::Target> WallScene::swatch_targets() const {
  std::vector<input::Target> targets;
  const double unit_m = glm::length(dvec3(room_from_layout_[0]));
  const double first = -0.5 * kSwatchSpacing * static_cast<double>(looks_.size() - 1);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const dvec3 center(first + kSwatchSpacing * static_cast<double>(i), kShelfY + 0.13, kShelfZ);
    targets.push_back({dvec3(room_from_layout_ * glm::dvec4(center, 1.0)), kSwatchRadius * unit_m});
  }
  return targets;
}

glm::dvec3 WallScene::sample_normal() const {
  return glm::normalize(
      dvec3(room_from_layout_ * scene_.nodes[sample_frame_].parent_from_node * glm::dvec4(0, 0, 1, 0)));
}

glm::dvec3 WallScene::wand_grip_m() const { return dvec3(room_from_layout_ * glm::dvec4(kWandGrip, 1.0)); }

void WallScene::place_probe(const Pose& pose, std::vector<dmat4>& local, render::BeamBend& bend) const {
  // everything in the sample's frame, in layout units; the lever runs along `along` towards the viewer, parallel to the
  // sample
  const double per_m = pose.material ? kStrokeHeight / looks_[*pose.material].stroke_m : 0.0;
  const double lever_scale = kLeverDrawnLength / lever_length_;
  const double tip_scale = kTipDrawnLength / tip_length_;
  const dvec3 up(0.0, 0.0, 1.0);
  const dvec3 along(std::sin(kLeverAzimuthRad), -std::cos(kLeverAzimuthRad), 0.0);

  // the drawn deflection brings the apex exactly to its height although the tip turns with the lever's end slope
  const double deflection = pose.tip.deflection_m * per_m;
  double end = -deflection, angle = 0.0;
  for (int i = 0; i < 4; ++i) {
    angle = std::atan(1.5 * end / kLeverDrawnLength);
    end = -deflection - kTipDrawnLength * (1.0 - std::cos(angle));
  }
  const double base_height = pose.tip.z_m * per_m + kTipDrawnLength;

  // the chip is moved along the lever so that the apex stays over the same spot of the sample
  const dvec3 clamp = up * base_height - along * (kLeverDrawnLength + kTipDrawnLength * std::sin(angle));
  const dmat4 frame_from_lever = frame_matrix(along, glm::cross(up, along), up, clamp);

  const dmat4 probe_from_cantilever = ancestor_from_node(scene_, lever_, cantilever_);
  local[lever_] = frame_from_lever * glm::scale(dmat4(1.0), dvec3(lever_scale)) * glm::inverse(probe_from_cantilever);
  bend = {.node = cantilever_,
          .length = static_cast<float>(lever_length_),
          .end_deflection = static_cast<float>(end / lever_scale)};

  // the tip hangs below the lever's end and turns with it
  const dvec3 end_point(kLeverDrawnLength, 0.0, end);
  const dvec3 tip_z(-std::sin(angle), 0.0, std::cos(angle));
  const dmat4 lever_from_tip = frame_matrix({std::cos(angle), 0.0, std::sin(angle)}, {0.0, 1.0, 0.0}, tip_z, end_point);
  const dmat4 frame_from_tip = frame_from_lever * glm::scale(lever_from_tip, dvec3(tip_scale));
  const dmat4 frame_from_parent = local[lever_] * ancestor_from_node(scene_, lever_, *scene_.nodes[tip_].parent);
  local[tip_] = glm::inverse(frame_from_parent) * frame_from_tip;
}

void WallScene::place_optics(const Pose& pose, const glm::dvec3& lever_end, std::vector<dmat4>& local) const {
  const auto set = [&](scene::NodeIndex node, const dmat4& layout_from_node) {
    const dmat4 layout_from_parent = ancestor_from_node(scene_, layout_, *scene_.nodes[node].parent);
    local[node] = glm::inverse(layout_from_parent) * layout_from_node;
  };
  // the diode looks half way between the lever and the viewer, so that its four quadrants and the spot are seen
  const dvec3 to_lever = glm::normalize(dvec3(0.0, 0.2, 0.0) - kPhotodiode);
  const dmat4 photodiode = looking_along(kPhotodiode, to_lever + dvec3(0.0, 0.0, 1.6));
  const double full = pose.material ? looks_[*pose.material].full_deflection_m : 1.0;
  const double reach = std::clamp(pose.tip.deflection_m / full, -1.0, 1.0) * kSpotReach * kPhotodiodeHalfSize;
  const dmat4 spot = photodiode * glm::translate(dmat4(1.0), dvec3(0.0, reach, 0.012));

  set(laser_, looking_along(kLaser, lever_end - kLaser));
  set(photodiode_, photodiode);
  set(spot_, glm::scale(spot, dvec3(kSpotRadius)));
  set(beam_in_, stretched(kLaser, lever_end, kBeamRadius));
  set(beam_out_, stretched(lever_end, dvec3(spot[3]), kBeamRadius));
}

std::vector<dmat4> WallScene::local_transforms(const Pose& pose, render::BeamBend& bend) const {
  std::vector<dmat4> local;
  local.reserve(scene_.nodes.size());
  for (const scene::Node& node : scene_.nodes) local.push_back(node.parent_from_node);

  place_probe(pose, local, bend);

  // the sample at its true proportions, the stage below it
  if (pose.material) {
    const MaterialLook& look = looks_[*pose.material];
    const double scale = kStrokeHeight / look.stroke_m;
    local[look.sample] = glm::scale(dmat4(1.0), dvec3(scale)) * local[look.sample];
  }
  const Bounds stage = bounds_below(scene_, scene_.find_node("stage/stage").value());
  const double stage_scale = kStageDrawnDiameter / (stage.high.x - stage.low.x);
  const double thickness = pose.material ? -bounds_below(scene_, looks_[*pose.material].surface).low.z * kStrokeHeight /
                                               looks_[*pose.material].stroke_m
                                         : 0.0;
  local[stage_] =
      glm::scale(glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -thickness)), dvec3(stage_scale)) * local[stage_];

  const dvec3 lever_end_in_frame(dvec3(
      0.0, 0.0,
      (pose.tip.z_m - pose.tip.deflection_m) * (pose.material ? kStrokeHeight / looks_[*pose.material].stroke_m : 0.0) +
          kTipDrawnLength + 0.01));
  const dvec3 lever_end(scene_.nodes[sample_frame_].parent_from_node * glm::dvec4(lever_end_in_frame, 1.0));
  place_optics(pose, lever_end, local);

  const std::vector<input::Target> targets = swatch_targets();
  const double first = -0.5 * kSwatchSpacing * static_cast<double>(looks_.size() - 1);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    local[looks_[i].swatch] =
        glm::translate(dmat4(1.0), dvec3(first + kSwatchSpacing * static_cast<double>(i), kShelfY, kShelfZ));
  }

  if (pose.wand) {
    const dmat4 layout_from_room = glm::inverse(room_from_layout_);
    const dvec3 grip(layout_from_room * glm::dvec4(pose.wand->position_m, 1.0));
    const input::Ray ray = input::ray_of(*pose.wand);
    const dvec3 direction(layout_from_room * glm::dvec4(ray.direction, 0.0));
    const double reach = pose.hovered ? glm::distance(targets[*pose.hovered].center_m, ray.origin_m) /
                                                glm::length(dvec3(room_from_layout_[0])) -
                                            0.5 * kSwatchRadius
                                      : 1.2;
    local[wand_] = looking_along(grip, -direction);
    local[ray_] = stretched(grip, grip + glm::normalize(direction) * reach, 0.6 * kBeamRadius);
  }
  return local;
}

std::vector<dmat4> WallScene::compose(const std::vector<dmat4>& local) const {
  std::vector<dmat4> room(local.size());
  for (std::size_t i = 0; i < local.size(); ++i) {
    const auto parent = scene_.nodes[i].parent;
    room[i] = parent ? room[*parent] * local[i] : local[i];
  }
  return room;
}

void WallScene::place(const Pose& pose, scene::SceneTransforms& transforms) const {
  render::BeamBend bend;
  const std::vector<dmat4> room = compose(local_transforms(pose, bend));
  AFM_CHECK(room.size() <= scene::kMaxNodes);
  transforms.count = static_cast<std::uint32_t>(room.size());
  for (std::size_t i = 0; i < room.size(); ++i) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        transforms.room_from_node[i][static_cast<std::size_t>(4 * column + row)] = room[i][column][row];
      }
    }
  }
}

render::PanelPlacement WallScene::panel(double left, double bottom, double width, double height) const {
  const auto vector = [&](const dvec3& v) { return dvec3(room_from_layout_ * glm::dvec4(v, 0.0)); };
  return {.lower_left_m = dvec3(room_from_layout_ * glm::dvec4(left, bottom, 0.0, 1.0)),
          .right_m = vector({width, 0.0, 0.0}),
          .up_m = vector({0.0, height, 0.0})};
}

render::PanelPlacement WallScene::wide_panel() const { return panel(-0.85, -0.62, 1.7, 1.36); }

void WallScene::place(const Pose& pose, render::FrameState& frame) const {
  render::BeamBend bend;
  frame.room_from_node = compose(local_transforms(pose, bend));
  frame.bends = {bend};

  std::vector<scene::NodeIndex> hidden;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (pose.material != i) hidden.push_back(looks_[i].sample);
  }
  if (!pose.wand) hidden.insert(hidden.end(), {wand_, ray_});
  frame.visible.assign(scene_.nodes.size(), 1);
  frame.highlighted.clear();
  for (scene::NodeIndex i = 0; i < scene_.nodes.size(); ++i) {
    for (const scene::NodeIndex root : hidden) {
      if (is_below(scene_, root, i)) frame.visible[i] = 0;
    }
    if (pose.hovered && is_below(scene_, looks_[*pose.hovered].swatch, i)) frame.highlighted.push_back(i);
  }

  const double half = 0.5 * wall_width_;
  const double side_width = half - 0.72;
  frame.force_placement = panel(-half + kPanelMargin, -0.42, side_width, 0.95);
  frame.data_placement = panel(half - kPanelMargin - side_width, -0.42, side_width, 0.95);
  frame.banner_placement = panel(-half + kPanelMargin, wall_top_ - 0.30, wall_width_ - 2.0 * kPanelMargin, 0.27);

  frame.labels.clear();
  const double first = -0.5 * kSwatchSpacing * static_cast<double>(looks_.size() - 1);
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const double x = first + kSwatchSpacing * static_cast<double>(i);
    render::PanelPlacement placement = panel(x - 0.2, kShelfY - 0.10, 0.40, 0.10);
    placement.lower_left_m += dvec3(room_from_layout_ * glm::dvec4(0.0, 0.0, kShelfZ + 0.18, 0.0));
    frame.labels.push_back(
        {.text = titles_[i], .highlighted = pose.hovered == i || pose.material == i, .placement = placement});
  }

  const double unit_m = glm::length(dvec3(room_from_layout_[0]));
  frame.key_light.direction_to_light =
      glm::vec3(glm::dmat3(room_from_layout_) * glm::normalize(dvec3(-0.55, 0.75, 0.6)));
  frame.key_light.shadow_center_m = glm::vec3(dvec3(room_from_layout_ * glm::dvec4(0.0, 0.0, -0.35, 1.0)));
  frame.key_light.shadow_radius_m = static_cast<float>(1.7 * unit_m);
}

}  // namespace afm::app
