// SPDX-License-Identifier: Apache-2.0
#include "haptics/contact_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "contact/felt_vibration.h"
#include "core/enumerators.h"
#include "haptics/contact/paid_force.h"
#include "haptics/felt_marks.h"
#include "haptics/felt_particles.h"
#include "haptics/map_contact.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_surface.h"
#include "scene/shared/shared_segment.h"

namespace afm::haptics {

namespace {

tl::unexpected<core::Error> refusal(const scene::SharedContact& material, core::ErrorCategory category,
                                    std::string_view why) {
  // an unterminated name is cut, and control characters must not reach a terminal
  std::string name(material.name.data(), ::strnlen(material.name.data(), material.name.size()));
  std::replace_if(name.begin(), name.end(), [](char byte) { return byte < ' ' || byte > '~'; }, '?');
  return core::failure(category, fmt::format("cannot build the contact model for {}: {}", name, why));
}

std::shared_ptr<const physics::TapSurface> tapped_surface(const scene::SharedContact& material) {
  return std::make_shared<const physics::TapSurface>(material.law, material.contact, scene::law_options(material),
                                                     physics::Viscosity(material.viscosity_pa_s));
}

std::shared_ptr<const physics::LawTables> build(const scene::SharedContact& material,
                                                std::span<const scene::SharedMeasuredCurve> curves) {
  if (scene::taps(material)) {
    return physics::tapped_law_tables(material.law, tapped_surface(material), scene::tapping_lever(material));
  }
  if (material.law != physics::Law::Measured) {
    return physics::build_law_tables(material.law, material.contact, scene::law_options(material));
  }
  const scene::SharedMeasuredCurve& curve = curves[material.measured_curve];
  return physics::measured_law_tables(std::span(curve.approach).first(curve.approach_count),
                                      std::span(curve.retract).first(curve.retract_count), material.contact,
                                      curve.jumps);
}

physics::DynamicModel dynamic_model(const scene::SharedContact& material, std::int64_t period_ns) {
  return physics::DynamicModel(material.law, material.contact, material.lever,
                               physics::Time(1e-9 * static_cast<double>(period_ns)), scene::law_options(material));
}

physics::TappingModel tapping_model(const scene::SharedContact& material,
                                    const std::shared_ptr<const physics::LawTables>& tables, std::int64_t period_ns) {
  return {tapped_surface(material), scene::tapping_lever(material), tables,
          physics::Time(1e-9 * static_cast<double>(period_ns))};
}

// Potential for every height that the hand can reach, for any orientation of the sample.
PotentialEnergy stored_energy_of(const physics::LawTables& tables, const Scaling& scaling, const DeviceSpec& device) {
  const auto felt = [&scaling](const physics::BranchTable& branch) {
    return [&scaling, &branch](double height_m) {
      return scaling.hand_force_n(branch.force(physics::Length(scaling.z_m(height_m))).si);
    };
  };
  const double reach_m = glm::length(glm::max(glm::abs(device.workspace_min_m - device.contact_point_m),
                                              glm::abs(device.workspace_max_m - device.contact_point_m)));
  return PotentialEnergy(felt(tables.free), felt(tables.attached), scaling.hand_height_m(tables.figures.z_jtc.si),
                         {-reach_m, reach_m});
}

// Replaces the segment's topography in a validation without a segment.
constexpr scene::SharedTopography kAnyTopography{.columns = 2, .rows = 2, .spacing_m = 1};

// Additional energy that a recorded contact pressed down to `lowest` gives the hand on its way up from z, compared with
// the attached branch, until it has joined that branch or detaches.
double turn_energy_j(const physics::LawTables& tables, const Scaling& scaling, physics::Length z,
                     physics::Length lowest) {
  const physics::Length way = std::min(lowest + tables.turn, tables.figures.z_joc) - z;
  if (tables.turn.si <= 0.0 || way.si <= 0.0) return 0.0;
  constexpr int kSteps = 32;
  double sum_n = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const physics::Length at = z + way * ((i + 0.5) / kSteps);
    sum_n +=
        scaling.hand_force_n(tables.contact_force(at, lowest).si) - scaling.hand_force_n(tables.attached.force(at).si);
  }
  return sum_n / kSteps * way.si * scaling.hand_m_per_m();
}

// All scales of a material, in the order of scene::kScaleModes, for all laws under the tip.
core::Result<ContactModel::Scalings> scalings_of(const scene::SharedContact& material, Scaling::Laws laws,
                                                 const CommonScale& common, const DeviceSpec& device) {
  const auto common_scaling = Scaling::common(laws, device, common);
  const auto fit = Scaling::fit(laws, device);
  const auto compressed = Scaling::compressed(laws, device);
  const auto atoms = Scaling::atoms(laws, device, material.friction.period.si);
  // without particles nothing is felt on their scale
  const bool has_particles = common.particles.hand_m_per_m > 0.0;
  const auto particles = has_particles ? Scaling::particles(*laws.front(), device, common.particles) : fit;
  for (const auto* scaling : {&common_scaling, &fit, &compressed, &atoms, &particles}) {
    if (!*scaling) return tl::unexpected(scaling->error());
  }
  return ContactModel::Scalings{*common_scaling, *fit, *compressed, *atoms, *particles};
}

// Family of laws between which a map is interpolated, null without a map.
core::Result<std::shared_ptr<const LawFamily>> family_of(const scene::SharedContact& material,
                                                         const scene::SharedLawMap* map) {
  if (material.law_map == 0) return nullptr;
  if (map == nullptr || map->columns == 0) return core::failure(core::ErrorCategory::Failed, "it has no map");
  return LawFamily::create(material, *map);
}

double slow_motion_of(const physics::ApproachRetractModel& /*at rest at any time*/) { return 1.0; }
double slow_motion_of(const physics::DynamicModel& model) { return model.slow_motion(); }
double slow_motion_of(const physics::TappingModel& model) { return model.slow_motion(); }

}  // namespace

