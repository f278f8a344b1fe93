// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scenery/instrument.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <utility>

#include "exhibit/models/model_builder.h"
#include "exhibit/models/user_models.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_marks.h"
#include "physics/beam_shape.h"
#include "scenery/swing_band.h"

namespace afm::exhibit {

using glm::dmat4;
using glm::dvec3;

namespace {

constexpr glm::vec3 kLight{0.72F, 0.80F, 0.88F};
constexpr float kGhostAlpha = 0.38F, kBandAlpha = 0.22F;

// Adds a light material, which hides nothing.
std::uint32_t add_light(scene::Scene& scene, const char* name, float alpha) {
  scene::PbrMaterial light;
  light.name = name;
  light.base_color = glm::vec4(kLight, alpha);
  light.metallic = 0.0F;
  light.blended = light.unlit = true;
  scene.materials.push_back(light);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

// Adds a node with this mesh, or without one.
scene::NodeIndex add_mark(scene::Scene& scene, const char* name, scene::NodeIndex parent,
                          std::optional<std::uint32_t> mesh) {
  scene::Node mark{.name = name, .parent = parent, .mesh = mesh};
  mark.role = "mark";
  scene.nodes.push_back(std::move(mark));
  return static_cast<scene::NodeIndex>(scene.nodes.size() - 1);
}

// Copies a node's mesh in another material; empty if it has no mesh.
std::optional<std::uint32_t> add_copy(scene::Scene& scene, scene::NodeIndex node, std::uint32_t material) {
  if (!scene.nodes[node].mesh) return std::nullopt;
  scene::Mesh mesh = scene.meshes[*scene.nodes[node].mesh];
  for (scene::Primitive& primitive : mesh.primitives) {
    primitive.material = material;
    primitive.variants.clear();
  }
  scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

// Pose of the tip, which is fixed to the end of a lever bent like this and rotates with it.
dmat4 lever_from_tip(double end, double angle) {
  const dvec3 tip_z(-std::sin(angle), 0.0, std::cos(angle));
  return frame_matrix({std::cos(angle), 0.0, std::sin(angle)}, {0.0, 1.0, 0.0}, tip_z, {kLeverDrawnLength, 0.0, end});
}

}  // namespace

Instrument::Instrument(ModelBuilder& build, scene::NodeIndex layout, scene::NodeIndex sample, const UserModels& own)
    : layout_(layout), sample_frame_(sample) {
  floor_ = build.model("room.glb", "room", layout_);
  floor_surface_ = build.node("room/floor");
  stage_ = build.model_in_frame_of("stage", "stage.glb", "stage", sample_frame_);
  body_ = build.node("stage/body");
  probe_frame_ = build.frame("probe-frame", sample_frame_, dmat4(1.0));
  lever_ = own.probe ? build.part(*own.probe, "probe", probe_frame_) : build.model("probe.glb", "probe", probe_frame_);
  cantilever_ = build.node("probe/cantilever");
  tip_ = build.node("probe/tip");
  apex_ = build.node("probe/apex");
  optics_ = build.model("optics.glb", "optics", layout_);
  laser_ = build.node("optics/laser");
  photodiode_ = build.node("optics/photodiode");
  beam_in_ = build.node("optics/beam");
  spot_ = build.node("optics/spot");
}

void Instrument::measure(scene::Scene& scene, ModelBuilder& build) {
  // the second half of the beam is a separate node with the same mesh
  scene::Node beam_out = scene.nodes[beam_in_];
  beam_out.name = "optics/beam-reflected";
  beam_out_ = static_cast<scene::NodeIndex>(scene.nodes.size());
  scene.nodes.push_back(beam_out);

  const std::uint32_t light = add_light(scene, "lever of light", kGhostAlpha);
  ghost_ = add_mark(scene, "probe-ghost", sample_frame_, add_copy(scene, cantilever_, light));
  lever_length_ =
      dvec3(glm::inverse(ancestor_from_node(scene, lever_, cantilever_)) * ancestor_from_node(scene, lever_, tip_)[3])
          .x;
  tip_length_ = -bounds_below(scene, tip_).low.z;
  std::optional<std::uint32_t> band;
  if (const auto lever = scene.nodes[cantilever_].mesh) {
    const std::uint32_t pale = add_light(scene, "swing of light", kBandAlpha);
    scene.meshes.push_back(swing_band(scene.meshes[*lever], lever_length_, pale));
    band = static_cast<std::uint32_t>(scene.meshes.size() - 1);
  }
  band_ = add_mark(scene, "probe-band", sample_frame_, band);
  const auto tip = add_copy(scene, tip_, light);
  turns_ = {add_mark(scene, "probe-turn-high", sample_frame_, tip),
            add_mark(scene, "probe-turn-low", sample_frame_, tip)};
  const scene::Bounds stage = bounds_below(scene, build.node("stage/stage"));
  stage_scale_ = kStageDrawnWidth / (stage.high.x - stage.low.x);
  stage_height_ = stage_scale_ * (stage.high.z - stage.low.z);
  stage_depth_ = stage_scale_ * stage.high.y;
  body_depth_ = stage_scale_ * bounds_below(scene, body_).high.y;
}

// Pose of the lever in the sample's frame, layout units. The lever extends towards the viewer, parallel to the sample.
Instrument::LeverPose Instrument::lever_pose(const Setting& setting) const {
  const double per_m = setting.layout_per_m;
  const dvec3 up(0.0, 0.0, 1.0);
  const dvec3 along(std::sin(kLeverAzimuthRad), -std::cos(kLeverAzimuthRad), 0.0);

  // the drawn deflection puts the apex exactly at its height even though the tip rotates with the lever's end
  LeverPose pose;
  const double deflection = (setting.tip.deflection_m + setting.strobe_m) * per_m;
  pose.end = -deflection;
  for (int i = 0; i < 4; ++i) {
    pose.angle = std::atan(physics::beam_slope(1.0) * pose.end / kLeverDrawnLength);
    pose.end = -deflection - kTipDrawnLength * (1.0 - std::cos(pose.angle));
  }
  const double base_height = setting.tip.z_m * per_m + kTipDrawnLength;

  // moves the chip along the lever to keep the apex over the same spot of the sample
  const dvec3 clamp =
      setting.below_tip + up * base_height - along * (kLeverDrawnLength + kTipDrawnLength * std::sin(pose.angle));
  pose.frame_from_lever = frame_matrix(along, glm::cross(up, along), up, clamp);
  return pose;
}

void Instrument::place_probe(const scene::Scene& scene, const Setting& setting, const WallMarks& marks,
                             std::vector<dmat4>& local, render::BeamBend& bend) const {
  const double lever_scale = kLeverDrawnLength / lever_length_;
  const double tip_scale = kTipDrawnLength / tip_length_;
  const auto [frame_from_lever, end, angle] = lever_pose(setting);

  const dmat4 probe_from_cantilever = ancestor_from_node(scene, lever_, cantilever_);
  local[lever_] = frame_from_lever * glm::scale(dmat4(1.0), dvec3(lever_scale)) * glm::inverse(probe_from_cantilever);
  bend = {.node = cantilever_,
          .length = static_cast<float>(lever_length_),
          .end_deflection = static_cast<float>(end / lever_scale)};

  const dmat4 frame_from_tip = frame_from_lever * glm::scale(lever_from_tip(end, angle), dvec3(tip_scale));
  const dmat4 frame_from_parent = local[lever_] * ancestor_from_node(scene, lever_, *scene.nodes[tip_].parent);
  local[tip_] = glm::inverse(frame_from_parent) * frame_from_tip;

  // next to the tip, because a lever that is bent up would hide the marks, and never below the sample
  const double unbent_height = frame_from_lever[3].z - setting.below_tip.z;
  const double lowest = std::max(0.0, kUnbentLowest - unbent_height);
  const auto in_frame = [&from_lever = frame_from_lever](double x, double z) {
    return dvec3(from_lever * glm::dvec4(x, kUnbentBeside, z + 0.5 * kLeverDrawnThickness, 1.0));
  };
  Setting mean = setting;
  mean.strobe_m = 0.0;
  const double held = lever_pose(mean).end;
  marks.place_force(in_frame(kLeverDrawnLength, lowest),
                    in_frame(kLeverDrawnLength, lowest > 0.0 ? std::max(held, lowest) : held), local);
  if (lowest > 0.0) {
    marks.hide_unbent(local);
  } else {
    marks.place_unbent(in_frame(0.0, 0.0), in_frame(kLeverDrawnLength + kUnbentBeyond, 0.0), local);
  }
}

void Instrument::place_ghost(const Setting& setting, std::vector<dmat4>& local, render::BeamBend& bend) const {
  const double lever_scale = kLeverDrawnLength / lever_length_;
  const LeverPose pose = lever_pose(setting);
  local[ghost_] = pose.frame_from_lever * glm::scale(dmat4(1.0), dvec3(lever_scale));
  bend = {.node = ghost_,
          .length = static_cast<float>(lever_length_),
          .end_deflection = static_cast<float>(pose.end / lever_scale)};
}

void Instrument::place_swing(const Setting& setting, double amplitude_m, std::vector<dmat4>& local,
                             render::BeamBend& bend) const {
  const double lever_scale = kLeverDrawnLength / lever_length_;
  const dmat4 frame_from_lever = lever_pose(setting).frame_from_lever;
  Setting turn = setting;
  turn.tip.deflection_m = setting.tip.deflection_m - amplitude_m;
  const LeverPose high = lever_pose(turn);
  turn.tip.deflection_m = setting.tip.deflection_m + amplitude_m;
  const LeverPose low = lever_pose(turn);

  const double half = 0.5 * (high.end - low.end), middle = 0.5 * (high.end + low.end);
  local[band_] = frame_from_lever * glm::scale(dmat4(1.0), dvec3(lever_scale, lever_scale, half));
  bend = {
      .node = band_, .length = static_cast<float>(lever_length_), .end_deflection = static_cast<float>(middle / half)};
  const dvec3 tip_scale(kTipDrawnLength / tip_length_);
  local[turns_[0]] = frame_from_lever * glm::scale(lever_from_tip(high.end, high.angle), tip_scale);
  local[turns_[1]] = frame_from_lever * glm::scale(lever_from_tip(low.end, low.angle), tip_scale);
}

void Instrument::place_optics(const scene::Scene& scene, const Setting& setting, std::vector<dmat4>& local) const {
  const auto set = [&](scene::NodeIndex node, const dmat4& layout_from_node) {
    const dmat4 layout_from_parent = ancestor_from_node(scene, layout_, *scene.nodes[node].parent);
    local[node] = glm::inverse(layout_from_parent) * layout_from_node;
  };
  // where the light hits the upper side of the lever, over the tip
  const LeverPose pose = lever_pose(setting);
  const dvec3 face(-std::sin(pose.angle), 0.0, std::cos(pose.angle));
  const dvec3 lit = dvec3(kLeverDrawnLength, 0.0, pose.end) + kLeverDrawnThickness * face;
  const dvec3 lever_end(scene.nodes[sample_frame_].parent_from_node * pose.frame_from_lever * glm::dvec4(lit, 1.0));

  // no light for a lever that is lifted out of the picture, as above particles: it would be hit from below
  constexpr double kUnseen = 1e-6;  // radius too small to be seen
  const bool dark = lever_end.y > kLaser.y;
  const double beam_radius = dark ? kUnseen : kBeamRadius;

  // the diode's direction is between lever and viewer, so that its four quadrants and the spot are visible
  const dmat4 photodiode =
      looking_along(kPhotodiode, glm::normalize(dvec3(0.0, 0.2, 0.0) - kPhotodiode) + kTowardsViewer);
  const double reach =
      std::clamp((setting.tip.deflection_m + setting.strobe_m) / setting.full_deflection_m, -1.0, 1.0) * kSpotReach *
      kPhotodiodeHalfSize;
  const dmat4 spot = photodiode * glm::translate(dmat4(1.0), dvec3(0.0, reach, 0.004));

  set(laser_, looking_along(kLaser, (dark ? dvec3(0.0) : lever_end) - kLaser));
  set(photodiode_, photodiode);
  set(spot_, glm::scale(spot, dvec3(dark ? kUnseen : kSpotRadius)));
  set(beam_in_, stretched(kLaser, lever_end, beam_radius));
  set(beam_out_, stretched(lever_end, dvec3(spot[3]), beam_radius));
}

// Places the plate below a sample, and its body below that, which ends in the floor, wherever the wand has moved them.
void Instrument::place_stage(const scene::Scene& scene, double thickness, std::vector<dmat4>& local) const {
  local[stage_] =
      glm::scale(glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -thickness)), dvec3(stage_scale_)) * local[stage_];
  const dmat4& layout_from_sample = scene.nodes[sample_frame_].parent_from_node;
  const dvec3 normal = glm::normalize(dvec3(layout_from_sample[2]));
  const dvec3 back(layout_from_sample * glm::dvec4(0.0, stage_depth_, -thickness - stage_height_, 1.0));
  const double length = std::max(back.y - floor_y_, 0.0) / normal.y;
  const double depth = std::clamp(body_front_z_ / (normal.y * body_depth_), kLeastBodyDepth, 1.0);
  local[body_] = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -stage_height_ / stage_scale_)) *
                 glm::scale(dmat4(1.0), dvec3(1.0, depth, length / stage_scale_)) * local[body_];
  local[floor_] = glm::translate(dmat4(1.0), dvec3(0.0, floor_y_, 0.0));
}

}  // namespace afm::exhibit
