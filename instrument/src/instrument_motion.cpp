// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "instrument/simulated_instrument.h"

namespace afm::instrument {
namespace {

constexpr double kFalseAboveM = 100e-9;                   // highest false engagement above the sample
constexpr double kStepM = 1e-9, kMostStepsOfAPath = 1e4;  // step and largest number of steps of a dragged tip's path

}  // namespace

// Base held without feedback under the current settings; null if no law exists for them.
HeldBase* SimulatedInstrument::base() {
  if (!base_) {
    auto made = HeldBase::create(setup_);
    if (!made) return nullptr;
    base_ = std::move(*made);
  }
  return &*base_;
}

// Ends the feedback; the base stays where it is.
void SimulatedInstrument::release() {
  HeldBase* held = at_.engaged && touching_ && !settings_.taps ? base() : nullptr;
  if (held != nullptr) held->press(at_.z_m - surface_below());
  at_.engaged = false;
}

// Moves the tip as it goes if neither feedback nor drive holds it.
void SimulatedInstrument::follow_base() {
  HeldBase* held = settings_.taps ? nullptr : base();
  if (held != nullptr) held->step(at_.z_m - surface_below());
  touching_ = held != nullptr && held->touches();
}

double SimulatedInstrument::force_n() const {
  if (settings_.taps) return 0.0;
  // no contact bears a harder pull than its pull-off
  if (at_.engaged) return touching_ ? std::max(settings_.scan.setpoint.si, -surface_->pull_off_force_n) : 0.0;
  return base_ ? base_->force_n() : 0.0;
}

double SimulatedInstrument::shown(double force_n) {
  const Faults& faults = settings_.faults;
  double shown_n = force_n;
  if (faults.force_noise_n > 0.0) shown_n += faults.force_noise_n * noise_();
  if (faults.detector_range_n > 0.0) shown_n = std::clamp(shown_n, -faults.detector_range_n, faults.detector_range_n);
  return shown_n;
}

double SimulatedInstrument::shown_force() { return shown(force_n()); }

void SimulatedInstrument::wait(double time_s) {
  pass(time_s);
  if (touching_) follow_base();
}

void SimulatedInstrument::approach(double speed_m_per_s) {
  const bool false_alarm = uniform() < settings_.faults.false_engagement;
  const double above_m = false_alarm ? kFalseAboveM * (1.0 - uniform()) : 0.0;
  double held_m = 0.0;  // height of the base above the surface that the feedback finds
  if (settings_.taps) {
    // the lever swings above the sample, which is taken as rigid, as the scanner takes it
    held_m = settings_.amplitude_setpoint * settings_.free_amplitude_m;
  } else if (const HeldBase* held = base()) {
    held_m = held->height_under(settings_.scan.setpoint.si);
  }
  const double z_m = surface_below() + (false_alarm ? above_m : held_m);
  pass(std::abs(at_.z_m - z_m) / speed_m_per_s);
  at_.z_m = z_m;
  at_.engaged = true;
  touching_ = !false_alarm;
  show_place();
}

void SimulatedInstrument::withdraw(double distance_m, double speed_m_per_s) {
  release();
  pass(distance_m / speed_m_per_s);
  at_.z_m += distance_m;
  follow_base();
  show_place();
}

core::Result<void> SimulatedInstrument::set_z(double z_m, double speed_m_per_s) {
  if (settings_.taps && z_m < at_.z_m) return core::wrong_usage("a lever that taps is lowered by its feedback alone");
  SimulatedInstrument before(*this);
  release();
  pass(std::abs(z_m - at_.z_m) / speed_m_per_s);
  at_.z_m = z_m;
  follow_base();
  if (auto worn = wear(force_n()); !worn) {
    take_back_to(std::move(before));
    return worn;
  }
  show_place();
  return {};
}

void SimulatedInstrument::move_to(double x_m, double y_m, double speed_m_per_s) {
  const double from_x_m = at_.x_m, from_y_m = at_.y_m, before_m = surface_below();
  const double length_m = std::hypot(x_m - from_x_m, y_m - from_y_m);
  const bool dragged = touching_ && !at_.engaged;
  const double steps = dragged ? std::clamp(std::ceil(length_m / kStepM), 1.0, kMostStepsOfAPath) : 1.0;
  for (double step = 1.0; step <= steps; ++step) {
    pass(length_m / steps / speed_m_per_s);
    at_.x_m = step < steps ? from_x_m + (x_m - from_x_m) * step / steps : x_m;
    at_.y_m = step < steps ? from_y_m + (y_m - from_y_m) * step / steps : y_m;
    if (dragged) follow_base();
  }
  if (touching_ && at_.engaged) at_.z_m += surface_below() - before_m;  // height followed by the feedback
  show_place();
}

}  // namespace afm::instrument
