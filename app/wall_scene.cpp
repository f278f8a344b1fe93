// SPDX-License-Identifier: Apache-2.0
#include "app/wall_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "app/model_builder.h"
#include "core/check.h"
#include "physics/beam_shape.h"
#include "physics/contact.h"
#include "scene/height_field.h"

namespace afm::app {

namespace {

// The layout, in fractions of the paper wall's metre: one unit is the wall's height / 2.286. The origin is the contact
// point; x right, y up, z out of the wall towards the viewer.
constexpr double kReferenceWallHeightM = 2.286;
constexpr double kStrokeHeight = kReferenceWallHeightM / 3.0;  // what the current material's stroke fills
constexpr double kSampleTiltRad = 0.26;                        // towards the viewer, so that terraces are seen
constexpr double kLeverAzimuthRad = 0.42;                      // the lever comes from behind, a little from the left
constexpr double kLeverDrawnLength = 1.25;
constexpr double kTipDrawnLength = 0.19;
constexpr double kStageDrawnDiameter = 1.2;
constexpr glm::dvec3 kLaser(-0.56, 0.80, -0.55);
constexpr glm::dvec3 kPhotodiode(0.56, 0.66, -0.30);
constexpr double kPhotodiodeHalfSize = 0.0875;
constexpr double kSpotReach = 0.8;  // of the half size, at the deflection of the pull-off
constexpr double kBeamRadius = 0.007;
constexpr double kSpotRadius = 0.022;
constexpr glm::dvec3 kWandGrip(0.66, -0.24, 1.00);
constexpr double kShelfY = -0.85;
constexpr double kShelfZ = 0.62;
constexpr double kSwatchSpacing = 0.42;
constexpr std::size_t kFrontSwatches = 5;  // as many as a row of the shelf holds; the others stand behind, raised
constexpr double kBackY = -0.60;
constexpr double kBackZ = 0.52;  // before the stage
constexpr double kBackSpacing = 0.38;
constexpr double kSwatchRadius = 0.16;
constexpr std::size_t kFewSwatches = 3;
constexpr double kSlimSwatchRadius = 0.11;  // of more than a few: the ray passes over one on its way to another
constexpr glm::dvec3 kSwatchCenter(0.0, 0.13, 0.0);
constexpr double kRayGap = 0.08;  // the ray ends just before what it points at
constexpr double kFreeRayLength = 1.2;
constexpr double kLongestRay = 3.0;
constexpr glm::dvec3 kTowardsViewer(0.0, 0.0, 1.6);
constexpr double kLabelWidth = 0.27;
constexpr double kLabelHeight = 0.072;
constexpr double kLabelLift = 0.002;
constexpr double kPanelMargin = 0.03;
constexpr double kPanelInnerEdge = 0.74;
constexpr double kPanelBottom = -0.20;
constexpr double kPanelHeight = 0.92;
constexpr double kTabHeight = 0.10;
// right of the sample, which stands before the wall
constexpr double kParameterInset = 0.06;
constexpr double kTabInset = 0.18;
constexpr double kBannerHeight = 0.25;

// The stroke of a cycle in units of Z_joc: from the deepest push below zero to the highest lift.
constexpr double kStrokeOfZjoc = 0.30 + 1.40;

constexpr const char* kNeutralLook = "si3n4";

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

// Whose models stand for a material: its own, those of its look, or the plain grey ones.
std::string model_of(const std::string& assets_dir, const scene::MaterialEntry& material) {
  for (const std::string& name : {material.name, material.look}) {
    std::error_code ignored;
    if (std::filesystem::exists(assets_dir + "/models/sample-" + name + ".glb", ignored)) return name;
  }
  return kNeutralLook;
}

// A unit cylinder along +z, stretched between two points.
dmat4 stretched(const dvec3& from, const dvec3& to, double radius) {
  const double length = std::max(1e-6, glm::distance(from, to));
  return glm::scale(looking_along(from, to - from), dvec3(radius, radius, length));
}

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