double largest_curvature_per_m(const Scaling& fit, const DeviceSpec& device) {
  const double stands_n_per_m = std::min(Scaling::kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
  return (1.0 - FeltFriction::kShareOfStiffness) * stands_n_per_m / force_cap_n(device) * fit.hand_m_per_m();
}

core::Result<std::shared_ptr<const physics::LawTables>> build_tables(
    const scene::SharedContact& material, std::span<const scene::SharedMeasuredCurve> curves) {
  if (auto valid =
          scene::validate(material, static_cast<std::uint32_t>(curves.size()), scene::kMaxHeightFields, kAnyTopography);
      !valid) {
    return refusal(material, valid.error().category, valid.error().message);
  }
  try {
    return build(material, curves);
  } catch (const std::exception& error) {
    return refusal(material, core::ErrorCategory::Failed, error.what());
  }
}

core::Result<std::unique_ptr<ContactModel>> ContactModel::create(
    const scene::SharedContact& material, std::uint32_t edit_revision, std::shared_ptr<const physics::LawTables> tables,
    const scene::FeltHeights& drawn, const CommonScale& common, const DeviceSpec& device, std::int64_t period_ns,
    const scene::SharedLawMap* map) {
  const auto family = family_of(material, map);
  if (!family) return refusal(material, family.error().category, family.error().message);
  const std::array alone{tables};
  const auto scaled = *family ? scalings_of(material, (*family)->laws(), common, MapContact::along_normal(device))
                              : scalings_of(material, alone, common, device);
  if (!scaled) return refusal(material, scaled.error().category, scaled.error().message);
  const Scalings& scalings = *scaled;
  const Scaling& fit = scalings[core::index_of(scene::ScaleMode::Fit)];
  try {
    Model model(std::in_place_type<physics::ApproachRetractModel>, tables);
    if (material.dynamic != 0) model = dynamic_model(material, period_ns);
    if (scene::taps(material)) model = tapping_model(material, tables, period_ns);
    const double size = scene::surface_scale(material, fit.release_z_m());
    SampleSurface surface(drawn.scaled(size), material.contact.tip_radius.si, largest_curvature_per_m(fit, device));
    std::unique_ptr<MapContact> felt_map;
    if (*family) {
      felt_map = std::make_unique<MapContact>(*family, tables, *map,
                                              size * material.topography.lateral * map->spacing_m, scalings, device,
                                              MapContact::Channels{material.viscous_map != 0, material.map_vibration});
    }
    std::optional<FeltFriction> friction;
    if (material.friction.law != physics::FrictionLaw::None) friction.emplace(material, tables, device);
    StoredEnergies stored_energies;
    for (const Scaling& scaling : scalings) stored_energies.push_back(stored_energy_of(*tables, scaling, device));
    auto contact = std::unique_ptr<ContactModel>(
        new ContactModel(std::move(model), std::move(felt_map), std::move(surface), std::move(friction), scalings,
                         std::move(stored_energies), std::move(tables), force_cap_n(device), edit_revision));
    if (material.felt_mean_force != 0) contact->mean_force_ = std::make_unique<PaidForce>();
    return contact;
  } catch (const std::exception& error) {
    return refusal(material, core::ErrorCategory::Failed, error.what());
  }
}

ContactModel::ContactModel(Model model, std::unique_ptr<MapContact> map, SampleSurface surface,
                           std::optional<FeltFriction> friction, const Scalings& scalings,
                           StoredEnergies stored_energies, std::shared_ptr<const physics::LawTables> tables,
                           double force_cap_n, std::uint32_t edit_revision)
    : model_(std::move(model)),
      map_(std::move(map)),
      surface_(std::move(surface)),
      friction_(std::move(friction)),
      steepest_slope_(surface_.steepest_slope()),
      largest_curvature_per_m_(surface_.largest_curvature_per_m()),
      force_cap_n_(force_cap_n),
      scalings_(scalings),
      stored_energies_(std::move(stored_energies)),
      tables_(std::move(tables)),
      slow_motion_(std::visit([](const auto& m) { return slow_motion_of(m); }, model_)),
      edit_revision_(edit_revision) {}

ContactModel::~ContactModel() = default;

void ContactModel::use(scene::ScaleMode mode, FeltParticles* particles, FeltMarks* marks) noexcept {
  mode_ = mode;
  particles_ = mode == scene::ScaleMode::Particles ? particles : nullptr;
  marks_ = mode == scene::ScaleMode::Particles ? marks : nullptr;
  if (particles_ == nullptr) return;
  scalings_[static_cast<std::size_t>(mode)].clear_particles(particles_->scale().clear_z_m);
}

Touch ContactModel::step(const glm::dvec3& hand_m, const ScanFeedback& feedback) noexcept {
  if (marks_ != nullptr) return step_marks(hand_m, feedback);
  const Scaling& scale = scaling();
  Touch touch;
  touch.tip_xy_m = glm::dvec2(hand_m) / scale.lateral_m_per_m();
  SampleSurface::Place below = surface_.at(touch.tip_xy_m);
  touch.surface_height_m = below.height_m;
  touch.z_m = scale.z_m(hand_m.z) - below.height_m;
  if (feedback.on != level_ && may_change_level(scale.z_m(hand_m.z), below.height_m, feedback)) level_ = feedback.on;
  if (level_) {
    follow_surface(scale.z_m(hand_m.z), below.height_m, feedback, touch);
    below.slope = glm::dvec2(0.0);
  }
  if (map_) touch.map = map_->step(mode_, scale, touch.tip_xy_m, touch.z_m, feedback.elapsed_s);
  touch.response = map_ ? touch.map.response : step_law(physics::Length(touch.z_m));
  touch.normal = glm::normalize(glm::dvec3(-below.slope, 1.0));
  const glm::dvec3 gradient(-below.slope * scale.flattening(), 1.0);
  touch.hand_force_n = felt_force_n(touch, feedback.elapsed_s) * gradient;
  if (map_) {
    touch.hand_force_n += glm::dvec3(touch.map.sideways_n, 0.0);
    const double room_n = force_cap_n_ - glm::length(touch.hand_force_n);
    touch.map.vibration_n = map_->vibrate(hand_m, room_n, feedback.elapsed_s);
    touch.hand_force_n += touch.map.vibration_n;
  }
  if (particles_ != nullptr) meet_particles(below.slope, feedback, touch);
  if (friction_) {
    // the loop keeps the load constant
    const double load_z_m = level_ ? scale.z_m(hand_m.z) : touch.z_m;
    touch.friction = friction_->step(touch.tip_xy_m, {load_z_m, touch.push.bears_n}, below, touch.response, scale);
    touch.hand_force_n += touch.friction.hand_force_n;
  }
  return touch;
}

void ContactModel::meet_particles(const glm::dvec2& slope, const ScanFeedback& feedback, Touch& touch) noexcept {
  if (feedback.without_force || phase() == physics::Phase::WaitForLift) return particles_->drop();
  touch.groove = particles_->groove().step(touch.tip_xy_m, !level_, feedback.elapsed_s);
  if (touch.groove.acts) touch.hand_force_n += glm::dvec3(touch.groove.force_n, 0.0);
  if (level_) return particles_->lift();
  touch.push = particles_->step(touch.tip_xy_m, touch.z_m, feedback.elapsed_s);
  if (!touch.push.touches) return;
  const glm::dvec3& push_n = touch.push.push_n;
  const glm::dvec3 gradient(-slope * scaling().flattening(), 1.0);
  touch.hand_force_n += particles_->scale().hand_n_per_n * (glm::dvec3(push_n.x, push_n.y, 0.0) + push_n.z * gradient);
}

// True if the change is not felt, because the tip is off the sample before and after.
bool ContactModel::may_change_level(double hand_z_m, double height_m, const ScanFeedback& feedback) const noexcept {
  const double release_z_m = scaling().release_z_m();
  const bool off = phase() == physics::Phase::Free && hand_z_m > release_z_m && hand_z_m - height_m > release_z_m;
  return feedback.without_force || off || phase() == physics::Phase::WaitForLift;
}

// Moves the loop after the surface while the tip is on it; otherwise sets it to the surface.
void ContactModel::follow_surface(double hand_z_m, double height_m, const ScanFeedback& feedback,
                                  Touch& touch) noexcept {
  if (phase() != physics::Phase::Attached) {
    loop_m_ = height_m;
    residual_m_ = 0.0;
    tank_.fill();
    touch.z_m = hand_z_m;
    return;
  }
  tank_.refill(feedback.elapsed_s);
  loop_m_ += -std::expm1(-feedback.gain_per_s * feedback.elapsed_s) * (height_m - loop_m_);
  const double most_m = kMostResidualM / scaling().hand_m_per_m();
  const double next_m = std::clamp(height_m - loop_m_, -most_m, most_m);
  const double given_j = attached_j(touch, hand_z_m - next_m) - attached_j(touch, hand_z_m - residual_m_);
  if (given_j <= tank_.held_j()) {
    tank_.take(given_j);
    residual_m_ = next_m;
    touch.level_given_j = given_j;
  }
  touch.z_m = hand_z_m - residual_m_;
}

// Potential on the attached branch, on the hand.
double ContactModel::attached_j(const Touch& touch, double z_m) const noexcept {
  if (map_) return map_->attached_j(mode_, scaling(), touch.tip_xy_m, z_m);
  const double stored_j = stored_energy().at(physics::Phase::Attached, scaling().hand_height_m(z_m));
  const auto* model = std::get_if<physics::ApproachRetractModel>(&model_);
  if (model == nullptr) return stored_j;
  // the potential is that of the attached branch, but at a jump to contact all of it is that of the free branch
  const physics::Length in = tables_->figures.z_jtc;
  return stored_j + (turn_energy_j(*tables_, scaling(), physics::Length(z_m), model->lowest_z()) -
                     turn_energy_j(*tables_, scaling(), in, in));
}

// Stiffness of F (-slope, 1): the law's stiffness along the steepest path, plus the strongest force at the largest
// curvature.
double ContactModel::stiffness_n_per_m() const noexcept {
  // a recorded contact's turn adds at most its mean stiffness
  const double turning = tables_->turn.si > 0.0 ? 2.0 : 1.0;
  const double law_n_per_m = map_ ? map_->stiffness_n_per_m(mode_) : stored_energy().stiffness_n_per_m();
  return turning * law_n_per_m * (1.0 + steepest_slope_ * steepest_slope_) +
         force_cap_n_ * largest_curvature_per_m_ / scaling().hand_m_per_m() +
         (friction_ ? friction_->stiffness_n_per_m(scaling()) : 0.0) +
         (map_ ? map_->vibration().stiffness_n_per_m() : 0.0);
}

physics::TipResponse ContactModel::step_law(physics::Length z) noexcept {
  return std::visit([z](auto& model) { return model.step(z); }, model_);
}

// Force along the sample's normal, on the hand.
double ContactModel::felt_force_n(Touch& touch, double elapsed_s) noexcept {
  if (map_) return touch.map.force_n;
  const auto* tapping = std::get_if<physics::TappingModel>(&model_);
  if (tapping == nullptr) return scaling().hand_force_n(touch.response.force.si);
  if (tapping->phase() == physics::Phase::WaitForLift) {
    if (mean_force_) mean_force_->forget();
    return scaling().hand_force_n(0.0);
  }
  touch.swing = {.amplitude_m = tapping->amplitude().si, .phase_rad = tapping->phase_lag()};
  if (!feels_mean_force()) {
    if (mean_force_) mean_force_->forget();
    return scaling().hand_force_n(tapping->push().si);
  }
  const double before_m = std::exchange(mean_force_m_, scaling().hand_height_m(touch.z_m));
  return mean_force_->step(scaling().hand_force_n(touch.response.force.si), mean_force_m_ - before_m, elapsed_s);
}

void ContactModel::wait_for_lift() noexcept {
  std::visit([](auto& model) { model.wait_for_lift(); }, model_);
  if (map_) map_->wait_for_lift();
  if (friction_) friction_->lift();
  if (particles_ != nullptr) particles_->drop();
  if (marks_ != nullptr) marks_->lift();
}

physics::Phase ContactModel::phase() const noexcept {
  if (marks_ != nullptr) return marks_->phase();
  if (map_) return map_->phase();
  return std::visit([](const auto& model) { return model.phase(); }, model_);
}

PassivityObserver::Law ContactModel::energy(const Touch& touch) const noexcept {
  if (marks_ != nullptr) return marks_energy(touch);
  const bool attached = touch.response.phase == physics::Phase::Attached;
  PassivityObserver::Law law{.stiffness_n_per_m = stiffness_n_per_m(),
                             .is_dynamic = std::holds_alternative<physics::DynamicModel>(model_)};
  if (touch.response.phase == physics::Phase::WaitForLift) return law;
  if (map_) {
    law.stored_j = touch.map.stored_j + map_->vibration().stored_j();
  } else if (attached) {
    law.stored_j = attached_j(touch, touch.z_m);
  } else {
    law.stored_j = stored_energy().at(touch.response.phase, scaling().hand_height_m(touch.z_m));
  }
  if (feels_mean_force()) {
    law.stored_j = mean_force_->lent_j();
    law.given_j = mean_force_->paid_j();
  }
  if (friction_) {
    law.stored_j += friction_->stored_j(scaling());
    law.given_j = touch.friction.given_j;
  }
  if (touch.push.near) {
    law.stored_j += particles_->stored_j();
    law.given_j += touch.push.given_j;
    law.stiffness_n_per_m += particles_->stiffness_n_per_m();
  }
  if (touch.groove.acts) {
    law.stored_j += touch.groove.stored_j;
    law.given_j += touch.groove.given_j;
    law.stiffness_n_per_m += touch.groove.stiffness_n_per_m;
  }
  if (level_) law.given_j += touch.level_given_j;
  if (std::holds_alternative<physics::TappingModel>(model_)) {
    law.is_dynamic = true;  // the branch changes only when the swing has left it
  } else if (law.is_dynamic) {
    const auto& branch = attached ? tables_->attached : tables_->free;
    const double at_rest_n = scaling().hand_force_n(branch.force(physics::Length(touch.z_m)).si);
    law.oscillation_n = std::abs(touch.hand_force_n.z - at_rest_n) / touch.normal.z;
  }
  return law;
}

}  // namespace afm::haptics
