// SPDX-License-Identifier: Apache-2.0
#include "physics/tapping/tapping_oscillator.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace afm::physics {
namespace {

Length amplitude_of(double cosine, double sine, double steps) { return Length(2.0 / steps * std::hypot(cosine, sine)); }

DirectSwing mean_of(const DirectSwing& sum, const DirectSwing& last, double count) {
  DirectSwing mean = sum;
  mean.state = last.state;
  mean.deflection = sum.deflection / count;
  mean.averages.mean = sum.averages.mean / count;
  mean.averages.virial = sum.averages.virial / count;
  mean.averages.lost = sum.averages.lost / count;
  mean.averages.contact_share = sum.averages.contact_share / count;
  mean.full_virial = sum.full_virial / count;
  mean.mean_square = sum.mean_square / count;
  mean.mean_square_velocity_si = sum.mean_square_velocity_si / count;
  for (Length& harmonic : mean.harmonics) harmonic = harmonic / count;
  return mean;
}

void add(DirectSwing& sum, const DirectSwing& one) {
  sum.deflection = sum.deflection + one.deflection;
  sum.averages.mean = sum.averages.mean + one.averages.mean;
  sum.averages.virial = sum.averages.virial + one.averages.virial;
  sum.averages.lost = sum.averages.lost + one.averages.lost;
  sum.averages.contact_share += one.averages.contact_share;
  sum.averages.peak = std::max(sum.averages.peak, one.averages.peak);
  sum.averages.lowest = std::min(sum.averages.lowest, one.averages.lowest);
  sum.full_virial = sum.full_virial + one.full_virial;
  sum.mean_square = sum.mean_square + one.mean_square;
  sum.mean_square_velocity_si += one.mean_square_velocity_si;
  for (std::size_t n = 0; n < sum.harmonics.size(); ++n) sum.harmonics[n] = sum.harmonics[n] + one.harmonics[n];
}

}  // namespace

RestingTap resting_tap(const DirectSwing& swing) noexcept {
  constexpr double kRepeats = 1e-3;
  RestingTap tap{.state = swing.state,
                 .deflection = swing.deflection,
                 .averages = swing.averages,
                 .stable = swing.change < kRepeats};
  if (tap.state.phase < 0.0) tap.state.phase += 2.0 * std::numbers::pi;
  return tap;
}

struct TappingOscillator::Sums {
  // at even distances
  double x = 0, x2 = 0, v2 = 0;
  std::array<double, 6> cosine{}, sine{};
  // weighted by the steps
  double force = 0, force_x = 0, force_cos = 0, force_sin = 0, contact = 0;
  double work = 0, peak = -1e30, lowest = 1e30;
};

TappingOscillator::Pace TappingOscillator::pace(double steps_a_swing) const {
  const double w0 = lever_.angular_resonance();
  const double angle = 2.0 * std::numbers::pi / (lever_.ratio * steps_a_swing);  // angle w0 dt of a step
  const double damping = std::exp(-angle / lever_.quality_factor);
  const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
  return {.kick = std::tan(0.5 * angle) / (mass_ * w0),
          .xx = c * c - damping * s * s,
          .xv = (1.0 + damping) * s * c / w0,
          .vx = -(1.0 + damping) * s * c * w0,
          .vv = damping * c * c - s * s,
          .weight = 0.5 / steps_a_swing,
          .rise = 0.0};
}

TappingOscillator::TappingOscillator(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                                     int least_steps)
    : surface_(surface), force_at_(surface->tip_force(lever.free_amplitude)), lever_(lever) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kNear = 1.0 / 6.0;
  const double w0 = lever.angular_resonance(), k = lever.spring_constant.si;
  // the sample as a spring: 25 fine steps an oscillation in contact
  const double in_contact = std::sqrt(1.0 + force_at_->stiffness().si / k) / lever.ratio;
  steps_ = std::max(static_cast<std::size_t>(least_steps),
                    static_cast<std::size_t>(std::ceil(2.0 * kPi * in_contact / 0.25 / kFineSteps)));
  const std::size_t count = steps_ * kFineSteps;
  for (std::size_t j = 0; j < count; ++j) {
    const double angle = 2.0 * kPi * static_cast<double>(j) / static_cast<double>(count);
    cosine_.push_back(std::cos(angle));
    sine_.push_back(std::sin(angle));
    free_x_.push_back(lever.free_amplitude.si * std::cos(angle - lever.free_phase));
    free_v_.push_back(-lever.angular_drive() * lever.free_amplitude.si * std::sin(angle - lever.free_phase));
  }
  mass_ = k / (w0 * w0);
  near_ = std::max(surface->contact_height(), surface->release_height()).si + kNear * lever.free_amplitude.si;
  coarse_ = pace(static_cast<double>(steps_));
  fine_ = pace(static_cast<double>(count));
}

void TappingOscillator::move_base(Length per_swing) noexcept {
  coarse_.rise = per_swing.si / static_cast<double>(steps_);
  fine_.rise = coarse_.rise / kFineSteps;
}

void TappingOscillator::place(Length z, const TapState& state) noexcept {
  base_ = z.si;
  y_ = state.amplitude.si * std::cos(state.phase) - free_x_.front();
  v_ = lever_.angular_drive() * state.amplitude.si * std::sin(state.phase) - free_v_.front();
  attached_ = false;
  const Length height(base_ + free_x_.front() + y_);
  force_ = (*force_at_)(height, attached_).si;
  friction_ = surface_->friction_si(height);
}