  ModelBuilder build(assets_dir + "/models", w.scene_);
  w.layout_ = build.frame("layout", std::nullopt, w.room_from_layout_);
  const double c = std::cos(kSampleTiltRad), s = std::sin(kSampleTiltRad);
  w.sample_frame_ = build.frame("sample", w.layout_, frame_matrix({1, 0, 0}, {0, s, -c}, {0, c, s}, dvec3(0.0)));
  w.stage_ = build.model_in_frame_of("stage", "stage.glb", "stage", w.sample_frame_);
  w.probe_frame_ = build.frame("probe-frame", w.sample_frame_, dmat4(1.0));
  w.lever_ = build.model("probe.glb", "probe", w.probe_frame_);
  w.cantilever_ = build.node("probe/cantilever");
  w.tip_ = build.node("probe/tip");
  w.optics_ = build.model("optics.glb", "optics", w.layout_);
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
    const std::string model = model_of(assets_dir, material);
    const std::string sample = "sample-" + material.name;
    look.sample = build.model_in_frame_of("surface", "sample-" + model + ".glb", sample, w.sample_frame_);
    const scene::NodeIndex surface = build.node(sample + "/surface");
    look.height_field = build.error() ? scene::kNoHeightField : w.height_field_of(model, surface);
    const std::string swatch = "swatch-" + material.name;
    look.swatch = build.model("swatch-" + model + ".glb", swatch, w.layout_);
    look.label = build.node(swatch + "/label");
    look.stroke_m = events.z_joc.si * kStrokeOfZjoc;
    look.thickness_m = build.error() ? 0.0 : -bounds_below(w.scene_, surface).low.z;
    look.full_deflection_m = events.f_ad.si / material.interaction.spring_constant.si;
    w.looks_.push_back(look);
    const auto of_this_title = [&](const scene::MaterialEntry& other) { return other.title == material.title; };
    const bool alone = std::count_if(materials.materials.begin(), materials.materials.end(), of_this_title) == 1;
    w.titles_.push_back(alone ? material.title : material.title + ", " + material.medium);
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
  const Bounds stage = bounds_below(w.scene_, build.node("stage/stage"));
  w.stage_scale_ = kStageDrawnDiameter / (stage.high.x - stage.low.x);
  return w;
}

// Materials that share a model share its surface. More surfaces than the servo has room for are felt as planes.
std::uint32_t WallScene::height_field_of(const std::string& model, scene::NodeIndex surface) {
  const auto known = std::find(surface_models_.begin(), surface_models_.end(), model);
  if (known != surface_models_.end()) return static_cast<std::uint32_t>(known - surface_models_.begin());
  const auto field = scene::height_field_below(scene_, surface);
  if (!field || height_fields_.size() == scene::kMaxHeightFields) return scene::kNoHeightField;
  surface_models_.push_back(model);
  height_fields_.push_back(*field);
  return static_cast<std::uint32_t>(height_fields_.size() - 1);
}

double WallScene::parameter_factor(std::size_t material, const TipView& tip) const {
  return tip.z_joc_m > 0.0 ? tip.z_joc_m * kStrokeOfZjoc / looks_[material].stroke_m : 1.0;
}

DrawnScale WallScene::drawn_scale(std::size_t material, const TipView& tip) const {
  const double unit_m = glm::length(dvec3(room_from_layout_[0]));
  const double stroke_m = looks_[material].stroke_m * parameter_factor(material, tip);
  return {.sample_m_per_m = stroke_m / (kStrokeHeight * unit_m),
          .lever_m_per_m = lever_length_ / (kLeverDrawnLength * unit_m),
          .tip_m_per_m = tip_length_ / (kTipDrawnLength * unit_m)};
}

double WallScene::layout_per_m(const Pose& pose) const {
  // before a choice nothing lies on the stage, and the tip rests at its height of zero
  if (!pose.material) return 0.0;
  return kStrokeHeight / (looks_[*pose.material].stroke_m * parameter_factor(*pose.material, pose.tip));
}

glm::dvec3 WallScene::swatch_place(std::size_t i) const {
  const std::size_t front = std::min(looks_.size(), kFrontSwatches);
  const auto across = [](std::size_t place, std::size_t count, double spacing) {
    return spacing * (static_cast<double>(place) - 0.5 * static_cast<double>(count - 1));
  };
  if (i < front) return {across(i, front, kSwatchSpacing), kShelfY, kShelfZ};
  return {across(i - front, looks_.size() - front, kBackSpacing), kBackY, kBackZ};
}

std::vector<input::Target> WallScene::swatch_targets() const {
  const double radius = looks_.size() <= kFewSwatches ? kSwatchRadius : kSlimSwatchRadius;
  std::vector<input::Target> targets;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    targets.push_back({dvec3(room_from_layout_ * glm::dvec4(swatch_place(i) + kSwatchCenter, 1.0)),
                       radius * glm::length(dvec3(room_from_layout_[0]))});
  }
  return targets;
}

