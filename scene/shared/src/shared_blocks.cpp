// SPDX-License-Identifier: Apache-2.0
#include "scene/shared/shared_blocks.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <glm/gtc/type_ptr.hpp>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "core/check.h"
#include "core/enumerators.h"
#include "physics/tapping/driven_lever.h"
#include "scene/shared/map_vibration.h"
#include "scene/shared/push_values.h"
#include "scene/shared/shared_segment.h"

namespace afm::scene {

namespace {

// Limit on all distances in the scene and the hand's frame; it keeps products finite.
constexpr double kLargest = 1e9;

bool sane(double value) { return std::isfinite(value) && std::abs(value) <= kLargest; }

template <std::size_t Count>
bool all_sane(const std::array<double, Count>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), sane);
}

bool positive(double value) { return sane(value) && value > 0; }

bool terminated(const Name& name) { return std::find(name.begin(), name.end(), '\0') != name.end(); }

// Checks a field of a block according to its type, and a block field by field. A number without a unit of length or
// force may be larger.
bool is_field_valid(double value) { return sane(value); }
bool is_field_valid(const LawHere& here) {
  return std::isfinite(here.reduced_modulus_pa) && std::isfinite(here.adhesion_j_per_m2);
}
bool is_field_valid(const HandScale& scale) {
  return std::isfinite(scale.hand_m_per_m) && std::isfinite(scale.hand_n_per_n);
}
bool is_field_valid(const PushSettings& settings) { return is_valid(settings); }
template <std::integral Integer>
bool is_field_valid(Integer /*any*/) {
  return true;
}
template <class Enumerator>
  requires std::is_enum_v<Enumerator>
bool is_field_valid(Enumerator enumerator) {
  return core::is_enumerator(enumerator);
}
template <std::size_t Count>
bool is_field_valid(const std::array<double, Count>& numbers) {
  return all_sane(numbers);
}
template <Described Block>
bool is_field_valid(const Block& block) {
  bool all = true;
  for_each_field([&](const char*, const auto& value) { all = all && is_field_valid(value); }, block);
  return all;
}

bool within(std::int32_t material, const SharedModel& model) {
  return material >= -1 && material < static_cast<std::int32_t>(std::min(model.material_count, kMaxMaterials));
}

bool has_particle(std::int32_t particle, const SharedModel& model) {
  return particle >= kNoParticle &&
         particle < static_cast<std::int32_t>(std::min(model.particles.count, kMaxParticles));
}

auto model_refused(std::string message) { return core::failure(core::ErrorCategory::Failed, std::move(message)); }

bool rising_and_sane(std::span<const physics::MeasuredPoint> branch) {
  for (std::size_t i = 0; i < branch.size(); ++i) {
    if (!sane(branch[i].z.si) || !sane(branch[i].force.si)) return false;
    if (i > 0 && !(branch[i].z > branch[i - 1].z)) return false;
  }
  return true;
}

bool is_valid(const SharedHeightField& field) {
  const auto counted = [](std::uint32_t count) { return count >= 2 && count <= kMaxHeightFieldSide; };
  if (!counted(field.columns) || !counted(field.rows) || !positive(field.spacing_m)) return false;
  const std::size_t count = std::size_t{field.columns} * field.rows;
  return std::all_of(field.height_m.begin(), field.height_m.begin() + count,
                     [](float h) { return sane(static_cast<double>(h)); });
}

bool is_valid(const SharedTopography& size) {
  const auto counted = [](std::uint32_t count) { return count >= 2 && count <= kMaxTopographySide; };
  const bool none = size.columns == 0 && size.rows == 0 && size.spacing_m == 0;
  return none || (counted(size.columns) && counted(size.rows) && positive(size.spacing_m));
}

}  // namespace

double surface_scale(const SharedContact& material, double release_z_m) {
  constexpr double kRounding = 1e-9;  // relative tolerance; with unchanged parameters the heights are the same
  const double scale = material.surface_release_m > 0.0 ? release_z_m / material.surface_release_m : 1.0;
  return std::abs(scale - 1.0) < kRounding ? 1.0 : scale;
}