template <bool Measured>
void TappingOscillator::half_kick(const Pace& pace, std::size_t at, Sums& sums) noexcept {
  const double free_velocity = free_v_[at], before = free_velocity + v_;
  const double drag = 0.5 * pace.kick * friction_;
  const double after =
      drag == 0.0 ? before + pace.kick * force_ : (before * (1.0 - drag) + pace.kick * force_) / (1.0 + drag);
  v_ = after - free_velocity;
  if constexpr (Measured) {
    const double x = free_x_[at] + y_, height = base_ + x;
    const double force = force_ - friction_ * 0.5 * (before + after);
    const double weighted = pace.weight * force;
    sums.force += weighted;
    sums.force_x += weighted * x;
    sums.force_cos += weighted * cosine_[at];
    sums.force_sin += weighted * sine_[at];
    sums.work += 0.5 * mass_ * (after - before) * (after + before);
    sums.peak = std::max(sums.peak, force);
    sums.lowest = std::min(sums.lowest, height);
    if (attached_ || height < surface_->zero_of_indentation().si) sums.contact += pace.weight;
  }
}

template <bool Measured>
void TappingOscillator::step(const Pace& pace, std::size_t from, std::size_t to, Sums& sums) noexcept {
  half_kick<Measured>(pace, from, sums);
  const double y = pace.xx * y_ + pace.xv * v_;
  v_ = pace.vx * y_ + pace.vv * v_;
  y_ = y;
  base_ += pace.rise;
  const Length height(base_ + free_x_[to] + y_);
  force_ = (*force_at_)(height, attached_).si;
  if (surface_->viscous()) friction_ = surface_->friction_si(height);
  half_kick<Measured>(pace, to, sums);
}

bool TappingOscillator::near_sample(std::size_t from, std::size_t to) const noexcept {
  const double next = coarse_.xx * y_ + coarse_.xv * v_;
  return attached_ || base_ + std::min(free_x_[from] + y_, free_x_[to] + next) < near_;
}

template <bool Measured>
void TappingOscillator::one_swing(Sums& sums) noexcept {
  const std::size_t count = steps_ * kFineSteps;
  for (std::size_t from = 0; from < count; from += kFineSteps) {
    const std::size_t to = from + kFineSteps == count ? 0 : from + kFineSteps;
    if constexpr (Measured) {
      const double x = free_x_[from] + y_, v = free_v_[from] + v_;
      sums.x += x;
      sums.x2 += x * x;
      sums.v2 += v * v;
      std::size_t angle = from;
      for (std::size_t n = 1; n < sums.cosine.size(); ++n) {
        sums.cosine[n] += x * cosine_[angle];
        sums.sine[n] += x * sine_[angle];
        angle += from;
        if (angle >= count) angle -= count;
      }
    }
    if (!near_sample(from, to)) {
      step<Measured>(coarse_, from, to, sums);
      continue;
    }
    for (std::size_t at = from; at < from + kFineSteps; ++at) {
      step<Measured>(fine_, at, at + 1 == count ? 0 : at + 1, sums);
    }
  }
}

DirectSwing TappingOscillator::swing() noexcept {
  Sums sums;
  one_swing<true>(sums);
  const auto n = static_cast<double>(steps_);
  DirectSwing result;
  result.state = {amplitude_of(sums.cosine[1], sums.sine[1], n), std::atan2(sums.sine[1], sums.cosine[1])};
  result.deflection = Length(sums.x / n);
  const double amplitude = result.state.amplitude.si, phase = result.state.phase;
  result.averages.mean = Force(sums.force);
  result.averages.virial = Energy(amplitude * (sums.force_cos * std::cos(phase) + sums.force_sin * std::sin(phase)));
  result.averages.lost = Energy(-sums.work);
  result.averages.peak = Force(sums.peak);
  result.averages.lowest = Length(sums.lowest);
  result.averages.contact_share = sums.contact;
  result.full_virial = Energy(sums.force_x);
  result.mean_square = Area(sums.x2 / n);
  result.mean_square_velocity_si = sums.v2 / n;
  result.harmonics[0] = abs(result.deflection);
  for (std::size_t m = 1; m < result.harmonics.size(); ++m) {
    result.harmonics[m] = amplitude_of(sums.cosine[m], sums.sine[m], n);
  }
  return result;
}

TapState TappingOscillator::advance(int swings) noexcept {
  Sums none;
  for (int i = 0; i < swings; ++i) one_swing<false>(none);
  const double x = free_x_.front() + y_, v = (free_v_.front() + v_) / lever_.angular_drive();
  return {Length(std::hypot(x, v)), std::atan2(v, x)};
}

DirectSwing TappingOscillator::settle(double settled) noexcept {
  constexpr int kBetweenChecks = 50, kAveraged = 16;
  move_base(Length());
  Sums none;
  const auto most = static_cast<long>(std::ceil(8.0 * lever_.quality_factor)) + kBetweenChecks;
  Length before;
  for (long i = 1; i <= most; ++i) {
    one_swing<false>(none);
    if (i % kBetweenChecks != 0) continue;
    const DirectSwing last = swing();
    if (abs(last.state.amplitude - before) < settled * lever_.free_amplitude) break;
    before = last.state.amplitude;
  }
  const auto point = [](const TapState& at) { return std::polar(at.amplitude.si, at.phase); };
  DirectSwing sum = swing(), last = sum;
  double change = 0.0;
  for (int i = 1; i < kAveraged; ++i) {
    const TapState previous = last.state;
    add(sum, last = swing());
    change = std::max(change, std::abs(point(last.state) - point(previous)));
  }
  DirectSwing mean = mean_of(sum, last, kAveraged);
  mean.change = change / lever_.free_amplitude.si;
  return mean;
}

}  // namespace afm::physics
