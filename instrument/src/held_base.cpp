// SPDX-License-Identifier: Apache-2.0
#include "instrument/held_base.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "curves/contact_setup.h"
#include "physics/law_tables.h"

namespace afm::instrument {
namespace {

constexpr double kFarAboveM = 1e-3;  // height beyond every jump off contact

}  // namespace

core::Result<HeldBase> HeldBase::create(const curves::ContactSetup& setup) {
  try {
    if (setup.model.direction_rule) return HeldBase(physics::DirectionRuleModel(setup.material.contact));
    return HeldBase(physics::ApproachRetractModel(
        physics::build_law_tables(setup.law(), setup.material.contact, setup.law_options)));
  } catch (const std::invalid_argument& error) {
    return core::wrong_usage(error.what());
  }
}

const physics::LawTables& HeldBase::tables() const {
  return std::visit([](const auto& model) -> const physics::LawTables& { return model.tables(); }, model_);
}

double HeldBase::height_under(double force_n) const {
  const physics::LawTables& law = tables();
  const auto force_at = [&law](double height_m) {
    return law.contact_force(physics::Length(height_m), physics::Length(height_m)).si;
  };
  double above_m = law.figures.z_joc.si, depth_m = 1e-9;
  if (force_at(above_m) >= force_n) return above_m;
  while (force_at(above_m - depth_m) < force_n && depth_m < kFarAboveM) depth_m *= 2.0;
  double below_m = above_m - depth_m;
  // halved until both are neighbours, or nearly
  for (int i = 0; i < 80; ++i) {
    const double middle_m = 0.5 * (below_m + above_m);
    (force_at(middle_m) < force_n ? above_m : below_m) = middle_m;
  }
  return below_m;
}

void HeldBase::lift() {
  if (auto* latch = std::get_if<physics::ApproachRetractModel>(&model_)) latch->wait_for_lift();
  step(kFarAboveM);
}

void HeldBase::press(double height_m) {
  lift();
  step(std::min(height_m, tables().figures.z_jtc.si));
  step(height_m);
}

void HeldBase::step(double height_m) {
  const physics::TipResponse response =
      std::visit([height_m](auto& model) { return model.step(physics::Length(height_m)); }, model_);
  force_n_ = response.force.si;
  touches_ = response.phase == physics::Phase::Attached;
}

}  // namespace afm::instrument
