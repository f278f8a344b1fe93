// SPDX-License-Identifier: Apache-2.0
// Places of all nodes in a given state.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "core/check.h"
#include "exhibit/models/model_builder.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_scene.h"
#include "physics/beam_shape.h"
#include "physics/quantity_text.h"

namespace afm::exhibit {

using glm::dmat4;
using glm::dvec3;

// All in the sample's frame, layout units. The lever extends towards the viewer, parallel to the sample.
WallScene::LeverPose WallScene::lever_pose(const WallState& state) const {
  const double per_m = layout_per_m(state);
  const dvec3 up(0.0, 0.0, 1.0);
  const dvec3 along(std::sin(kLeverAzimuthRad), -std::cos(kLeverAzimuthRad), 0.0);

  // the drawn deflection puts the apex exactly at its height even though the tip rotates with the lever's end
  LeverPose pose;
  const double deflection = state.tip.deflection_m * per_m;
  pose.end = -deflection;
  for (int i = 0; i < 4; ++i) {
    pose.angle = std::atan(physics::beam_slope(1.0) * pose.end / kLeverDrawnLength);
    pose.end = -deflection - kTipDrawnLength * (1.0 - std::cos(pose.angle));
  }
  const double base_height = state.tip.z_m * per_m + kTipDrawnLength;

  // moves the chip along the lever to keep the apex over the same spot of the sample
  const dvec3 clamp =
      below_tip(state) + up * base_height - along * (kLeverDrawnLength + kTipDrawnLength * std::sin(pose.angle));
  pose.frame_from_lever = frame_matrix(along, glm::cross(up, along), up, clamp);
  return pose;
}

void WallScene::place_probe(const WallState& state, std::vector<dmat4>& local, render::BeamBend& bend) const {
  const double lever_scale = kLeverDrawnLength / lever_length_;
  const double tip_scale = kTipDrawnLength / tip_length_;
  const auto [frame_from_lever, end, angle] = lever_pose(state);

  const dmat4 probe_from_cantilever = ancestor_from_node(scene_, lever_, cantilever_);
  local[lever_] = frame_from_lever * glm::scale(dmat4(1.0), dvec3(lever_scale)) * glm::inverse(probe_from_cantilever);
  bend = {.node = cantilever_,
          .length = static_cast<float>(lever_length_),
          .end_deflection = static_cast<float>(end / lever_scale)};

  // the tip is fixed to the lever's end and rotates with it
  const dvec3 end_point(kLeverDrawnLength, 0.0, end);
  const dvec3 tip_z(-std::sin(angle), 0.0, std::cos(angle));
  const dmat4 lever_from_tip = frame_matrix({std::cos(angle), 0.0, std::sin(angle)}, {0.0, 1.0, 0.0}, tip_z, end_point);
  const dmat4 frame_from_tip = frame_from_lever * glm::scale(lever_from_tip, dvec3(tip_scale));
  const dmat4 frame_from_parent = local[lever_] * ancestor_from_node(scene_, lever_, *scene_.nodes[tip_].parent);
  local[tip_] = glm::inverse(frame_from_parent) * frame_from_tip;

  // next to the tip, because a lever that is bent up would hide the marks, and never below the sample
  const double unbent_height = frame_from_lever[3].z - below_tip(state).z;
  const double lowest = std::max(0.0, kUnbentLowest - unbent_height);
  const auto in_frame = [&from_lever = frame_from_lever](double x, double z) {
    return dvec3(from_lever * glm::dvec4(x, kUnbentBeside, z + 0.5 * kLeverDrawnThickness, 1.0));
  };
  marks_.place_bend(in_frame(kLeverDrawnLength, lowest),
                    in_frame(kLeverDrawnLength, lowest > 0.0 ? std::max(end, lowest) : end), local);
  if (lowest > 0.0) {
    marks_.hide_unbent(local);
  } else {
    marks_.place_unbent(in_frame(0.0, 0.0), in_frame(kLeverDrawnLength + kUnbentBeyond, 0.0), local);
  }
}

void WallScene::place_optics(const WallState& state, std::vector<dmat4>& local) const {
  const auto set = [&](scene::NodeIndex node, const dmat4& layout_from_node) {
    const dmat4 layout_from_parent = ancestor_from_node(scene_, layout_, *scene_.nodes[node].parent);
    local[node] = glm::inverse(layout_from_parent) * layout_from_node;
  };
  // where the light hits the upper side of the lever, over the tip
  const LeverPose pose = lever_pose(state);
  const dvec3 face(-std::sin(pose.angle), 0.0, std::cos(pose.angle));
  const dvec3 lit = dvec3(kLeverDrawnLength, 0.0, pose.end) + kLeverDrawnThickness * face;
  const dvec3 lever_end(scene_.nodes[sample_frame_].parent_from_node * pose.frame_from_lever * glm::dvec4(lit, 1.0));

  // the diode's direction is between lever and viewer, so that its four quadrants and the spot are visible
  const dmat4 photodiode =
      looking_along(kPhotodiode, glm::normalize(dvec3(0.0, 0.2, 0.0) - kPhotodiode) + kTowardsViewer);
  const double full =
      state.material ? looks_[*state.material].full_deflection_m * parameter_factor(*state.material, state.release_z_m)
                     : 1.0;
  const double reach = std::clamp(state.tip.deflection_m / full, -1.0, 1.0) * kSpotReach * kPhotodiodeHalfSize;
  const dmat4 spot = photodiode * glm::translate(dmat4(1.0), dvec3(0.0, reach, 0.004));

  set(laser_, looking_along(kLaser, lever_end - kLaser));
  set(photodiode_, photodiode);
  set(spot_, glm::scale(spot, dvec3(kSpotRadius)));
  set(beam_in_, stretched(kLaser, lever_end, kBeamRadius));
  set(beam_out_, stretched(lever_end, dvec3(spot[3]), kBeamRadius));
}

std::vector<dmat4> WallScene::local_transforms(const WallState& state, render::BeamBend& bend) const {
  std::vector<dmat4> local;
  local.reserve(scene_.nodes.size());
  for (const scene::Node& node : scene_.nodes) local.push_back(node.parent_from_node);

  place_probe(state, local, bend);
  place_sample(state, local);
  place_optics(state, local);
  if (state.navigation != dmat4(1.0)) {
    const dmat4 navigated = glm::inverse(room_from_layout_) * state.navigation * room_from_layout_;
    for (const scene::NodeIndex root : {sample_frame_, optics_}) local[root] = navigated * local[root];
  }
  for (std::size_t i = 0; i < looks_.size(); ++i) local[looks_[i].swatch] = glm::translate(dmat4(1.0), swatch_place(i));
  if (state.wand) place_wand(state, local);
  if (const double m_per_unit = ruler_m_per_unit(state); m_per_unit > 0.0) {
    marks_.place_ruler(scale_bar(m_per_unit, kRulerLongest), local);
  }
  if (state.scan_line) {
    const auto over = [&](const dvec3& point) { return layout_per_m(state) * point + dvec3(0.0, 0.0, kScanLineLift); };
    marks_.place_scan_line(over(state.scan_line->front()), over(state.scan_line->back()), local);
  }
  if (state.centerpiece == Centerpiece::Analogy) analogy_.place(analogy_heights(state), local);
  if (state.centerpiece == Centerpiece::Journey) journey_.place(state.journey_orders, local);
  return local;
}

// The sample at its true proportions, with the stage below it.
void WallScene::place_sample(const WallState& state, std::vector<dmat4>& local) const {
  double thickness = 0.0;
  if (state.material) {
    const MaterialLook& look = looks_[*state.material];
    local[look.sample] = glm::scale(dmat4(1.0), dvec3(layout_per_m(state))) * local[look.sample];
    thickness = look.thickness_m * layout_per_m(state);
  }
  local[stage_] =
      glm::scale(glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -thickness)), dvec3(stage_scale_)) * local[stage_];
  place_stand(thickness, local);
}