FeltHeights surface_of(const SharedContact& material, std::span<const SharedHeightField> fields,
                       const Topography& topography) {
  if (material.height_field == kTopography && topography.columns > 0) return {topography, material.topography};
  return material.height_field < fields.size() ? FeltHeights(fields[material.height_field]) : FeltHeights();
}

bool is_valid(const Topography& topography, const SharedTopography& size) {
  return is_valid(size) && topography.columns == size.columns && topography.rows == size.rows &&
         topography.spacing_m == size.spacing_m &&
         topography.height_m.size() == std::size_t{size.columns} * size.rows &&
         std::all_of(topography.height_m.begin(), topography.height_m.end(),
                     [](float h) { return sane(static_cast<double>(h)); });
}

Name to_name(std::string_view text) {
  Name name{};
  std::copy_n(text.begin(), std::min(text.size(), name.size() - 1), name.begin());
  return name;
}

physics::LawOptions law_options(const SharedContact& material) {
  physics::LawOptions options;
  options.exact_hamaker_sphere = material.exact_hamaker_sphere != 0;
  const double wavelength_m = material.retardation_wavelength_m;
  if (wavelength_m > 0) options.retardation_wavelength = physics::Length(wavelength_m);
  if (material.has_meniscus != 0) options.meniscus = material.meniscus;
  return options;
}

physics::DrivenLever tapping_lever(const SharedContact& material) {
  const physics::Drive drive{physics::Length(material.free_amplitude_m), physics::Frequency(material.drive_hz)};
  physics::DrivenLever lever = physics::driven_lever(material.contact.spring_constant, material.lever, drive);
  if (material.older_tapping == OlderTapping::Version10) lever.harmonics = physics::Harmonics::AtResonance;
  if (material.older_tapping != OlderTapping::None) lever.jump_off = physics::JumpOff::WherePhaseCrossed;
  return lever;
}

std::string why_no_friction(physics::FrictionLaw friction, physics::Law law, physics::Pressure reduced_modulus) {
  if (friction == physics::FrictionLaw::None) return "";
  if (law == physics::Law::Paper) {
    return "the paper's law has no friction; choose the model dmt, or --friction none";
  }
  if (friction != physics::FrictionLaw::ContactArea) return "";
  if (!physics::has_contact_area(law)) {
    return fmt::format("the law {} has no contact area; choose the model dmt, or --friction amontons",
                       physics::name_of(law));
  }
  return physics::isfinite(reduced_modulus) ? "" : "a rigid contact has no contact area; choose --friction amontons";
}

namespace {

// Reason why the map of modulus and adhesion, or its use, is invalid; empty if valid.
std::string why_no_map(const SharedContact& material) {
  const bool has_map_laws =
      material.law == physics::Law::Dmt || material.law == physics::Law::Jkr || material.law == physics::Law::Hertz;
  if (material.law_map > 1 || (material.law_map == 1 && (!has_map_laws || material.dynamic != 0 || taps(material) ||
                                                         material.friction.law != physics::FrictionLaw::None))) {
    return "its map of modulus and adhesion is felt with the laws dmt, jkr and hertz alone, without friction";
  }
  if (material.viscous_map > material.law_map) return "its viscosity needs a map of modulus and adhesion";
  if (!core::is_enumerator(material.map_vibration)) return "its vibration is unknown";
  if (material.map_vibration != MapVibration::None && material.law_map == 0) {
    return "its vibration needs a map of modulus and adhesion";
  }
  return {};
}

}  // namespace

