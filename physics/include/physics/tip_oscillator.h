// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "physics/lever_dynamics.h"
#include "physics/normal_generator.h"
#include "physics/tip_force.h"
#include "physics/units.h"

namespace afm::physics {

// A tip as a point mass on a lever whose base moves, in sub-steps of fixed length:
//
//   m z'' + (k/(w0 Q)) z' = F(z) + k (Z - z) + noise,   m = k/w0^2,   noise of power 4 k_B T k/(w0 Q), one-sided.
//
// The integrator is the BAOAB splitting of Leimkuhler & Matthews 2013 with the lever's spring moved from the kick B to
// the drift A, which becomes the exact oscillation of the undamped lever about its moving base:
//
//   B  half a kick by the surface, v += F tan(w0 dt/2)/(m w0); this is F dt/(2 m), and lets a tip rest exactly where F
//      + k (Z - z) = 0
//   A  half an oscillation of (z - Z, v - Z') by the angle w0 dt/2
//   O  the exact Ornstein-Uhlenbeck step of damping and noise, v = c v + sqrt((1 - c^2) k_B T/m) N(0,1) with c =
//      exp(-w0 dt/Q)
//   A  and B again
//
// - Every step is exact for its part and time-reversible at T = 0 without damping: second order in dt.
// - Without a surface both A and O preserve the canonical distribution: <(z - Z)^2> = k_B T/k exactly, for every dt.
// - Without noise it is deterministic; with noise, the same seed gives the same path.
// - It is stable if sqrt(K/m) dt < 2 for the steepest slope K of the surface, the limit of the leapfrog B, A, B;
//   longest_sub_step() keeps to 0.25 at the largest load and TipForce to 1.25 at every depth.
//
// One thread. sub_step() and its callees neither allocate nor throw.
class TipOscillator {
 public:
  // The longest sub-step for this lever and force: 25 per oscillation in contact, 126 per oscillation of the free
  // lever.
  static Time longest_sub_step(const TipForce& force, Stiffness spring_constant, const LeverDynamics& lever) noexcept;

  // `lever` is valid; starts at rest, free, at a height and base of zero.
  TipOscillator(std::shared_ptr<const TipForce> force, Stiffness spring_constant, const LeverDynamics& lever,
                Time sub_step, std::uint64_t seed);

  // Restarts the noise with this seed, as in a new oscillator. The motion continues.
  void restart_noise(std::uint64_t seed) noexcept { normal_ = NormalGenerator(seed); }

  // Sets base and tip; a tip above the height of release is free, below that of contact attached.
  void place(Length base, Length height, Velocity velocity) noexcept;

  // Sets a tip at rest free of the surface, or in steady motion with its base: F + k (Z - z) = 0 on the free branch,
  // followed from far above, and z' = Z'/(1 - F'/k).
  void settle(Length base, Velocity base_velocity) noexcept;

  // Moves the base with this velocity from now on.
  void move_base(Velocity velocity) noexcept {
    swing_velocity_ += base_velocity_ - velocity.si;
    base_velocity_ = velocity.si;
    base_step_ = base_velocity_ * sub_step_;
    damped_base_ = (damping_ - 1.0) * base_velocity_;
  }

  void sub_step() noexcept {
    swing_velocity_ += kick_ * force_;
    const double pushed = damped_base_ + (noise_ > 0.0 ? noise_ * normal_() : 0.0);
    const double deflection = swing_.xx * deflection_ + swing_.xv * swing_velocity_ + swing_.xp * pushed;
    swing_velocity_ = swing_.vx * deflection_ + swing_.vv * swing_velocity_ + swing_.vp * pushed;
    deflection_ = deflection;
    base_ += base_step_;
    force_ = (*surface_)(Length(base_ + deflection_), attached_).si;
    swing_velocity_ += kick_ * force_;
  }

  Length base() const noexcept { return Length(base_); }
  Length deflection() const noexcept { return Length(deflection_); }  // deflection z - Z, positive away from the sample
  Length height() const noexcept { return Length(base_ + deflection_); }
  Velocity velocity() const noexcept { return Velocity(swing_velocity_ + base_velocity_); }
  bool attached() const noexcept { return attached_; }
  const TipForce& surface() const noexcept { return *surface_; }

 private:
  std::shared_ptr<const TipForce> surface_;
  NormalGenerator normal_;

  // A, O, A as one linear map of x = z - Z, v = z' - Z' and p, the addition of O to v apart from c v.
  struct Swing {
    double xx, xv, xp;
    double vx, vv, vp;
  };

  double spring_constant_;
  double sub_step_;
  double kick_;     // velocity change by half a kick B, m/s per newton
  double damping_;  // c, decay of the velocity in a sub-step
  double noise_;    // velocity noise of one O, m/s; 0 at 0 K
  Swing swing_;

  double base_velocity_ = 0.0;
  double base_step_ = 0.0;
  double damped_base_ = 0.0;

  double base_ = 0.0;
  double deflection_ = 0.0;
  double swing_velocity_ = 0.0;  // velocity relative to the base, v - Z'
  double force_ = 0.0;
  bool attached_ = false;
};

}  // namespace afm::physics
