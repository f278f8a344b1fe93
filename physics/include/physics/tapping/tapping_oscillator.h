// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "physics/tapping/averaged_flow.h"
#include "physics/tapping/driven_lever.h"
#include "physics/tapping/tap_surface.h"
#include "physics/units.h"

namespace afm::physics {

// Result of one swing, by direct integration.
struct DirectSwing {
  TapState state;                        // amplitude and phase of the first harmonic
  Length deflection;                     // x0, mean deflection
  SwingAverages averages;                // <F>, the virial of the first harmonic, energy lost, peak of F, ...
  Energy full_virial;                    // <F x>, virial with all harmonics
  Area mean_square;                      // <x^2>, mean square deflection
  double mean_square_velocity_si = 0.0;  // <x'^2>, mean square velocity, m^2/s^2
  std::array<Length, 6> harmonics{};     // A_n, amplitudes of the harmonics; [0] is |x0|
  double change = 0.0;  // largest change of the first harmonic from one swing to the next in settle(), as a share of A0
};

// A direct swing as a resting one, with its lag between 0 and 360 degrees, so that none jumps at 180; stable if it
// repeats to a thousandth of A0.
RestingTap resting_tap(const DirectSwing& swing) noexcept;

// A tapping tip as a point mass, integrated directly: x = p + y, with p the free swing, which is known, and y a lever
// without a drive that only the sample kicks. y moves by the BAOAB splitting of physics/tip_oscillator.h, so without a
// force any number of steps is exact, and the swing is a whole number of steps.
//
// Near the sample, within a sixth of the free amplitude, each step is divided into kFineSteps: there the force varies
// fast, and the rest of the swing needs few steps.
//
// With a viscous contact each half kick is v' = v + K (F - c (v + v')/2), which is reversible in time. No noise.
//
// One thread. Only the constructor allocates.
class TappingOscillator {
 public:
  static constexpr int kUsualSteps = 128;  // steps in a swing
  static constexpr int kFineSteps = 16;    // fine steps in a step near the sample

  // `least_steps` a swing far from the sample, at least 8; more if the contact is stiff.
  TappingOscillator(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever,
                    int least_steps = kUsualSteps);

  // Begins a swing at the drive's angle of zero: in the free state, {A0, free_phase}, or from rest, {}.
  void place(Length z, const TapState& state) noexcept;

  // Moves the base evenly by this much in each later swing.
  void move_base(Length per_swing) noexcept;
  void set_base(Length z) noexcept { base_ = z.si; }

  // Integrates one swing and returns it.
  DirectSwing swing() noexcept;

  // Integrates so many swings. Returns the point that place() begins with to go on from here.
  TapState advance(int swings) noexcept;

  // Swings until the amplitude has changed by less than this share of A0 in 50 swings, or for 8 Q swings; returns the
  // mean of the last 16.
  DirectSwing settle(double settled = 1e-9) noexcept;

  Length base() const noexcept { return Length(base_); }
  const DrivenLever& lever() const noexcept { return lever_; }

 private:
  // Free motion of y over a step, and half of its kick.
  struct Pace {
    double kick;  // velocity change by half a kick, m/s per newton
    double xx, xv, vx, vv;
    double weight;  // half of the step's share in the swing
    double rise;    // rise of the base in a step
  };
  struct Sums;
  Pace pace(double steps_a_swing) const;
  template <bool Measured>
  void one_swing(Sums& sums) noexcept;
  template <bool Measured>
  void step(const Pace& pace, std::size_t from, std::size_t to, Sums& sums) noexcept;
  template <bool Measured>
  void half_kick(const Pace& pace, std::size_t at, Sums& sums) noexcept;
  bool near_sample(std::size_t from, std::size_t to) const noexcept;

  std::shared_ptr<const TapSurface> surface_;
  std::shared_ptr<const TipForce> force_at_;
  DrivenLever lever_;
  std::size_t steps_ = 0;
  std::vector<double> cosine_, sine_;    // cosine and sine of the drive's angle at each fine step of a swing
  std::vector<double> free_x_, free_v_;  // free swing p and its velocity p'
  double mass_;
  double near_;  // height below which steps are fine
  Pace coarse_, fine_;

  double base_ = 0.0;
  double y_ = 0.0, v_ = 0.0;
  double force_ = 0.0, friction_ = 0.0;
  bool attached_ = false;
};

}  // namespace afm::physics