glm::dvec3 WallScene::sample_normal() const {
  return glm::normalize(
      dvec3(room_from_layout_ * scene_.nodes[sample_frame_].parent_from_node * glm::dvec4(0, 0, 1, 0)));
}

glm::dvec3 WallScene::sample_right() const {
  return glm::normalize(
      dvec3(room_from_layout_ * scene_.nodes[sample_frame_].parent_from_node * glm::dvec4(1, 0, 0, 0)));
}

glm::dvec3 WallScene::wand_grip_m() const { return dvec3(room_from_layout_ * glm::dvec4(kWandGrip, 1.0)); }

glm::dvec3 WallScene::below_tip(const Pose& pose) const {
  return layout_per_m(pose) * dvec3(pose.tip.xy_m, pose.tip.surface_height_m);
}

void WallScene::place_probe(const Pose& pose, std::vector<dmat4>& local, render::BeamBend& bend) const {
  // everything in the sample's frame, in layout units; the lever runs along `along` towards the viewer, parallel to the
  // sample
  const double per_m = layout_per_m(pose);
  const double lever_scale = kLeverDrawnLength / lever_length_;
  const double tip_scale = kTipDrawnLength / tip_length_;
  const dvec3 up(0.0, 0.0, 1.0);
  const dvec3 along(std::sin(kLeverAzimuthRad), -std::cos(kLeverAzimuthRad), 0.0);

  // the drawn deflection brings the apex exactly to its height although the tip turns with the lever's end slope
  const double deflection = pose.tip.deflection_m * per_m;
  double end = -deflection, angle = 0.0;
  for (int i = 0; i < 4; ++i) {
    angle = std::atan(physics::beam_slope(1.0) * end / kLeverDrawnLength);
    end = -deflection - kTipDrawnLength * (1.0 - std::cos(angle));
  }
  const dvec3 below = below_tip(pose);
  const double base_height = pose.tip.z_m * per_m + kTipDrawnLength;

  // the chip is moved along the lever so that the apex stays over its spot of the sample
  const dvec3 clamp = below + up * base_height - along * (kLeverDrawnLength + kTipDrawnLength * std::sin(angle));
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

void WallScene::place_optics(const Pose& pose, std::vector<dmat4>& local) const {
  const auto set = [&](scene::NodeIndex node, const dmat4& layout_from_node) {
    const dmat4 layout_from_parent = ancestor_from_node(scene_, layout_, *scene_.nodes[node].parent);
    local[node] = glm::inverse(layout_from_parent) * layout_from_node;
  };
  const double apex = (pose.tip.z_m - pose.tip.deflection_m) * layout_per_m(pose);
  const dvec3 above_apex = below_tip(pose) + dvec3(0.0, 0.0, apex + kTipDrawnLength + kBeamRadius);
  const dvec3 lever_end(scene_.nodes[sample_frame_].parent_from_node * glm::dvec4(above_apex, 1.0));

  // the diode looks between the lever and the viewer, so that its four quadrants and the spot are seen
  const dmat4 photodiode =
      looking_along(kPhotodiode, glm::normalize(dvec3(0.0, 0.2, 0.0) - kPhotodiode) + kTowardsViewer);
  const double full =
      pose.material ? looks_[*pose.material].full_deflection_m * parameter_factor(*pose.material, pose.tip) : 1.0;
  const double reach = std::clamp(pose.tip.deflection_m / full, -1.0, 1.0) * kSpotReach * kPhotodiodeHalfSize;
  const dmat4 spot = photodiode * glm::translate(dmat4(1.0), dvec3(0.0, reach, 0.004));

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
  place_sample(pose, local);
  place_optics(pose, local);
  if (pose.navigation != dmat4(1.0)) {
    const dmat4 navigated = glm::inverse(room_from_layout_) * pose.navigation * room_from_layout_;
    for (const scene::NodeIndex root : {sample_frame_, optics_}) local[root] = navigated * local[root];
  }
  for (std::size_t i = 0; i < looks_.size(); ++i) local[looks_[i].swatch] = glm::translate(dmat4(1.0), swatch_place(i));
  if (pose.wand) place_wand(pose, local);
  return local;
}

// The sample at its true proportions, the stage below it.
void WallScene::place_sample(const Pose& pose, std::vector<dmat4>& local) const {
  double thickness = 0.0;
  if (pose.material) {
    const MaterialLook& look = looks_[*pose.material];
    local[look.sample] = glm::scale(dmat4(1.0), dvec3(layout_per_m(pose))) * local[look.sample];
    thickness = look.thickness_m * layout_per_m(pose);
  }
  local[stage_] =
      glm::scale(glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -thickness)), dvec3(stage_scale_)) * local[stage_];
}

