// SPDX-License-Identifier: Apache-2.0
// Places of all nodes in a given state.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <optional>

#include "core/check.h"
#include "exhibit/models/model_builder.h"
#include "exhibit/models/relief.h"
#include "exhibit/scenery/wall_layout.h"
#include "exhibit/scenery/wall_scene.h"
#include "scenery/wall_labels.h"

namespace afm::exhibit {

using glm::dmat4;
using glm::dvec3;

namespace {

std::vector<dmat4> compose(const scene::Scene& scene, const std::vector<dmat4>& local) {
  std::vector<dmat4> room(local.size());
  for (std::size_t i = 0; i < local.size(); ++i) {
    const auto parent = scene.nodes[i].parent;
    room[i] = parent ? room[*parent] * local[i] : local[i];
  }
  return room;
}

void place_fog(const WallPlaces& places, const WallState& state, render::FrameState& frame) {
  frame.fog = {};
  frame.fog.fade = static_cast<float>(state.fade);
  if (state.centerpiece != Centerpiece::Journey) return;
  const auto unit_m = static_cast<float>(places.unit_m());
  frame.fog.begin_m = kFogBegin * unit_m;
  frame.fog.end_m = kFogEnd * unit_m;
  frame.fog.origin_m = dvec3(places.room_from_layout()[3]);
  frame.fog.away = -glm::normalize(dvec3(places.room_from_layout()[2]));
}

void place_light(const WallPlaces& places, render::FrameState& frame) {
  const dmat4& room_from_layout = places.room_from_layout();
  frame.outlined.clear();
  frame.cone = {};
  frame.key_light.map_share = 1.0F;
  frame.key_light.direction_to_light =
      glm::vec3(glm::dmat3(room_from_layout) * glm::normalize(dvec3(-0.55, 0.75, 0.6)));
  frame.key_light.shadow_center_m = glm::vec3(dvec3(room_from_layout * glm::dvec4(0.0, 0.0, -0.35, 1.0)));
  frame.key_light.shadow_radius_m = static_cast<float>(1.7 * places.unit_m());
}

constexpr double kLeastBelow = 0.01;  // least depth of the level sample below marks, in sides of their square

// True after a pull-off; never with particles, which have no such height.
bool shows_ghost(const WallState& state, bool with_particles) {
  return state.centerpiece == Centerpiece::Instrument && state.material && !with_particles && state.cue &&
         state.cue->kind == physics::EventKind::JumpOffContact;
}

// True in tapping mode, unless the swing is too small to be seen.
bool shows_swing(const WallState& state, double layout_per_m) {
  return state.centerpiece == Centerpiece::Instrument && state.material &&
         state.swing.amplitude_m * layout_per_m > kSmallestSwing;
}

}  // namespace

std::vector<dmat4> WallScene::local_transforms(const WallState& state, std::vector<render::BeamBend>& bends) const {
  std::vector<dmat4> local;
  local.reserve(scene_.nodes.size());
  for (const scene::Node& node : scene_.nodes) local.push_back(node.parent_from_node);

  const Instrument::Setting setting{.tip = state.tip,
                                    .layout_per_m = layout_per_m(state),
                                    .below_tip = below_tip(state),
                                    .full_deflection_m = state.material
                                                             ? looks_[*state.material].full_deflection_m *
                                                                   parameter_factor(*state.material, state.release_z_m)
                                                             : 1.0};
  Instrument::Setting drawn = setting;
  if (state.stroboscope && shows_swing(state, setting.layout_per_m)) {
    drawn.strobe_m = state.swing.amplitude_m * std::cos(2.0 * std::numbers::pi * state.strobe_turns);
  }
  bends.resize(1);
  instrument_.place_probe(scene_, drawn, marks_, local, bends.front());
  if (shows_ghost(state, particles_.has_value())) {
    // the tip still on the sample, the lever's end as far below as the pull-off is high
    Instrument::Setting pulled = setting;
    pulled.tip.z_m = pulled.tip.deflection_m = kStrokeHeight / kStrokeOfZjoc / setting.layout_per_m;
    instrument_.place_ghost(pulled, local, bends.emplace_back());
  }
  if (shows_swing(state, setting.layout_per_m)) {
    instrument_.place_swing(setting, state.swing.amplitude_m, local, bends.emplace_back());
  }
  place_sample(state, local);
  if (particles_) {
    const double height = setting.layout_per_m * (state.tip.z_m - state.tip.deflection_m);
    particles_->place(state.particles, setting.layout_per_m, setting.below_tip + dvec3(0.0, 0.0, height), local);
  }
  instrument_.place_optics(scene_, drawn, local);
  if (state.navigation != dmat4(1.0)) {
    const dmat4 navigated = glm::inverse(places_.room_from_layout()) * state.navigation * places_.room_from_layout();
    for (const scene::NodeIndex root : {sample_frame_, instrument_.optics()}) local[root] = navigated * local[root];
  }
  for (std::size_t i = 0; i < looks_.size(); ++i)
    local[looks_[i].swatch] = glm::translate(dmat4(1.0), places_.swatch(i, looks_.size()));
  if (state.wand) place_wand(state, local);
  if (const double m_per_unit = ruler_m_per_unit(state); m_per_unit > 0.0) {
    marks_.place_ruler(scale_bar(m_per_unit, kRulerLongest), local);
  }
  if (state.scan_line) {
    const auto over = [&](const dvec3& point) { return layout_per_m(state) * point + dvec3(0.0, 0.0, kScanLineLift); };
    marks_.place_scan_line(over(state.scan_line->front()), over(state.scan_line->back()), local);
  }
  if (state.centerpiece == Centerpiece::Analogy) analogy_.place(analogy_heights(state), local);
  if (state.centerpiece == Centerpiece::Journey) {
    journey_.place(state.journey_orders, local);
    marks_.place_gap(dvec3(0.0), journey_.gap_m() * dvec3(local[journey_.frame()][2]), local);
  }
  return local;
}

// Places the sample in its true proportions, above the stage. Its size does not depend on the tip's parameters: the
// ruler and the scale line do. Without a sample, the stage is below the first one's place.
void WallScene::place_sample(const WallState& state, std::vector<dmat4>& local) const {
  const MaterialLook& look = looks_[state.material.value_or(0)];
  const double per_m = kStrokeHeight / look.surface_stroke_m;
  if (state.material) local[look.sample] = glm::scale(dmat4(1.0), dvec3(per_m)) * local[look.sample];
  double thickness = look.thickness_m * per_m;
  if (state.centerpiece == Centerpiece::Analogy) thickness = analogy_.plate_thickness();
  instrument_.place_stage(scene_, thickness, local);
}

void WallScene::place_wand(const WallState& state, std::vector<dmat4>& local) const {
  const dmat4 layout_from_room = glm::inverse(places_.room_from_layout());
  const input::Ray ray = input::ray_of(*state.wand);
  const dvec3 grip(layout_from_room * glm::dvec4(ray.origin_m, 1.0));
  const dvec3 direction = glm::normalize(dvec3(layout_from_room * glm::dvec4(ray.direction, 0.0)));
  const double to_wall = direction.z < 0.0 ? -grip.z / direction.z : kFreeRayLength;
  const double reach =
      state.hovered ? glm::distance(places_.swatch(*state.hovered, looks_.size()) + kSwatchCenter, grip) - kRayGap
                    : std::min(to_wall, kLongestRay);
  local[wand_] = looking_along(grip, -direction);
  local[ray_] = stretched(grip, grip + direction * reach, 0.6 * kBeamRadius);
}

std::vector<dmat4> WallScene::node_transforms(const WallState& state) const {
  std::vector<render::BeamBend> bends;
  return compose(scene_, local_transforms(state, bends));
}

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
  if (state.centerpiece != Instrument) hide({instrument_.lever(), instrument_.optics()});
  if (state.centerpiece == Journey) hide({instrument_.stage(), instrument_.floor()});
  if (state.centerpiece != Analogy) hide({analogy_.frame()});
  if (state.centerpiece != Journey) hide({journey_.frame()});
  if (!topography_mesh_ || state.centerpiece != Instrument || !state.material) hide({height_bar_});
  if (state.centerpiece != Instrument || !state.material) hide(marks_.lever_nodes());
  if (!shows_ghost(state, particles_.has_value())) hide({instrument_.ghost()});
  if (!shows_swing(state, layout_per_m(state))) {
    for (const scene::NodeIndex part : instrument_.swing()) hide({part});
  }
  if (ruler_m_per_unit(state) == 0.0) hide(marks_.ruler_nodes());
  if (state.centerpiece != Journey || state.journey_orders < kGapFromOrders) hide(marks_.gap_nodes());
  if (particles_) {
    const bool shown = state.centerpiece == Instrument && state.material;
    if (!shown) hide(particles_->nodes());
    if (!shown || !particles_->shows_ring(state.particles)) hide({particles_->ring()});
  }
  if (state.centerpiece != Instrument || !state.scan_line) hide({marks_.scan_line_node()});
  if (!state.wand || state.centerpiece == Journey) hide({wand_, ray_});
  return hidden;
}

