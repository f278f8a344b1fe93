// SPDX-License-Identifier: Apache-2.0
#include "haptics/felt_friction.h"

#include <algorithm>
#include <utility>

namespace afm::haptics {

namespace {

constexpr double kSlopeWayM = 1e-12;  // step in Z of a derivative, far below the motion in a tick

physics::Sideways<physics::Length> place_of(const glm::dvec2& xy_m) {
  return {physics::Length(xy_m.x), physics::Length(xy_m.y)};
}

// Strongest pull of the attached branch, from Z_joc down.
physics::Force strongest_adhesion(const physics::LawTables& tables) {
  physics::Force strongest = -tables.figures.force_before_joc;
  const double radius_m = tables.contact.tip_radius.si;
  for (double way_m = 1e-13; way_m < radius_m; way_m *= 1.02) {
    strongest = std::max(strongest, -tables.attached.force(tables.figures.z_joc - physics::Length(way_m)));
  }
  return std::max(physics::Force(), strongest);
}

}  // namespace

FeltFriction::FeltFriction(const scene::SharedContact& material, std::shared_ptr<const physics::LawTables> tables,
                           const DeviceSpec& device)
    : tables_(std::move(tables)),
      adhesion_(strongest_adhesion(*tables_)),
      contact_(material.friction, material.law, material.contact, adhesion_),
      largest_stiffness_n_per_m_(kShareOfStiffness *
                                 std::min(Scaling::kMaxStiffnessNPerM, device.max_stiffness_n_per_m)),
      is_lattice_(material.friction.law == physics::FrictionLaw::Lattice) {}

physics::Force FeltFriction::load(double z_m) const noexcept {
  return std::max(physics::Force(), tables_->attached.force(physics::Length(z_m)) + adhesion_);
}

double FeltFriction::load_slope_n_per_m(double z_m) const noexcept {
  return 0.5 * (load(z_m + kSlopeWayM) - load(z_m - kSlopeWayM)).si / kSlopeWayM;
}

double FeltFriction::gain(const Scaling& scaling) const noexcept {
  return std::min(scaling.hand_n_per_n(),
                  largest_stiffness_n_per_m_ * scaling.lateral_m_per_m() / contact_.stiffness().si);
}

FeltFriction::Step FeltFriction::step(const glm::dvec2& xy_m, const Pressed& pressed, const SampleSurface::Place& below,
                                      const physics::TipResponse& response, const Scaling& scaling) noexcept {
  Step step;
  const glm::dvec2 from_m = std::exchange(before_m_, xy_m);
  if (response.phase != physics::Phase::Attached) {
    contact_.lift();
    return step;
  }
  const double energy_scale = gain(scaling) * scaling.lateral_m_per_m();
  const physics::Force borne = is_lattice_ ? physics::Force() : physics::Force(pressed.borne_n);
  const physics::Force rubs = std::max(physics::Force(), load(pressed.z_m) - borne);
  if (!contact_.touching()) {
    // point of the jump to contact, or the current point if contact began without a jump
    const double share = response.event_count > 0 ? response.events[response.event_count - 1].fraction : 1.0;
    const auto landed = contact_.touch_down(place_of(from_m + share * (xy_m - from_m)), rubs);
    step.given_j = energy_scale * landed.given.si;
  }
  step.events = contact_.slide_to(place_of(xy_m), rubs);
  step.given_j += energy_scale * step.events.given.si;
  step.lateral = contact_.force();

  const double rise_n =
      energy_scale * contact_.lift_per_load().si * load_slope_n_per_m(pressed.z_m) / scaling.hand_m_per_m();
  const glm::dvec3 gradient(-below.slope * scaling.flattening(), 1.0);
  step.hand_force_n = gain(scaling) * glm::dvec3(step.lateral.x.si, step.lateral.y.si, 0.0) - rise_n * gradient;
  return step;
}

double FeltFriction::stored_j(const Scaling& scaling) const noexcept {
  return gain(scaling) * scaling.lateral_m_per_m() * contact_.stored().si;
}

double FeltFriction::stiffness_n_per_m(const Scaling& scaling) const noexcept {
  return gain(scaling) * contact_.stiffness().si / scaling.lateral_m_per_m();
}

}  // namespace afm::haptics