core::Result<void> validate(const SharedContact& material, std::uint32_t curve_count, std::uint32_t height_field_count,
                            const SharedTopography& topography) {
  if (!terminated(material.name)) return model_refused("its name is not terminated");
  if (!physics::is_known(material.law) || material.exact_hamaker_sphere > 1 || material.has_meniscus > 1 ||
      material.dynamic > 1) {
    return model_refused("its law or an option is unknown");
  }
  if (material.law == physics::Law::Measured && material.measured_curve >= curve_count) {
    return model_refused("it has no measured curve");
  }
  if (material.dynamic != 0 && !physics::has_dynamics(material.law)) {
    return model_refused(fmt::format("the law {} has no dynamics", physics::name_of(material.law)));
  }
  const bool swings = material.free_amplitude_m >= 0.0 && material.viscosity_pa_s >= 0.0;  // false for NaN
  if (!swings || material.older_tapping > (taps(material) ? OlderTapping::Version21 : OlderTapping::None))
    return model_refused("its swing is not a valid one");
  if (material.felt_mean_force > static_cast<int>(taps(material)))
    return model_refused("a lever that does not tap has no mean force to feel");
  if (taps(material) && (material.dynamic != 0 || material.friction.law != physics::FrictionLaw::None ||
                         !physics::has_dynamics(material.law))) {
    return model_refused(fmt::format("the law {} cannot be tapped on", physics::name_of(material.law)));
  }
  if (const std::string why = why_no_map(material); !why.empty()) return model_refused(why);
  const bool traced = material.height_field == kTopography && topography.columns > 0;
  if (material.height_field != kNoHeightField && material.height_field >= height_field_count && !traced) {
    return model_refused("its surface does not exist");
  }
  if (!positive(material.topography.lateral) || !positive(material.topography.vertical)) {
    return model_refused("the scale of its topography is not a valid one");
  }
  if (material.surface_release_m != 0.0 && !positive(material.surface_release_m)) {
    return model_refused("the release that belongs to its surface is not a valid height");
  }
  if (!core::is_enumerator(material.friction.law) || !core::is_enumerator(material.friction.lattice)) {
    return model_refused("its friction is unknown");
  }
  if (const std::string why = why_no_friction(material.friction.law, material.law, material.contact.reduced_modulus);
      !why.empty()) {
    return model_refused(why);
  }
  if (!(material.retardation_wavelength_m >= 0))
    return model_refused("its retardation wavelength is not a valid length");
  try {
    physics::validate(material.contact);
    physics::validate(law_options(material));
    if (material.dynamic != 0) physics::validate(material.lever);
    if (taps(material)) (void)tapping_lever(material);
    physics::validate(material.friction);
  } catch (const std::invalid_argument& error) {
    return model_refused(error.what());
  }
  return {};
}

