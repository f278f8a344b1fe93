// SPDX-License-Identifier: Apache-2.0
#include "physics/scan_loop.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace afm::physics {

ScanLoop::ScanLoop(const ScanSettings& settings, Time tick, std::uint64_t seed) : normal_(seed) {
  change(settings, tick);
  engage(0.0);
}

void ScanLoop::change(const ScanSettings& settings, Time tick) {
  validate(settings);
  spring_ = settings.spring_constant.si;
  setpoint_m_ = settings.setpoint.si / spring_;
  pull_off_m_ = settings.adhesion.si / spring_;
  snap_in_m_ = settings.snap_in.si;
  integral_ = settings.integral_gain.si * tick.si;
  proportional_ = settings.proportional_gain;
  // white noise of one-sided density S has the variance S/(2 dt) when it is sampled every dt
  noise_of_tick_m_ = settings.noise.si / std::sqrt(2.0 * tick.si * kNoiseBandwidth.si);
  reach_m_ = 0.5 * settings.z_range.si;
  feedback_ = settings.feedback == Feedback::On;
  delay_ticks_ = static_cast<std::size_t>(
      std::clamp(std::round(settings.detector_delay.si / tick.si), 0.0, static_cast<double>(kMostDelayTicks)));

  resonant_ = settings.z_resonance.si > 0.0;
  if (!resonant_) return;
  const double w0 = 2.0 * std::numbers::pi * settings.z_resonance.si, damping = 0.5 * w0 / settings.z_quality_factor;
  const std::complex<double> rate = std::sqrt(std::complex<double>(damping * damping - w0 * w0));
  const double decay = std::exp(-damping * tick.si);
  const double c = decay * std::cosh(rate * tick.si).real();
  const double s = decay * (rate == 0.0 ? tick.si : (std::sinh(rate * tick.si) / rate).real());
  swing_ = {.zz = c + damping * s, .zv = s, .vz = -w0 * w0 * s, .vv = c - damping * s};
}

void ScanLoop::engage(double height_m) noexcept {
  command(height_m - setpoint_m_);
  z_m_ = command_m_;
  velocity_ = 0.0;
  touching_ = true;
  deflection_m_ = height_m - z_m_;
  error_m_ = deflection_m_ - setpoint_m_;
  noise_now_m_ = 0.0;
  detected_m_.fill(deflection_m_);
}

}  // namespace afm::physics
