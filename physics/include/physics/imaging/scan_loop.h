// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "physics/imaging/scan_settings.h"
#include "physics/imaging/tapping_detector.h"
#include "physics/normal_generator.h"
#include "physics/units.h"

namespace afm::physics {

// Lever, controller and z scanner of a microscope in static contact or tapping mode, tick by tick of the controller.
//
//   lever       d = h - z while the tip touches; it leaves at d < -F_ad/k and touches again at a gap of snap_in; free:
//               d = 0. h is the height traced by the apex, z the height of the unbent lever's apex.
//   detector    d_m = d + white noise, `detector_delay` ago
//   controller  e = d_m - setpoint/k, u <- u + Kp (e - e of the previous tick) + Ki dt e: velocity-form PI, which
//               prevents integral windup at an end of the z range
//   z scanner   z'' + (w0/Q) z' + w0^2 z = w0^2 u, exact for a command that is constant for a tick; z = u without
//               resonance
//
// In tapping mode d is A0 - A, the loss of amplitude, d_set that of the setpoint, and `settings.setpoint` unused: the
// error cannot exceed A0 - A_set in flight. force_n() is then d in metres, and the tip "touches" where it has lost a
// tenth of d_set.
//
// - On a rigid contact and without Kp the loop is z' = (d - d_set)/tau, tau = 1/Ki, to first order in dt/tau.
// - The same seed, settings and heights give the same path, bit for bit.
//
// One thread. tick() neither allocates nor throws.
class ScanLoop {
 public:
  static constexpr std::size_t kMostDelayTicks = 64;

  // Starts engaged on z = 0. Throws UnphysicalValue as validate() does.
  ScanLoop(const ScanSettings& settings, Time tick, std::uint64_t seed,
           std::optional<TappingDetector> tapping = std::nullopt);

  // Takes effect from the next tick on; the motion continues. Throws as the constructor does, without any change.
  void change(const ScanSettings& settings, Time tick);

  // In tapping mode: another drive of the same lever, and another amplitude to keep, from the next tick on. Throws as
  // TappingDetector::drive().
  void drive(const DrivenLever& lever, Length setpoint);

  // Puts the tip on the surface with the force of the setpoint, at rest.
  void engage(double height_m) noexcept;

  // Commanded position of the z scanner, clamped to its range. With the feedback off, a hand may be the controller.
  void command(double z_m) noexcept { command_m_ = std::clamp(z_m, -reach_m_, reach_m_); }

  // Moves the z scanner for one tick, then measures the surface below the apex and sets the next command.
  void tick(double height_m) noexcept {
    follow_command();
    const double gap_m = z_m_ - height_m;
    if (tapping_) {
      tapping_->advance(gap_m, angle_of_tick_);
      deflection_m_ = tapping_->free_amplitude_m() - tapping_->amplitude_m();
      touching_ = deflection_m_ > kLeastLoss * setpoint_m_;
    } else {
      touching_ = gap_m <= (touching_ ? pull_off_m_ : snap_in_m_);
      deflection_m_ = touching_ ? -gap_m : 0.0;
    }
    noise_now_m_ = noise_of_tick_m_ > 0.0 ? noise_of_tick_m_ * normal_() : 0.0;
    const double error_m = delayed(deflection_m_ + noise_now_m_) - setpoint_m_;
    if (feedback_) command(command_m_ + proportional_ * (error_m - error_m_) + integral_ * error_m);
    error_m_ = error_m;
  }

  // The integral gain at which the loop, in contact, begins to oscillate, given its ticks, delay, proportional gain and
  // z resonance. Without delay Ki dt = 2 (1 - Kp) for an ideal z scanner (Jury), and Ki = (1 + Kp) w0/Q for slow ones.
  // Zero if the proportional gain by itself is too large.
  Frequency largest_integral_gain() const noexcept { return largest_gain_; }
  // The period in which it then oscillates, in ticks: at least two.
  double ringing_period_ticks() const noexcept { return ringing_period_ticks_; }

  double z_m() const noexcept { return z_m_; }
  double deflection_m() const noexcept { return deflection_m_; }       // deflection of the lever, without noise
  double force_n() const noexcept { return spring_ * deflection_m_; }  // lever force; negative: it holds the tip back
  double noise_m() const noexcept { return noise_now_m_; }             // detection noise in this tick
  double setpoint_m() const noexcept { return setpoint_m_; }
  double topography_m() const noexcept { return z_m_ - held_gap_m_; }  // recorded height
  bool touching() const noexcept { return touching_; }
  double per_metre() const noexcept { return spring_; }  // unit of the error per metre: k, or 1 in tapping mode
  const TappingDetector* tapping() const noexcept { return tapping_ ? &*tapping_ : nullptr; }  // null: contact mode

 private:
  static constexpr double kLeastLoss = 0.1;  // share of the loss of amplitude at the setpoint

  void set_swing(const ScanSettings& settings) noexcept;
  void find_limit();
  void follow_command() noexcept {
    if (!resonant_) {
      z_m_ = command_m_;
      return;
    }
    const double away_m = z_m_ - command_m_;
    z_m_ = command_m_ + swing_.zz * away_m + swing_.zv * velocity_;
    velocity_ = swing_.vz * away_m + swing_.vv * velocity_;
  }

  double delayed(double detected_m) noexcept {
    if (delay_ticks_ == 0) return detected_m;
    newest_ = (newest_ + 1) % detected_m_.size();
    detected_m_[newest_] = detected_m;
    return detected_m_[(newest_ + detected_m_.size() - delay_ticks_) % detected_m_.size()];
  }

  double tick_s_ = 0, spring_ = 0, setpoint_m_ = 0, held_gap_m_ = 0, pull_off_m_ = 0, snap_in_m_ = 0;
  double integral_ = 0, proportional_ = 0;  // gains per tick
  double noise_of_tick_m_ = 0, angle_of_tick_ = 0;
  double reach_m_ = 0;
  Frequency largest_gain_;
  double ringing_period_ticks_ = 2.0;
  bool feedback_ = true, resonant_ = false;
  std::size_t delay_ticks_ = 0;
  // z - u and z' after a tick, as functions of those before it
  struct Swing {
    double zz = 0, zv = 0, vz = 0, vv = 0;
  } swing_;

  double command_m_ = 0, z_m_ = 0, velocity_ = 0;
  double deflection_m_ = 0, error_m_ = 0, noise_now_m_ = 0;
  bool touching_ = true;
  std::array<double, kMostDelayTicks + 1> detected_m_{};
  std::size_t newest_ = 0;
  NormalGenerator normal_;
  std::optional<TappingDetector> tapping_;
};

}  // namespace afm::physics