// Upright from the floor to the plate below a sample, wherever that is; moves with them under the wand.
void WallScene::place_stand(double thickness, std::vector<dmat4>& local) const {
  const dmat4& layout_from_sample = scene_.nodes[sample_frame_].parent_from_node;
  const dvec3 top(layout_from_sample * glm::dvec4(0.0, 0.0, -thickness - stage_height_, 1.0));
  const dvec3 foot(top.x, floor_y_, top.z);
  const dmat4 stand_from_layout = glm::inverse(layout_from_sample * local[stage_]);
  const auto set = [&](scene::NodeIndex node, const dmat4& layout_from_node) {
    const dmat4 stage_from_parent = ancestor_from_node(scene_, stage_, *scene_.nodes[node].parent);
    local[node] = glm::inverse(stage_from_parent) * stand_from_layout * layout_from_node;
  };
  const double height = std::max(top.y - floor_y_, 0.0);
  const dmat4 standing = frame_matrix({1, 0, 0}, {0, 0, -1}, {0, 1, 0}, foot);
  set(post_, glm::scale(standing, dvec3(1.0, 1.0, height)));
  set(foot_, height > 0.0 ? standing : dmat4(0.0));
  local[floor_] = glm::translate(dmat4(1.0), dvec3(0.0, floor_y_, 0.0));
}

