// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/scan_loop.h"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "physics/tapping/driven_lever.h"

namespace afm::physics {

ScanLoop::ScanLoop(const ScanSettings& settings, Time tick, std::uint64_t seed, std::optional<TappingDetector> tapping)
    : normal_(seed), tapping_(std::move(tapping)) {
  change(settings, tick);
  engage(0.0);
}

void ScanLoop::change(const ScanSettings& settings, Time tick) {
  validate(settings);
  tick_s_ = tick.si;
  spring_ = settings.spring_constant.si;
  setpoint_m_ = settings.setpoint.si / spring_;
  held_gap_m_ = -setpoint_m_;
  if (tapping_) {
    spring_ = 1.0;
    setpoint_m_ = tapping_->lever().free_amplitude.si - tapping_->setpoint_m();
    held_gap_m_ = tapping_->engaged_gap_m();
    angle_of_tick_ = tapping_->lever().angular_resonance() * tick_s_;
  }
  pull_off_m_ = settings.adhesion.si / settings.spring_constant.si;
  snap_in_m_ = settings.snap_in.si;
  integral_ = settings.integral_gain.si * tick_s_;
  proportional_ = settings.proportional_gain;
  // white noise of one-sided density S has the variance S/(2 dt) when it is sampled every dt
  noise_of_tick_m_ = settings.noise.si / std::sqrt(2.0 * tick_s_ * kNoiseBandwidth.si);
  reach_m_ = 0.5 * settings.z_range.si;
  feedback_ = settings.feedback == Feedback::On;
  delay_ticks_ = static_cast<std::size_t>(
      std::clamp(std::round(settings.detector_delay.si / tick_s_), 0.0, static_cast<double>(kMostDelayTicks)));

  resonant_ = settings.z_resonance.si > 0.0;
  if (resonant_) set_swing(settings);
  find_limit();
}

void ScanLoop::drive(const DrivenLever& lever, Length setpoint) {
  tapping_->drive(lever, setpoint);
  setpoint_m_ = tapping_->free_amplitude_m() - tapping_->setpoint_m();
  held_gap_m_ = tapping_->engaged_gap_m();
}

void ScanLoop::set_swing(const ScanSettings& settings) noexcept {
  const double w0 = 2.0 * std::numbers::pi * settings.z_resonance.si, damping = 0.5 * w0 / settings.z_quality_factor;
  const std::complex<double> rate = std::sqrt(std::complex<double>(damping * damping - w0 * w0));
  const double decay = std::exp(-damping * tick_s_);
  const double c = decay * std::cosh(rate * tick_s_).real();
  const double s = decay * (rate == 0.0 ? tick_s_ : (std::sinh(rate * tick_s_) / rate).real());
  swing_ = {.zz = c + damping * s, .zv = s, .vz = -w0 * w0 * s, .vv = c - damping * s};
}

// The loop oscillates with z = exp(i theta) per tick if (z - 1) + (Kp (1 - 1/z) + g) z^-delay G(z) = 0, g = Ki dt and G
// the response of the z scanner to its command. In tapping mode G includes the envelope: of one relaxation, on a slope
// of one.
void ScanLoop::find_limit() {
  const auto gain_at = [this](double theta) {
    const std::complex<double> z = std::polar(1.0, theta);
    std::complex<double> scanner = 1.0;
    if (resonant_) {
      const double cross = swing_.zv * swing_.vz;
      scanner = z * ((1.0 - swing_.zz) * (z - swing_.vv) - cross) / ((z - swing_.zz) * (z - swing_.vv) - cross);
    }
    if (tapping_) {
      const double kept = std::exp(-tick_s_ / tapping_->lever().relaxation().si);
      scanner *= (1.0 - kept) / (1.0 - kept / z);
    }
    const std::complex<double> delay = std::polar(1.0, theta * static_cast<double>(delay_ticks_));
    return -((z - 1.0) * delay / scanner + proportional_ * (1.0 - 1.0 / z));
  };
  constexpr double kSlowest = 1e-6, kStep = 1.01, kFastest = std::numbers::pi * (1.0 - 1e-9);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  // at half the tick rate the gain is real
  const double fastest = gain_at(std::numbers::pi).real();
  double smallest = fastest > 0.0 ? fastest : kNone, turn_of_tick = std::numbers::pi;
  bool before = gain_at(kSlowest).imag() < 0.0;
  for (double theta = kSlowest; theta < kFastest; theta *= kStep) {
    double low = theta, high = std::min(theta * kStep, kFastest);
    const bool after = gain_at(high).imag() < 0.0;
    if (std::exchange(before, after) == after) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (after != (gain_at(middle).imag() < 0.0) ? low : high) = middle;
    }
    if (const double gain = gain_at(low).real(); gain > 0.0 && gain < smallest) {
      smallest = gain;
      turn_of_tick = low;
    }
  }
  largest_gain_ = Frequency(smallest == kNone ? 0.0 : smallest / tick_s_);
  ringing_period_ticks_ = 2.0 * std::numbers::pi / turn_of_tick;
}

void ScanLoop::engage(double height_m) noexcept {
  command(height_m + held_gap_m_);
  z_m_ = command_m_;
  velocity_ = 0.0;
  touching_ = true;
  if (tapping_) tapping_->engage();
  deflection_m_ = tapping_ ? setpoint_m_ : height_m - z_m_;
  error_m_ = deflection_m_ - setpoint_m_;
  noise_now_m_ = 0.0;
  detected_m_.fill(deflection_m_);
}

}  // namespace afm::physics