core::Result<void> validate(const SharedModel& model) {
  if (model.node_count == 0 || model.node_count > kMaxNodes) {
    return model_refused(
        fmt::format("the shared scene has {} nodes: the limits are 1 to {}", model.node_count, kMaxNodes));
  }
  if (model.material_count == 0 || model.material_count > kMaxMaterials) {
    return model_refused(
        fmt::format("the shared scene has {} materials: the limits are 1 to {}", model.material_count, kMaxMaterials));
  }
  if (model.sample_node >= model.node_count) {
    return model_refused(
        fmt::format("the sample is node {} of a shared scene of {}", model.sample_node, model.node_count));
  }
  for (std::uint32_t i = 0; i < model.node_count; ++i) {
    const SharedNode& node = model.nodes[i];
    if (!terminated(node.name)) return model_refused(fmt::format("the name of shared node {} is not terminated", i));
    if (node.parent != kNoParent && node.parent >= i) {
      return model_refused(
          fmt::format("shared node {} has parent {}, but a parent must come before its child", i, node.parent));
    }
    if (!all_sane(node.parent_from_node))
      return model_refused(fmt::format("shared node {} has an invalid transform", i));
  }
  if (model.curve_count > kMaxMeasuredCurves) {
    return model_refused(
        fmt::format("the shared scene has {} measured curves: the limit is {}", model.curve_count, kMaxMeasuredCurves));
  }
  for (std::uint32_t i = 0; i < model.curve_count; ++i) {
    if (!is_valid(model.curves[i]))
      return model_refused(fmt::format("measured curve {} is not in order of increasing Z", i));
  }
  const bool no_scale = model.common_hand_m_per_m == 0 && model.common_hand_n_per_n == 0;
  if (!no_scale && !(std::isnormal(model.common_hand_m_per_m) && model.common_hand_m_per_m > 0 &&
                     std::isnormal(model.common_hand_n_per_n) && model.common_hand_n_per_n > 0)) {
    return model_refused("the common scale of the shared scene is invalid");
  }
  if (model.height_field_count > kMaxHeightFields) {
    return model_refused(
        fmt::format("the shared scene has {} surfaces: the limit is {}", model.height_field_count, kMaxHeightFields));
  }
  for (std::uint32_t i = 0; i < model.height_field_count; ++i) {
    if (!is_valid(model.height_fields[i])) return model_refused(fmt::format("surface {} is not a grid of heights", i));
  }
  if (!is_valid(model.topography)) return model_refused("its topography is not a grid of heights");
  if (!is_valid(model.law_map)) return model_refused("its map of modulus and adhesion is not a grid of such values");
  if (auto valid = validate(model.particles); !valid) return valid;
  for (std::uint32_t i = 0; i < model.material_count; ++i) {
    if (auto valid = validate(model.materials[i], model.curve_count, model.height_field_count, model.topography);
        !valid) {
      return model_refused(fmt::format("material {} of the shared scene: {}", i, valid.error().message));
    }
    if (model.materials[i].law_map == 1 && (model.law_map.columns == 0 || are_there(model.particles))) {
      return model_refused(
          fmt::format("material {} of the shared scene needs a map of modulus and adhesion, and no particles", i));
    }
  }
  return {};
}

bool is_valid(const SharedLawMap& map) {
  if (map.columns == 0 && map.rows == 0) return map.spacing_m == 0;
  const auto counted = [](std::uint32_t count) { return count >= 2 && count <= kMaxLawMapSide; };
  if (!counted(map.columns) || !counted(map.rows) || !positive(map.spacing_m)) return false;
  // written so that NaN fails
  const auto all_within = [&](std::span<const float> values, float least, float most) {
    const auto used = values.first(std::size_t{map.columns} * map.rows);
    return std::all_of(used.begin(), used.end(), [&](float value) { return value >= least && value <= most; });
  };
  constexpr float kLeastLnModulus = 0.0F, kMostLnModulus = 29.0F;  // logarithms of 1 Pa and 4 TPa
  constexpr float kLeastAdhesion = 1e-8F, kMostAdhesion = 100.0F;
  return all_within(map.ln_modulus, kLeastLnModulus, kMostLnModulus) &&
         all_within(map.adhesion_j_per_m2, kLeastAdhesion, kMostAdhesion);
}

bool is_valid(const SharedMeasuredCurve& curve) {
  const auto counted = [](std::uint32_t count) { return count >= 2 && count <= kMaxMeasuredPoints; };
  const bool placed = curve.column >= -1 && curve.row >= -1;
  return placed && counted(curve.approach_count) && counted(curve.retract_count) &&
         curve.jumps.approach <= curve.approach_count && curve.jumps.retract <= curve.retract_count &&
         rising_and_sane(std::span(curve.approach).first(curve.approach_count)) &&
         rising_and_sane(std::span(curve.retract).first(curve.retract_count));
}

bool is_valid(const SceneTransforms& transforms, const SharedModel& model) {
  if (transforms.count != model.node_count || transforms.count > kMaxNodes) return false;
  return std::all_of(transforms.room_from_node.begin(), transforms.room_from_node.begin() + transforms.count,
                     [](const auto& matrix) { return all_sane(matrix); });
}

bool is_valid(const Selection& selection, const SharedModel& model) {
  const bool has_scale = selection.scale_mode != ScaleMode::Particles || are_there(model.particles);
  return within(selection.material, model) && core::is_enumerator(selection.scale_mode) && has_scale &&
         is_valid(selection.settings) && selection.release <= 1;
}