void WallScene::place_wand(const WallState& state, std::vector<dmat4>& local) const {
  const dmat4 layout_from_room = glm::inverse(room_from_layout_);
  const input::Ray ray = input::ray_of(*state.wand);
  const dvec3 grip(layout_from_room * glm::dvec4(ray.origin_m, 1.0));
  const dvec3 direction = glm::normalize(dvec3(layout_from_room * glm::dvec4(ray.direction, 0.0)));
  const double to_wall = direction.z < 0.0 ? -grip.z / direction.z : kFreeRayLength;
  const double reach = state.hovered ? glm::distance(swatch_place(*state.hovered) + kSwatchCenter, grip) - kRayGap
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

std::vector<dmat4> WallScene::node_transforms(const WallState& state) const {
  render::BeamBend bend;
  return compose(local_transforms(state, bend));
}

double WallScene::unit_m() const { return glm::length(dvec3(room_from_layout_[0])); }

std::vector<scene::NodeIndex> WallScene::hidden_roots(const WallState& state) const {
  using enum Centerpiece;
  std::vector<scene::NodeIndex> hidden;
  const auto hide = [&](const std::vector<scene::NodeIndex>& roots) {
    hidden.insert(hidden.end(), roots.begin(), roots.end());
  };
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    if (state.material != i || state.centerpiece != Instrument) hide({looks_[i].sample});
    if (state.centerpiece == Journey) hide({looks_[i].swatch});
  }
  if (state.centerpiece != Instrument) hide({lever_, optics_});
  if (state.centerpiece == Analogy || state.centerpiece == Journey) hide({stage_});
  if (state.centerpiece == Journey) hide({floor_});
  if (state.centerpiece != Analogy) hide({analogy_.frame()});
  if (state.centerpiece != Journey) hide({journey_.frame()});
  if (topography_mesh_ && (state.centerpiece != Instrument || !state.material)) hide({height_bar_});
  if (state.centerpiece != Instrument || !state.material) hide(marks_.lever_nodes());
  if (ruler_m_per_unit(state) == 0.0) hide(marks_.ruler_nodes());
  if (state.centerpiece != Instrument || !state.scan_line) hide({marks_.scan_line_node()});
  if (!state.wand || state.centerpiece == Journey) hide({wand_, ray_});
  return hidden;
}

void WallScene::update(const WallState& state, render::FrameState& frame) const {
  render::BeamBend bend;
  frame.room_from_node = compose(local_transforms(state, bend));
  frame.bends = {bend};

  const std::vector<scene::NodeIndex> hidden = hidden_roots(state);
  frame.visible.assign(scene_.nodes.size(), 1);
  frame.highlighted.clear();
  for (scene::NodeIndex i = 0; i < scene_.nodes.size(); ++i) {
    for (const scene::NodeIndex root : hidden) {
      if (is_below(scene_, root, i)) frame.visible[i] = 0;
    }
    if (state.centerpiece == Centerpiece::Journey && is_below(scene_, journey_.frame(), i)) {
      frame.visible[i] = journey_.shows(i, state.journey_orders, looks_[state.material.value_or(0)].ground) ? 1 : 0;
    }
    if (state.hovered && is_below(scene_, looks_[*state.hovered].swatch, i)) frame.highlighted.push_back(i);
  }

  place_panels(state, frame);
  frame.labels.clear();
  if (state.centerpiece != Centerpiece::Journey) place_swatch_labels(state, frame);
  if (state.centerpiece == Centerpiece::Analogy) place_analogy_labels(state, frame);
  place_marks(state, frame);
  place_height_bar(state, frame);
  place_fog(state, frame);

  const double unit_m = glm::length(dvec3(room_from_layout_[0]));
  frame.key_light.direction_to_light =
      glm::vec3(glm::dmat3(room_from_layout_) * glm::normalize(dvec3(-0.55, 0.75, 0.6)));
  frame.key_light.shadow_center_m = glm::vec3(dvec3(room_from_layout_ * glm::dvec4(0.0, 0.0, -0.35, 1.0)));
  frame.key_light.shadow_radius_m = static_cast<float>(1.7 * unit_m);
}