void WallScene::place_wand(const Pose& pose, std::vector<dmat4>& local) const {
  const dmat4 layout_from_room = glm::inverse(room_from_layout_);
  const input::Ray ray = input::ray_of(*pose.wand);
  const dvec3 grip(layout_from_room * glm::dvec4(ray.origin_m, 1.0));
  const dvec3 direction = glm::normalize(dvec3(layout_from_room * glm::dvec4(ray.direction, 0.0)));
  const double to_wall = direction.z < 0.0 ? -grip.z / direction.z : kFreeRayLength;
  const double reach = pose.hovered ? glm::distance(swatch_place(*pose.hovered) + kSwatchCenter, grip) - kRayGap
                                    : std::min(to_wall, kLongestRay);
  local[wand_] = looking_along(grip, -direction);
  local[ray_] = stretched(grip, grip + direction * reach, 0.6 * kBeamRadius);
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

double WallScene::side_width() const { return 0.5 * wall_width_ - kPanelInnerEdge - kPanelMargin; }

render::PanelPlacement WallScene::parameter_placement() const {
  return panel(kPanelInnerEdge + kParameterInset, kPanelBottom, side_width() - kParameterInset, kPanelHeight);
}

render::PanelPlacement WallScene::parameter_tab_placement() const {
  return panel(kPanelInnerEdge + kTabInset, kPanelBottom - kPanelMargin - kTabHeight, side_width() - kTabInset,
               kTabHeight);
}

void WallScene::place(const Pose& pose, render::FrameState& frame) const {
  render::BeamBend bend;
  frame.room_from_node = compose(local_transforms(pose, bend));
  frame.bends = {bend};

  std::vector<scene::NodeIndex> hidden;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (pose.material != i || pose.instrument == Instrument::Hidden) hidden.push_back(looks_[i].sample);
  }
  if (pose.instrument == Instrument::Hidden) hidden.insert(hidden.end(), {lever_, optics_});
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
  // the finale's large plot takes the room of the instrument
  const double plot_width =
      pose.instrument == Instrument::Hidden ? 2.0 * kPanelInnerEdge + side_width() - kPanelMargin : side_width();
  frame.force_placement = panel(-half + kPanelMargin, kPanelBottom, plot_width, kPanelHeight);
  frame.data_placement = panel(kPanelInnerEdge, kPanelBottom, side_width(), kPanelHeight);
  frame.banner_placement = panel(-half + kPanelMargin, wall_top_ - kBannerHeight - kPanelMargin,
                                 wall_width_ - 2.0 * kPanelMargin, kBannerHeight);

  // on the slanted face of each swatch's plinth
  frame.labels.clear();
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const dmat4& room_from_label = frame.room_from_node[looks_[i].label];
    const auto point = [&](const dvec3& p) { return dvec3(room_from_label * glm::dvec4(p, 1.0)); };
    const dvec3 lower_left = point({-0.5 * kLabelWidth, -0.5 * kLabelHeight, kLabelLift});
    frame.labels.push_back(
        {.text = titles_[i],
         .highlighted = pose.hovered == i || pose.material == i,
         .placement = {.lower_left_m = lower_left,
                       .right_m = point({0.5 * kLabelWidth, -0.5 * kLabelHeight, kLabelLift}) - lower_left,
                       .up_m = point({-0.5 * kLabelWidth, 0.5 * kLabelHeight, kLabelLift}) - lower_left}});
  }

  const double unit_m = glm::length(dvec3(room_from_layout_[0]));
  frame.key_light.direction_to_light =
      glm::vec3(glm::dmat3(room_from_layout_) * glm::normalize(dvec3(-0.55, 0.75, 0.6)));
  frame.key_light.shadow_center_m = glm::vec3(dvec3(room_from_layout_ * glm::dvec4(0.0, 0.0, -0.35, 1.0)));
  frame.key_light.shadow_radius_m = static_cast<float>(1.7 * unit_m);
}

}  // namespace afm::app
