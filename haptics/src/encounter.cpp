// SPDX-License-Identifier: Apache-2.0
#include "haptics/encounter.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "scene/shared_segment.h"

namespace afm::haptics {

namespace {

tl::unexpected<core::Error> refusal(const scene::SharedMaterial& material, core::ErrorCategory category,
                                    std::string_view why) {
  // a name that came without its end is cut, and nothing in it may command a terminal
  std::string name(material.name.data(), ::strnlen(material.name.data(), material.name.size()));
  std::replace_if(
      name.begin(), name.end(), [](char byte) { return byte < ' ' || byte > '~'; }, '?');
  return core::failure(category, fmt::format("cannot make {} felt: {}", name, why));
}

std::shared_ptr<const physics::LawTables> build(const scene::SharedMaterial& material,
                                                std::span<const scene::SharedMeasuredCurve> curves) {
  if (material.law != physics::Law::Measured) {
    return physics::build_law_tables(material.law, material.interaction, scene::law_options(material));
  }
  const scene::SharedMeasuredCurve& curve = curves[material.measured_curve];
  return physics::measured_law_tables(std::span(curve.approach).first(curve.approach_count),
                                      std::span(curve.retract).first(curve.retract_count), material.interaction);
}

physics::DynamicModel dynamic_model(const scene::SharedMaterial& material, std::int64_t period_ns) {
  return physics::DynamicModel(material.law, material.interaction, material.lever,
                               physics::Time(1e-9 * static_cast<double>(period_ns)), scene::law_options(material));
}

// For every height at which a hand can be, however the sample is turned.
StoredEnergy stored_energy_of(const physics::LawTables& tables, const FitScaling& scaling, const DeviceSpec& device) {
  const auto felt = [&scaling](const physics::BranchTable& branch) {
    return [&scaling, &branch](double height_m) {
      return scaling.hand_force_n(branch.force(physics::Length(scaling.z_m(height_m))).si);
    };
  };
  const double reach_m = glm::length(glm::max(glm::abs(device.workspace_min_m - device.contact_point_m),
                                              glm::abs(device.workspace_max_m - device.contact_point_m)));
  return StoredEnergy(felt(tables.free), felt(tables.attached), tables.figures.z_jtc.si * scaling.hand_m_per_m(),
                      {-reach_m, reach_m});
}

double slow_motion_of(const physics::ApproachRetractModel& /*at rest at any time*/) { return 1.0; }
double slow_motion_of(const physics::DynamicModel& model) { return model.slow_motion(); }

}  // namespace

core::Result<std::shared_ptr<const physics::LawTables>> felt_tables(
    const scene::SharedMaterial& material, std::span<const scene::SharedMeasuredCurve> curves) {
  if (auto valid = scene::validate(material, static_cast<std::uint32_t>(curves.size()), scene::kMaxHeightFields);
      !valid) {
    return refusal(material, valid.error().category, valid.error().message);
  }
  try {
    return build(material, curves);
  } catch (const std::exception& error) {
    return refusal(material, core::ErrorCategory::Failed, error.what());
  }
}

core::Result<std::unique_ptr<Encounter>> Encounter::create(const scene::SharedMaterial& material,
                                                           std::uint32_t edit_revision,
                                                           std::span<const scene::SharedMeasuredCurve> curves,
                                                           const DeviceSpec& device, std::int64_t period_ns) {
  auto tables = felt_tables(material, curves);
  if (!tables) return tl::unexpected(tables.error());
  auto scaling = FitScaling::create(**tables, device);
  if (!scaling) return refusal(material, scaling.error().category, scaling.error().message);
  try {
    Model model(std::in_place_type<physics::ApproachRetractModel>, *tables);
    if (material.dynamic != 0) model = dynamic_model(material, period_ns);
    return std::unique_ptr<Encounter>(new Encounter(
        std::move(model), *scaling, stored_energy_of(**tables, *scaling, device), *tables, edit_revision));
  } catch (const std::exception& error) {
    return refusal(material, core::ErrorCategory::Failed, error.what());
  }
}

Encounter::Encounter(Model model, const FitScaling& scaling, StoredEnergy stored_energy,
                     std::shared_ptr<const physics::LawTables> tables, std::uint32_t edit_revision)
    : model_(std::move(model)),
      scaling_(scaling),
      stored_energy_(std::move(stored_energy)),
      tables_(std::move(tables)),
      slow_motion_(std::visit([](const auto& m) { return slow_motion_of(m); }, model_)),
      edit_revision_(edit_revision) {}

physics::TipResponse Encounter::step(physics::Length z) noexcept {
  return std::visit([z](auto& model) { return model.step(z); }, model_);
}

void Encounter::wait_for_lift() noexcept {
  std::visit([](auto& model) { model.wait_for_lift(); }, model_);
}

physics::Phase Encounter::phase() const noexcept {
  return std::visit([](const auto& model) { return model.phase(); }, model_);
}

EnergyLedger::Law Encounter::energy(const physics::TipResponse& response, double hand_height_m) const noexcept {
  const bool attached = response.phase == physics::Phase::Attached;
  EnergyLedger::Law law{.stiffness_n_per_m = stored_energy_.stiffness_n_per_m(),
                        .swings = std::holds_alternative<physics::DynamicModel>(model_)};
  if (response.phase == physics::Phase::WaitForLift) return law;
  law.stored_j = stored_energy_.at(attached ? scene::ContactPhase::Attached : scene::ContactPhase::Free, hand_height_m);
  if (law.swings) {
    const auto& branch = attached ? tables_->attached : tables_->free;
    const double at_rest_n = scaling_.hand_force_n(branch.force(physics::Length(scaling_.z_m(hand_height_m))).si);
    law.swing_n = std::abs(scaling_.hand_force_n(response.force.si) - at_rest_n);
  }
  return law;
}

}  // namespace afm::haptics