// On the slanted face of each swatch's base.
void WallScene::place_swatch_labels(const WallState& state, render::FrameState& frame) const {
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const dmat4& room_from_label = frame.room_from_node[looks_[i].label];
    const auto point = [&](const dvec3& p) { return dvec3(room_from_label * glm::dvec4(p, 1.0)); };
    const dvec3 lower_left = point({-0.5 * kLabelWidth, -0.5 * kLabelHeight, kLabelLift});
    frame.labels.push_back(
        {.text = titles_[i],
         .highlighted = state.hovered == i || state.material == i,
         .placement = {.lower_left_m = lower_left,
                       .right_m = point({0.5 * kLabelWidth, -0.5 * kLabelHeight, kLabelLift}) - lower_left,
                       .up_m = point({-0.5 * kLabelWidth, 0.5 * kLabelHeight, kLabelLift}) - lower_left}});
  }
}

Analogy::Heights WallScene::analogy_heights(const WallState& state) const {
  const double per_m = kAnalogyScale * layout_per_m(state);
  return {.poles = (state.tip.z_m - state.tip.deflection_m) * per_m, .deflection = state.tip.deflection_m * per_m};
}

// Next to the parts, in the wall's plane; the plate's label is on its front.
void WallScene::place_analogy_labels(const WallState& state, render::FrameState& frame) const {
  const Analogy::Heights heights = analogy_heights(state);
  const auto beside = [&](double height) {
    const double y = height * std::cos(kSampleTiltRad) - 0.5 * kAnalogyLabelHeight;
    return panel_beside(-kAnalogyLabelGap - kAnalogyLabelWidth, y, kAnalogyLabelWidth, kAnalogyLabelHeight);
  };
  frame.labels.push_back({phrases_[Phrase::AnalogySpring], false, beside(analogy_.spring_middle(heights))});
  frame.labels.push_back({phrases_[Phrase::AnalogyMagnet], false, beside(analogy_.magnet_middle(heights))});
  const dmat4& room_from_sample = frame.room_from_node[sample_frame_];
  const auto vector = [&](const dvec3& v) { return dvec3(room_from_sample * glm::dvec4(v, 0.0)); };
  const dvec3 front = kAnalogyPlateLabel - dvec3(0.5 * kAnalogyLabelWidth, 0.0, 0.5 * kAnalogyLabelHeight);
  frame.labels.push_back({phrases_[Phrase::AnalogyPlate],
                          false,
                          {.lower_left_m = dvec3(room_from_sample * glm::dvec4(front, 1.0)),
                           .right_m = vector({kAnalogyLabelWidth, 0.0, 0.0}),
                           .up_m = vector({0.0, 0.0, kAnalogyLabelHeight})}});
}

double WallScene::ruler_m_per_unit(const WallState& state) const {
  if (state.centerpiece == Centerpiece::Journey) return std::pow(10.0, -state.journey_orders);
  if (!state.material || state.centerpiece == Centerpiece::Plot) return 0.0;
  const double navigated = glm::length(dvec3(state.navigation[0])) * layout_per_m(state);
  return 1.0 / (state.centerpiece == Centerpiece::Analogy ? kAnalogyScale * navigated : navigated);
}