void WallScene::update(const WallState& state, render::FrameState& frame) const {
  frame.room_from_node = compose(scene_, local_transforms(state, frame.bends));
  frame.copies.clear();
  frame.shapes.clear();
  if (particles_) particles_->add_copies(state.particles, layout_per_m(state), frame);

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

  places_.place_panels(state, frame);
  frame.labels.clear();
  if (state.centerpiece != Centerpiece::Journey) place_swatch_labels(state, frame);
  if (state.centerpiece == Centerpiece::Analogy) place_analogy_labels(state, frame);
  place_marks(state, frame);
  if (topography_mesh_ && state.centerpiece == Centerpiece::Instrument && state.material) {
    add_height_labels(places_, phrases_, topography_relief_m_, topography_exaggeration_, frame);
  }
  place_fog(places_, state, frame);
  place_light(places_, frame);
  // the floor's shadows are painted in its colours
  frame.unshadowed.assign(1, instrument_.floor_surface());
  if (state.centerpiece == Centerpiece::Journey) {
    journey_.shade(state.journey_orders, frame.room_from_node[journey_.frame()], places_.unit_m(), frame);
  }
}

// Places the labels on the slanted face of each swatch's base.
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

// Places the labels next to the parts, in the wall's plane; the plate's label is on its front.
void WallScene::place_analogy_labels(const WallState& state, render::FrameState& frame) const {
  const Analogy::Heights heights = analogy_heights(state);
  const auto beside = [&](double height) {
    const double y = height * std::cos(kSampleTiltRad) - 0.5 * kAnalogyLabelHeight;
    return places_.in_scene(-kAnalogyLabelGap - kAnalogyLabelWidth, y, kAnalogyLabelWidth, kAnalogyLabelHeight);
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

// Places the ruler's number, and the event at the contact of tip or magnet and sample.
void WallScene::place_marks(const WallState& state, render::FrameState& frame) const {
  frame.contact = {};
  const double m_per_unit = ruler_m_per_unit(state);
  if (m_per_unit == 0.0) return;
  const ScaleBar bar = scale_bar(m_per_unit, kRulerLongest);
  const bool travels = state.centerpiece == Centerpiece::Journey;
  const auto companion = travels ? journey_.companion(state.journey_orders) : std::nullopt;
  // a companion at the right has its name there
  using enum WallPlaces::RulerSide;
  const auto side = companion && companion->place.x > 0.0 ? Left : Right;
  frame.labels.push_back({.text = bar.text, .highlighted = false, .placement = places_.ruler_text(bar.drawn, side)});
  if (travels) {
    if (companion) add_companion_label(*companion, frame.room_from_node[journey_.frame()], places_, phrases_, frame);
    return add_journey_labels(journey_, places_, phrases_, state.journey_orders, frame);
  }

  const auto radius_m = static_cast<float>(kShadeRadius * places_.unit_m());
  const bool magnet = state.centerpiece == Centerpiece::Analogy;
  frame.contact = {.place_m = glm::vec3(frame.room_from_node[magnet ? analogy_.magnet() : instrument_.apex()][3]),
                   .shade_radius_m = magnet ? 0.8F * radius_m : radius_m};
  if (!state.cue) return;
  const CueRing ring = cue_ring(*state.cue);
  frame.contact.ring_color = ring.color;
  frame.contact.ring_radius_m = static_cast<float>(ring.radius) * frame.contact.shade_radius_m;
  if (magnet) return;
  frame.labels.push_back(cue_label(*state.cue, phrases_, places_, dvec3(frame.room_from_node[sample_frame_][3])));
}

void WallScene::lay_on_sample(const HeightRelief& relief, const WallState& state, render::FrameState& frame) const {
  if (state.centerpiece != Centerpiece::Instrument || !state.material) return;
  const double per_m = layout_per_m(state);
  const dmat4 sample_from_relief =
      glm::scale(glm::translate(dmat4(1.0), dvec3(0.0, 0.0, per_m * relief.floor_m + kReliefLift)),
                 per_m * dvec3(relief.side_m, relief.side_m, relief.lid_m - relief.floor_m));
  frame.room_from_node[relief_] = frame.room_from_node[sample_frame_] * sample_from_relief;
  frame.shapes.push_back({.node = relief_, .vertices = relief.vertices});
  for (scene::NodeIndex i = 0; i < scene_.nodes.size(); ++i) {
    if (is_below(scene_, height_bar_, i)) frame.visible[i] = 1;
  }
  if (!topography_mesh_) add_height_labels(places_, phrases_, relief.range_m, std::nullopt, frame);
}

void WallScene::clear_right_of_ruler(const WallState& state, render::FrameState& frame) const {
  const double m_per_unit = ruler_m_per_unit(state);
  if (m_per_unit == 0.0) return;
  const double length = scale_bar(m_per_unit, kRulerLongest).drawn;
  const render::PanelPlacement right = places_.ruler_text(length, WallPlaces::RulerSide::Right);
  for (render::Label& label : frame.labels) {
    if (label.placement == right) label.placement = places_.ruler_text(length, WallPlaces::RulerSide::Left);
  }
}

void WallScene::lay_marks(const HeightRelief& relief, const WallState& state, render::FrameState& frame) const {
  lay_on_sample(relief, state, frame);
  if (state.centerpiece != Centerpiece::Instrument || !state.material) return;
  const dmat4& frame_of_sample = frame.room_from_node[sample_frame_];
  const dmat4 down =
      frame_of_sample *
      glm::translate(dmat4(1.0),
                     dvec3(0.0, 0.0, -layout_per_m(state) * std::max(relief.range_m, kLeastBelow * relief.side_m))) *
      glm::inverse(frame_of_sample);
  for (scene::NodeIndex i = 0; i < scene_.nodes.size(); ++i) {
    if (is_below(scene_, looks_[*state.material].sample, i)) frame.room_from_node[i] = down * frame.room_from_node[i];
  }
}

}  // namespace afm::exhibit
