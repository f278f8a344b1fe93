// SPDX-License-Identifier: Apache-2.0
#include "physics/tip_oscillator.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace afm::physics {
namespace {

double angular_frequency(const LeverDynamics& lever) { return 2.0 * std::numbers::pi * lever.resonance.si; }

}  // namespace

Time TipOscillator::longest_sub_step(const TipForce& force, Stiffness spring_constant,
                                     const LeverDynamics& lever) noexcept {
  const double w0 = angular_frequency(lever);
  const double in_contact = w0 * std::sqrt(1.0 + force.stiffness() / spring_constant);
  return Time(std::min(0.25 / in_contact, 0.05 / w0));
}

TipOscillator::TipOscillator(std::shared_ptr<const TipForce> force, Stiffness spring_constant,
                             const LeverDynamics& lever, Time sub_step, std::uint64_t seed)
    : surface_(std::move(force)), normal_(seed), spring_constant_(spring_constant.si), sub_step_(sub_step.si) {
  const double w0 = angular_frequency(lever);
  const double mass = spring_constant_ / (w0 * w0);
  const double decay = w0 * sub_step_ / lever.quality_factor;
  kick_ = std::tan(0.5 * w0 * sub_step_) / (mass * w0);
  damping_ = std::exp(-decay);
  noise_ = std::sqrt(-std::expm1(-2.0 * decay) * thermal_energy(lever.temperature).si / mass);

  const double cosine = std::cos(0.5 * w0 * sub_step_), sine = std::sin(0.5 * w0 * sub_step_);
  const double both = (1.0 + damping_) * sine * cosine;
  swing_ = {.xx = cosine * cosine - damping_ * sine * sine,
            .xv = both / w0,
            .xp = sine / w0,
            .vx = -both * w0,
            .vv = damping_ * cosine * cosine - sine * sine,
            .vp = cosine};
}

void TipOscillator::place(Length base, Length height, Velocity velocity) noexcept {
  base_ = base.si;
  deflection_ = (height - base).si;
  swing_velocity_ = velocity.si - base_velocity_;
  attached_ = false;
  force_ = (*surface_)(height, attached_).si;
}

void TipOscillator::settle(Length base, Velocity base_velocity) noexcept {
  constexpr int kLongestSearch = 50;
  constexpr Length kDifference(1e-12);

  // Newton's method on F(z) + k (Z - z) descends from Z to the upper equilibrium, since the attraction steepens towards
  // the sample
  Length height = base;
  double softening = 0.0;  // softening of the lever by the surface, F'/k
  bool attached = false;
  for (int i = 0; i < kLongestSearch; ++i) {
    const Force force = (*surface_)(height, attached);
    softening = ((*surface_)(height + kDifference, attached) - force).si / kDifference.si / spring_constant_;
    if (attached || softening >= 1.0) break;
    const double missing = force.si / spring_constant_ + (base - height).si;
    height = height + Length(missing / (1.0 - softening));
    if (std::abs(missing) < 1e-18) break;
  }
  move_base(base_velocity);
  place(base, height, base_velocity / (1.0 - std::min(softening, 0.5)));
}

}  // namespace afm::physics