// The ruler's number, and the event at the contact of tip or magnet and sample.
void WallScene::place_marks(const WallState& state, render::FrameState& frame) const {
  frame.contact = {};
  const double m_per_unit = ruler_m_per_unit(state);
  if (m_per_unit == 0.0) return;
  const ScaleBar bar = scale_bar(m_per_unit, kRulerLongest);
  frame.labels.push_back({.text = bar.text,
                          .highlighted = false,
                          .placement = panel(kRulerFoot.x + kRulerTextGap, 0.5 * (bar.drawn - kRulerTextHeight),
                                             kRulerTextWidth, kRulerTextHeight)});
  if (state.centerpiece == Centerpiece::Journey) {
    if (const auto companion = journey_.companion(state.journey_orders)) place_companion_label(*companion, frame);
    return;
  }

  const auto radius_m = static_cast<float>(kShadeRadius * glm::length(dvec3(room_from_layout_[0])));
  const bool magnet = state.centerpiece == Centerpiece::Analogy;
  frame.contact = {.place_m = glm::vec3(frame.room_from_node[magnet ? analogy_.magnet() : apex_][3]),
                   .shade_radius_m = magnet ? 0.8F * radius_m : radius_m};
  if (!state.cue) return;
  const CueRing ring = cue_ring(*state.cue);
  frame.contact.ring_color = ring.color;
  frame.contact.ring_radius_m = static_cast<float>(ring.radius) * frame.contact.shade_radius_m;
}

// Above the companion, at its depth.
void WallScene::place_companion_label(const Journey::Companion& companion, render::FrameState& frame) const {
  const dmat4& room_from_journey = frame.room_from_node[journey_.frame()];
  const double unit_m = glm::length(dvec3(room_from_layout_[0]));
  const auto axis = [&](const glm::dvec4& column) { return unit_m * glm::normalize(dvec3(column)); };
  const dvec3 middle = dvec3(room_from_journey[3]) + companion.place.x * axis(room_from_journey[0]) +
                       companion.place.y * axis(room_from_journey[1]) + companion.place.z * axis(room_from_journey[2]);
  const dvec3 right(room_from_layout_ * glm::dvec4(kCompanionLabelWidth, 0.0, 0.0, 0.0));
  const dvec3 up(room_from_layout_ * glm::dvec4(0.0, kCompanionLabelHeight, 0.0, 0.0));
  frame.labels.push_back({.text = phrases_[companion.name],
                          .highlighted = false,
                          .placement = {.lower_left_m = middle - 0.5 * right, .right_m = right, .up_m = up}});
}

// As far to the right as a narrow wall with panels below leaves room for the numbers.
double WallScene::height_bar_x() const {
  return std::min(kHeightBarX, half_width_ - kPanelMargin - kHeightBarWidth - kHeightBarTextGap - kHeightBarTextWidth);
}

// The numbers at the ends of the colour scale, in metres as measured, and the sample's exaggeration.
void WallScene::place_height_bar(const WallState& state, render::FrameState& frame) const {
  if (!topography_mesh_ || state.centerpiece != Centerpiece::Instrument || !state.material) return;
  const auto length = [](double length_m) {
    std::string text = physics::format_quantity(physics::Length(length_m), physics::kLengthUnits, 3);
    if (const auto micro = text.find("um"); micro != std::string::npos) text.replace(micro, 1, "\u00b5");
    return text;
  };
  const double left = height_bar_x() + kHeightBarWidth + kHeightBarTextGap;
  const auto beside = [&](double height) {
    return panel(left, kHeightBarBottom + height - 0.5 * kHeightBarTextHeight, kHeightBarTextWidth,
                 kHeightBarTextHeight);
  };
  frame.labels.push_back({length(topography_relief_m_), false, beside(kHeightBarHeight)});
  frame.labels.push_back({phrases_.text<Phrase::HeightsTimes>(fmt::format("{:g}", topography_exaggeration_)), false,
                          beside(0.5 * kHeightBarHeight)});
  frame.labels.push_back({"0", false, beside(0.0)});
}

void WallScene::place_fog(const WallState& state, render::FrameState& frame) const {
  frame.fog = {};
  frame.fog.fade = static_cast<float>(state.fade);
  if (state.centerpiece != Centerpiece::Journey) return;
  const auto unit_m = static_cast<float>(glm::length(dvec3(room_from_layout_[0])));
  frame.fog.begin_m = kFogBegin * unit_m;
  frame.fog.end_m = kFogEnd * unit_m;
  frame.fog.origin_m = dvec3(room_from_layout_[3]);
  frame.fog.away = -glm::normalize(dvec3(room_from_layout_[2]));
}

}  // namespace afm::exhibit
