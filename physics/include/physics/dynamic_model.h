// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "physics/contact_parameters.h"
#include "physics/cycle_figures.h"
#include "physics/force_model.h"
#include "physics/law.h"
#include "physics/lever_dynamics.h"
#include "physics/tip_oscillator.h"
#include "physics/units.h"

namespace afm::physics {

// A law of force felt through a lever that has mass, damping and heat: ApproachRetractModel with time. The tip is a
// point mass (physics/tip_oscillator.h) under the law of fixed grips, so that jumps take their time, overshoot and
// ring.
//
// What is rendered: the force is the lever's, k (z - Z) averaged over the step, which at rest is the force on the tip
// by the sample with the sign of physics/contact.h. Never F_ts itself: at the impact of a jump to contact that is forty
// times as large, for microseconds. The mean over a step is a low pass with its zeros at the multiples of the step
// rate: what would alias into the hand. The pose is that of the mean deflection at the step's last Z.
//
// Time: a tip in contact swings at some hundred kilohertz. A step simulates at most kSubSteps sub-steps of the longest
// length that is exact enough, and so, where the physics is faster than that, less time than a tick lasts: slow motion,
// by the factor slow_motion(). The path of Z between two steps is a straight line over the simulated time, so the
// curve in Z is whole, and the hand's speed counts slow_motion() times.
//
// Jumps are found in the tip's own path. One to contact begins when the tip passes the height from which the resting
// lever would jump (CycleFigures::tip_height_before_jtc) for the last time before contact and ends there; one off
// contact begins at tip_height_before_joc likewise and ends when the tip is above both heights. The event's Z and
// force_before are those of its beginning, force_after the force when it has ended, all of the lever and interpolated
// within the sub-step; it is reported by the step in which it ends, with `fraction` telling when. A lever without
// hysteresis reports none.
//
// - T = 0: deterministic. T > 0: the same seed and steps give the same forces, bit by bit; another step rate divides
//   time otherwise and gives another path with the same statistics.
// - A Z that is not finite, or a deflection beyond 0.1 mm, gives zero force and the wait state.
//
// step(), wait_for_lift() and settle() do not allocate, lock or throw: they are for one servo thread. Copies share the
// tables.
class DynamicModel {
 public:
  static constexpr std::int64_t kSubSteps = 256;
  static constexpr std::int64_t kLongestStep = 1'000'000'000;  // sub-steps of simulating()
  static constexpr std::uint64_t kDefaultSeed = 1;

  // Starts in WaitForLift. Throws std::invalid_argument (UnphysicalValue where one field is to blame) as
  // build_law_tables() and validate() do, for a law without dynamics, and for a tick period that is no time.
  // Allocates and takes some milliseconds.
  DynamicModel(Law law, const ContactParameters& contact, const LeverDynamics& lever, Time tick_period,
               const LawOptions& options = {}, std::uint64_t seed = kDefaultSeed);

  // The same model, waiting, whose step() simulates exactly this time in as many sub-steps as that takes: for curves.
  // (Beyond kLongestStep of them it is slow motion again.) Throws std::invalid_argument for a time that is none.
  DynamicModel simulating(Time per_step) const;

  // The response at Z after the straight path from the Z of the step before.
  TipResponse step(Length z) noexcept;

  // After a start, a change of material or a dropout: zero force until Z > Z_joc. The noise begins anew, so that what
  // follows depends on the steps to come alone.
  void wait_for_lift() noexcept;

  // Free and at rest at Z, or moving with a base of this velocity as one that came steadily from afar. Z lies above
  // Z_jtc.
  void settle(Length z, Velocity base_velocity = Velocity()) noexcept;

  Phase phase() const noexcept { return phase_; }
  Law law() const noexcept { return setup_->law; }
  const ContactParameters& contact() const noexcept { return setup_->contact; }
  const LeverDynamics& lever() const noexcept { return setup_->lever; }

  // Of the same law and lever without dynamics.
  const CycleFigures& figures() const noexcept { return setup_->figures; }

  Time simulated_per_step() const noexcept { return pace_.simulated; }
  Time sub_step() const noexcept { return pace_.simulated / static_cast<double>(pace_.sub_steps); }

  // How much longer a step lasts than the time that it simulates, at least 1.
  double slow_motion() const noexcept { return pace_.step_lasts / pace_.simulated; }

 private:
  struct Setup {
    Law law;
    ContactParameters contact;
    LeverDynamics lever;
    CycleFigures figures;
    Length contact_gap;
    std::shared_ptr<const TipForce> surface;
    std::uint64_t seed;
    Length free_above;  // end of a jump off contact
  };

  static std::shared_ptr<const Setup> build(Law law, const ContactParameters& contact, const LeverDynamics& lever,
                                            const LawOptions& options, std::uint64_t seed);

  // How a step is divided.
  struct Pace {
    Time step_lasts;
    Time simulated;
    std::int64_t sub_steps;
  };
  static Pace pace_of(const Setup& setup, Time step_lasts, std::int64_t most_sub_steps);
  DynamicModel(const std::shared_ptr<const Setup>& setup, Time tick_period);
  DynamicModel(std::shared_ptr<const Setup> setup, const Pace& pace);

  // What the lever is at one instant.
  struct Instant {
    Length z;
    Length tip_height;
    Force force;
  };
  Instant now() const noexcept;

  // The heights of the tip where the jump that can come next begins and ends.
  struct Jump {
    Length begin;
    Length end;
  };
  Jump awaited_jump() const noexcept;
  static Instant where(Length height, const Instant& before, const Instant& after) noexcept;
  void watch(const Instant& before, const Instant& after, double fraction, TipResponse& response) noexcept;

  std::shared_ptr<const Setup> setup_;
  Pace pace_;
  TipOscillator oscillator_;
  Phase phase_ = Phase::WaitForLift;
  Instant jump_began_;
};

}  // namespace afm::physics