bool is_valid(const HandScript& script) {
  return all_sane(script.target_m) && sane(script.duration_s) && script.duration_s >= 0 && script.turn_on_pressed <= 1;
}

bool is_valid(const ScanLead& lead) {
  const auto& [x_m, y_m] = lead.apex_xy_m;
  const double reach_m = std::max(std::abs(x_m), std::abs(y_m)) + lead.height_m;
  const bool square = lead.height_m > 0 && reach_m <= kFarthestPlanM;
  return is_field_valid(lead) && lead.time_ns >= 0 && lead.feedback <= 1 && lead.gain_per_s >= 0 &&
         lead.gain_per_s <= kMostScanGainPerS && lead.load_pn <= kMostLookLoadPn &&
         (lead.hand != ScanHand::Looks || square);
}

bool is_valid(const RendererHeartbeat& heartbeat) {
  return heartbeat.leaving <= 1 && heartbeat.stop <= 1 && heartbeat.unseen <= 1;
}

bool is_valid(const SharedDevice& device) {
  // limits may be infinite
  return terminated(device.name) && device.max_force_n > 0 && device.max_continuous_force_n > 0 &&
         device.max_stiffness_n_per_m > 0 && device.max_slew_n_per_s > 0 && device.max_speed_m_per_s > 0 &&
         device.max_vibration_n >= 0 && std::isfinite(device.max_vibration_n) && device.has_own_hand <= 1 &&
         all_sane(device.workspace_min_m) && all_sane(device.workspace_max_m);
}

bool is_valid(const TipState& state, const SharedModel& model) {
  return is_field_valid(state) && positive(state.active.slow_motion) && within(state.material, model);
}

bool is_valid(const TipSample& sample, const SharedModel& model) {
  return is_field_valid(sample) && has_particle(sample.push.particle, model) && sample.device_healthy <= 1 &&
         sample.changing <= 1 && sample.level.met <= 1 && is_valid(sample.scan) && is_valid(sample.plan, model) &&
         within(sample.material, model);
}

bool is_valid(const TipEvent& event, const SharedModel& model) {
  return is_field_valid(event) && within(event.material, model);
}

bool is_valid(const ParticlePage& page) {
  return std::all_of(page.poses.begin(), page.poses.end(),
                     [](const ParticlePose& pose) { return is_field_valid(pose) && pose.rod <= 1; });
}

bool is_valid(const PlannedPush& plan, const SharedModel& model) {
  if (plan.particle == kNoParticle) return plan == PlannedPush{};
  const auto near = [](double place_m) { return std::abs(place_m) <= kFarthestPlanM; };  // false for NaN
  return has_particle(plan.particle, model) && plan.guided <= 1 &&
         std::all_of(plan.from_m.begin(), plan.from_m.end(), near) &&
         std::all_of(plan.to_m.begin(), plan.to_m.end(), near) &&
         std::hypot(plan.to_m[0] - plan.from_m[0], plan.to_m[1] - plan.from_m[1]) >= kShortestPlanM;
}

bool is_valid(const TipPush& push, const SharedModel& model) {
  // a scale of force is larger than any length or force
  TipPush lengths_and_forces = push;
  lengths_and_forces.hand_n_per_n = 0;
  return std::isfinite(push.hand_n_per_n) && push.met <= 1 && push.lagging <= 1 && push.strokes <= kMostStrokes &&
         is_field_valid(lengths_and_forces) && has_particle(push.particle, model);
}

glm::dmat4 rest_room_from_node(const SharedModel& model, std::uint32_t node) {
  AFM_CHECK(node < model.node_count && model.node_count <= kMaxNodes);
  glm::dmat4 room_from_node(1.0);
  for (std::uint32_t i = node;; i = model.nodes[i].parent) {
    room_from_node = glm::make_mat4(model.nodes[i].parent_from_node.data()) * room_from_node;
    if (model.nodes[i].parent == kNoParent) return room_from_node;
  }
}

}  // namespace afm::scene
