// SPDX-License-Identifier: Apache-2.0
#include "physics/dynamic_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "physics/dynamic_law.h"
#include "physics/law_tables.h"

namespace afm::physics {
namespace {

using namespace literals;

// Largest force on a lever before the surface counts as a spring: ten times its adhesion, or without adhesion 0.1 um of
// bending. Impacts reach some six times the adhesion.
Force largest_load(const ContactParameters& contact, const CycleFigures& figures) {
  return std::max(10.0 * abs(figures.force_before_joc), contact.spring_constant * 100_nm);
}

constexpr Length kLargestDeflection = 0.1_mm;

}  // namespace

std::shared_ptr<const DynamicModel::Setup> DynamicModel::build(Law law, const ContactParameters& contact,
                                                               const LeverDynamics& lever, const LawOptions& options,
                                                               std::uint64_t seed) {
  const auto grips = fixed_grips_tables(law, contact, options);
  validate(lever);

  Setup setup;
  setup.law = law;
  setup.contact = contact;
  setup.lever = lever;
  setup.seed = seed;
  const auto resting = build_law_tables(law, contact, options);
  setup.figures = resting->figures;
  setup.contact_gap = resting->contact_gap;
  setup.surface = std::make_shared<const TipForce>(*grips, largest_load(contact, setup.figures));
  setup.free_above = std::max(
      {setup.surface->release_height(), setup.figures.tip_height_before_jtc, setup.figures.tip_height_before_joc});
  return std::make_shared<const Setup>(setup);
}

DynamicModel::Pace DynamicModel::pace_of(const Setup& setup, Time step_lasts, std::int64_t most_sub_steps) {
  // written so that NaN fails
  if (!(step_lasts > Time() && isfinite(step_lasts))) {
    throw std::invalid_argument("a step of " + std::to_string(step_lasts.si) + " s has no length");
  }
  const Time longest = TipOscillator::longest_sub_step(*setup.surface, setup.contact.spring_constant, setup.lever);
  const double needed = std::ceil(step_lasts / longest);
  if (needed <= static_cast<double>(most_sub_steps)) {
    return {step_lasts, step_lasts, static_cast<std::int64_t>(needed)};
  }
  return {step_lasts, longest * static_cast<double>(most_sub_steps), most_sub_steps};
}

DynamicModel::DynamicModel(std::shared_ptr<const Setup> setup, const Pace& pace)
    : setup_(std::move(setup)),
      pace_(pace),
      oscillator_(setup_->surface, setup_->contact.spring_constant, setup_->lever, sub_step(), setup_->seed) {}

DynamicModel::DynamicModel(Law law, const ContactParameters& contact, const LeverDynamics& lever, Time tick_period,
                           const LawOptions& options, std::uint64_t seed)
    : DynamicModel(build(law, contact, lever, options, seed), tick_period) {}

DynamicModel::DynamicModel(const std::shared_ptr<const Setup>& setup, Time tick_period)
    : DynamicModel(setup, pace_of(*setup, tick_period, kSubSteps)) {}

DynamicModel DynamicModel::simulating(Time per_step) const {
  return DynamicModel(setup_, pace_of(*setup_, per_step, kLongestStep));
}

void DynamicModel::settle(Length z, Velocity base_velocity) noexcept {
  oscillator_.settle(z, base_velocity);
  phase_ = Phase::Free;
  jump_began_ = now();
}

void DynamicModel::wait_for_lift() noexcept {
  oscillator_.restart_noise(setup_->seed);
  phase_ = Phase::WaitForLift;
}

DynamicModel::Instant DynamicModel::now() const noexcept {
  return {oscillator_.base(), oscillator_.height(), setup_->contact.spring_constant * oscillator_.deflection()};
}

DynamicModel::Jump DynamicModel::awaited_jump() const noexcept {
  const CycleFigures& figures = setup_->figures;
  if (phase_ == Phase::Free) return {figures.tip_height_before_jtc, setup_->surface->contact_height()};
  return {figures.tip_height_before_joc, setup_->free_above};
}

// Point on the straight line between two instants at which the tip passes `height`.
DynamicModel::Instant DynamicModel::where(Length height, const Instant& before, const Instant& after) noexcept {
  const double share = (height - before.tip_height) / (after.tip_height - before.tip_height);
  return {before.z + share * (after.z - before.z), height, before.force + share * (after.force - before.force)};
}

void DynamicModel::watch(const Instant& before, const Instant& after, double fraction, TipResponse& response) noexcept {
  const bool to_contact = phase_ == Phase::Free;
  const auto [begin, end] = awaited_jump();
  const auto passes = [&](Length height) {
    return to_contact ? before.tip_height > height && after.tip_height <= height
                      : before.tip_height <= height && after.tip_height > height;
  };
  if (passes(begin)) jump_began_ = where(begin, before, after);
  if (!passes(end)) return;

  phase_ = to_contact ? Phase::Attached : Phase::Free;
  const Instant ended = where(end, before, after);
  if (setup_->figures.hysteretic && response.event_count < response.events.size()) {
    response.events[response.event_count++] = {to_contact ? EventKind::JumpToContact : EventKind::JumpOffContact,
                                               jump_began_.z, jump_began_.force, ended.force, fraction};
  }
  jump_began_ = ended;
}

TipResponse DynamicModel::step(Length z) noexcept {
  TipResponse response;
  if (!isfinite(z)) {
    wait_for_lift();
    return response;
  }
  if (phase_ == Phase::WaitForLift) {
    response.tip_height = z;
    if (z <= setup_->figures.z_joc) return response;
    settle(z);
  }

  oscillator_.move_base((z - oscillator_.base()) / pace_.simulated);
  Length sum;
  Jump jump = awaited_jump();
  for (std::int64_t i = 0; i < pace_.sub_steps; ++i) {
    const Instant before = now();
    oscillator_.sub_step();
    sum = sum + oscillator_.deflection();
    const Length height = oscillator_.height();
    const bool passed = (before.tip_height > jump.begin) != (height > jump.begin) ||
                        (before.tip_height > jump.end) != (height > jump.end);
    if (passed) [[unlikely]] {
      watch(before, now(), static_cast<double>(i + 1) / static_cast<double>(pace_.sub_steps), response);
      jump = awaited_jump();
    }
  }

  const Length mean = sum / static_cast<double>(pace_.sub_steps);
  // written so that NaN fails
  if (!(abs(mean) <= kLargestDeflection)) {
    wait_for_lift();
    return {};
  }
  response.phase = phase_;
  response.force = setup_->contact.spring_constant * mean;
  response.tip_height = z + mean;
  response.cantilever_deflection = -mean;
  response.sample_deformation = phase_ == Phase::Attached ? response.tip_height - setup_->contact_gap
                                                          : -(response.force / setup_->contact.sample_stiffness);
  return response;
}

}  // namespace afm::physics
